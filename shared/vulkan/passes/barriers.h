// SPDX-License-Identifier: MIT
// Derives barriers from the uses that passes declare. Identifies resources by index and makes no Vulkan
// calls, so every rule can be unit-tested.
//
// The rules are those of synchronization2 (Vulkan 1.3, chapter 7):
//   - A write waits for all earlier reads and writes of the same part, and sees earlier writes.
//   - A read waits for the last write, unless an earlier barrier made it visible to the same stages and
//   accesses.
//   - A layout transition counts as a write.
#pragma once

#include "shared/vulkan/passes/access.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace diptych {

// A range of an image's mip levels and array layers. Buffers are synchronized as a whole: the default.
struct Part {
    std::uint32_t level = 0, levels = 1;
    std::uint32_t layer = 0, layers = 1;
    bool operator==(const Part&) const = default;
};

struct Barrier {
    std::size_t resource = 0;
    Part part;
    Access from, to;  // from.layout is undefined if the contents are discarded
    bool operator==(const Barrier&) const = default;
};

// One use of a part of a resource by a pass.
struct Use {
    std::size_t resource = 0;
    Part part;
    Access access;
    bool discards = false;  // previous contents are not needed: the part is cleared or fully overwritten
};

class BarrierTracker {
public:
    // Adds a resource with undefined contents (buffers: 1 level, 1 layer). Returns its index.
    std::size_t add(const std::string& name, std::uint32_t levels = 1, std::uint32_t layers = 1);
    // Sets its contents as written by completed submits and visible to all accesses.
    void setWritten(std::size_t resource, VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED);
    // Memory changes hands from `other` to `resource`: the next use of `resource` waits for the last use
    // of `other` and finds undefined contents.
    void alias(std::size_t resource, std::size_t other);

    // Barriers before a pass with these uses; assumes that the pass runs next. Merges uses of the same
    // part by one pass. Throws std::logic_error naming pass and resource if their layouts differ, or if
    // one pass writes a part and reads it in another stage.
    std::vector<Barrier> before(const std::string& pass, const std::vector<Use>& uses);

    const std::string& name(std::size_t resource) const { return resources_.at(resource).name; }

private:
    // State of one level of one layer since its last write or layout transition.
    struct State {
        VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;
        VkPipelineStageFlags2 write_stages = 0;
        VkAccessFlags2 write_access = 0;  // 0: already available, through a layout transition
        VkPipelineStageFlags2 read_stages = 0;
        std::vector<Access> visible;  // accesses to which the write is visible
        bool operator==(const State&) const = default;
    };
    struct Resource {
        std::string name;
        std::uint32_t levels = 1, layers = 1;
        std::vector<State> states;  // all levels of the first layer, then of the next
    };
    static bool sees(const State& state, const Access& access);
    static bool advance(State& state, const Use& use, Access& from);

    std::vector<Resource> resources_;
};

}  // namespace diptych
