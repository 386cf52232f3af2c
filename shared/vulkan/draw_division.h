// SPDX-License-Identifier: MIT
// Lets a software device rasterise the first triangles of a pass while it still sets up the others.
#pragma once

#include "shared/vulkan/owned.h"

#include <cstdint>

namespace diptych {

// Mesa lavapipe sets up and bins all triangles of a pass on one thread before its other threads begin to
// rasterise. At a time stamp it hands over what it has binned so far (lavapipe's lvp_execute.c flushes before
// it writes one), so that both go on side by side. The picture has the same bits: what is drawn later finds
// the attachments as the earlier draws have left them. Nobody reads the stamps.
class DrawDivision {
public:
    // `triangles`: of draws between two stamps; 0: draws are never divided, and nothing is made.
    DrawDivision(VkDevice device, std::uint32_t triangles);

    // Begins a command buffer, outside of rendering. Buffers that are recorded one after the other must be
    // submitted in that order, to one queue.
    void begin(VkCommandBuffer commands);

    // Inside of rendering, after a draw of so many triangles. A command buffer has 256 stamps; what is drawn
    // after the last is not divided.
    void drawn(VkCommandBuffer commands, std::uint64_t triangles);

    // Stamps of the command buffer so far.
    std::uint32_t stamps() const { return used_; }

    // A pass ends, after which the device begins with what is left of it anyway.
    void endPass() { waiting_ = 0; }

private:
    std::uint32_t triangles_ = 0;
    std::uint32_t used_ = 0;     // stamps of this command buffer
    std::uint64_t waiting_ = 0;  // triangles since the last stamp
    OwnedQueryPool pool_;
};

}  // namespace diptych
