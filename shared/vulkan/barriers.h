// SPDX-License-Identifier: MIT
// From what passes declare to the barriers between them. Knows resources by number alone and calls no Vulkan,
// so that every rule can be tested by itself.
//
// The rules are those of synchronization2 (Vulkan 1.3, chapter 7):
//   - a write waits for every earlier read and write of the same part, and sees what was written;
//   - a read waits for the last write unless an earlier barrier has made that write visible to its stages and
//   accesses;
//   - another image layout is a write by itself.
#pragma once

#include "shared/vulkan/access.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace diptych {

// A box of an image's mip levels and array layers; of buffers, which are synchronized whole, the default.
struct Part {
    std::uint32_t level = 0, levels = 1;
    std::uint32_t layer = 0, layers = 1;
    bool operator==(const Part&) const = default;
};

struct Barrier {
    std::size_t resource = 0;
    Part part;
    Access from, to;  // from.layout is undefined where the contents are not kept
    bool operator==(const Barrier&) const = default;
};

// One use of a part of a resource by a pass.
struct Use {
    std::size_t resource = 0;
    Part part;
    Access access;
    bool discards = false;  // what the part held is not needed: it is cleared or written whole
};

class BarrierTracker {
public:
    // A resource of that many levels and layers (buffers: 1 and 1) whose contents are undefined. Returns its
    // number.
    std::size_t add(const std::string& name, std::uint32_t levels = 1, std::uint32_t layers = 1);
    // It has contents that earlier submits have finished: visible to everything.
    void setWritten(std::size_t resource, VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED);
    // The memory is another resource's from now on, or was until now: its next use waits for the last use of
    // `other`, and finds undefined contents.
    void alias(std::size_t resource, std::size_t other);

    // The barriers that must stand before a pass with these uses, which is taken to have run then. Uses of
    // the same part by one pass are one: their stages and accesses are united. Throws std::logic_error naming
    // pass and resource where their layouts contradict each other or one pass both writes a part and reads it
    // in another stage.
    std::vector<Barrier> before(const std::string& pass, const std::vector<Use>& uses);

    const std::string& name(std::size_t resource) const { return resources_.at(resource).name; }

private:
    // What has happened to one level of one layer since its last write or change of layout.
    struct State {
        VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;
        VkPipelineStageFlags2 write_stages = 0;
        VkAccessFlags2 write_access = 0;  // 0: available already, by a change of layout
        VkPipelineStageFlags2 read_stages = 0;
        std::vector<Access> visible;  // to these the write is visible
        bool operator==(const State&) const = default;
    };
    struct Resource {
        std::string name;
        std::uint32_t levels = 1, layers = 1;
        std::vector<State> states;  // level by level of the first layer, then of the next
    };
    static bool sees(const State& state, const Access& access);
    static bool advance(State& state, const Use& use, Access& from);

    std::vector<Resource> resources_;
};

}  // namespace diptych
