// SPDX-License-Identifier: MIT
#include "shared/vulkan/device/draw_division.h"

#include "shared/vulkan/device/commands.h"

namespace diptych {

namespace {
constexpr std::uint32_t stampCount = 256;
}

DrawDivision::DrawDivision(VkDevice device, std::uint32_t triangles)
    : triangles_(triangles), used_(stampCount) {
    if (triangles == 0) return;
    pool_ = makeQueryPool(device, VK_QUERY_TYPE_TIMESTAMP, stampCount);
}

void DrawDivision::begin(VkCommandBuffer commands) {
    if (triangles_ == 0) return;
    vkCmdResetQueryPool(commands, pool_, 0, stampCount);
    used_ = 0;
    waiting_ = 0;
}

void DrawDivision::drawn(VkCommandBuffer commands, std::uint64_t triangles) {
    waiting_ += triangles;
    if (triangles_ == 0 || waiting_ < triangles_ || used_ == stampCount) return;
    vkCmdWriteTimestamp2(commands, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, pool_, used_);
    ++used_;
    waiting_ = 0;
}

}  // namespace diptych
