// SPDX-License-Identifier: MIT
#include "shared/vulkan/passes/pass.h"

namespace diptych {

Pass& Pass::color(ImageRef image, Load load, VkClearColorValue clear, Slice slice, ImageRef resolved) {
    colors_.push_back({image, load, {.color = clear}, slice, resolved});
    return *this;
}

Pass& Pass::depth(ImageRef image, Load load, Slice slice, ImageRef resolved) {
    depth_ = {image, load, {}, slice, resolved};
    depth_writes_ = true;
    return *this;
}

Pass& Pass::depthTest(ImageRef image, Slice slice) {
    depth_ = {image, Load::keep, {}, slice, {}};
    depth_writes_ = false;
    return *this;
}

Pass& Pass::covers(VkExtent2D extent) {
    covered_ = extent;
    return *this;
}

// The layout depends on the format and is set in PassList::usesOf().
Pass& Pass::samples(ImageRef image, VkPipelineStageFlags2 stages) {
    images_.push_back({image, {stages, VK_ACCESS_2_SHADER_SAMPLED_READ_BIT}, {}, true});
    return *this;
}

Pass& Pass::samples(ImageRef image, VkPipelineStageFlags2 stages, const Part& part) {
    images_.push_back({image, {stages, VK_ACCESS_2_SHADER_SAMPLED_READ_BIT}, part});
    return *this;
}

Pass& Pass::uses(ImageRef image, const Access& access, const Part& part, bool discards) {
    images_.push_back({image, access, part, false, discards});
    return *this;
}

Pass& Pass::uses(BufferRef buffer, const Access& access) {
    buffers_.emplace_back(buffer, access);
    return *this;
}

Pass& Pass::prepare(std::function<void()> make) {
    if (prepare_)
        prepare_ = [earlier = std::move(prepare_), later = std::move(make)] {
            earlier();
            later();
        };
    else
        prepare_ = std::move(make);
    return *this;
}

Pass& Pass::takes(double ms) {
    ms_ = ms;
    return *this;
}

Pass& Pass::record(std::function<void(VkCommandBuffer)> commands) {
    record_ = std::move(commands);
    return *this;
}

Pass& Pass::recordRows(std::uint32_t rows, std::function<void(VkCommandBuffer, const Rows&)> commands) {
    rows_ = rows;
    record_rows_ = std::move(commands);
    return *this;
}

}  // namespace diptych
