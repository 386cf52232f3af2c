// SPDX-License-Identifier: MIT
// Lets a software device rasterize the first triangles of a pass while it sets up the others.
#pragma once

#include "shared/vulkan/instance/owned.h"

#include <cstdint>

namespace diptych {

// Mesa lavapipe sets up and bins all triangles of a pass on one thread before its other threads begin to
// rasterize. A time stamp makes it hand over the triangles binned so far (lvp_execute.c flushes before it
// writes one), so that both run concurrently. The image has the same bits, because later draws continue on
// the same attachments. The time stamps are not read.
class DrawDivision {
public:
    // `triangles`: between two time stamps; 0: draws are never divided.
    DrawDivision(VkDevice device, std::uint32_t triangles);

    // Call at the beginning of a command buffer, outside rendering. Command buffers must be submitted in
    // recording order to one queue.
    void begin(VkCommandBuffer commands);

    // Call inside rendering, after a draw of this many triangles. A command buffer has 256 time stamps;
    // later draws are not divided.
    void drawn(VkCommandBuffer commands, std::uint64_t triangles);

    // Time stamps used in the command buffer so far.
    std::uint32_t stamps() const { return used_; }

    // Ends a pass; the device then starts on the remaining triangles anyway.
    void endPass() { waiting_ = 0; }

private:
    std::uint32_t triangles_ = 0;
    std::uint32_t used_ = 0;     // time stamps used in this command buffer
    std::uint64_t waiting_ = 0;  // triangles since the last time stamp
    OwnedQueryPool pool_;
};

}  // namespace diptych
