// SPDX-License-Identifier: MIT
#include "shared/vulkan/passes/barriers.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace diptych {

namespace {

// Shader accesses included in SHADER_READ.
constexpr VkAccessFlags2 shaderReads =
    VK_ACCESS_2_SHADER_SAMPLED_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_READ_BIT | VK_ACCESS_2_UNIFORM_READ_BIT;

// All accesses that a mask includes.
VkAccessFlags2 expanded(VkAccessFlags2 access) {
    if ((access & VK_ACCESS_2_MEMORY_READ_BIT) != 0) return ~writeAccesses;
    return (access & VK_ACCESS_2_SHADER_READ_BIT) != 0 ? access | shaderReads : access;
}

bool covers(VkPipelineStageFlags2 all, VkPipelineStageFlags2 stages) {
    return (all & VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT) != 0 || (stages & ~all) == 0;
}

bool overlap(const Part& a, const Part& b) {
    return a.level < b.level + b.levels && b.level < a.level + a.levels && a.layer < b.layer + b.layers &&
           b.layer < a.layer + a.layers;
}

}  // namespace

std::size_t BarrierTracker::add(const std::string& name, std::uint32_t levels, std::uint32_t layers) {
    resources_.push_back({name, levels, layers, std::vector<State>(std::size_t{levels} * layers)});
    return resources_.size() - 1;
}

void BarrierTracker::setWritten(std::size_t resource, VkImageLayout layout) {
    State state;
    state.layout = layout;
    state.visible = {{VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, VK_ACCESS_2_MEMORY_READ_BIT}};
    std::ranges::fill(resources_.at(resource).states, state);
}

void BarrierTracker::alias(std::size_t resource, std::size_t other) {
    State last;
    for (const State& state : resources_.at(other).states) {
        last.write_stages |= state.write_stages | state.read_stages;
        last.write_access |= state.write_access;
    }
    std::ranges::fill(resources_.at(resource).states, last);
}

bool BarrierTracker::sees(const State& state, const Access& access) {
    if (state.write_stages == 0 && state.visible.empty()) return true;  // nothing was written
    return std::ranges::any_of(state.visible, [&](const Access& seen) {
        return covers(seen.stages, access.stages) && (access.access & ~expanded(seen.access)) == 0;
    });
}

// Returns whether the use needs a barrier; sets its source scope `from`.
bool BarrierTracker::advance(State& state, const Use& use, Access& from) {
    const Access& to = use.access;
    const bool layoutChanges = to.layout != state.layout && to.layout != VK_IMAGE_LAYOUT_UNDEFINED;
    if (!writes(to) && !layoutChanges) {
        const bool waits = !sees(state, to);
        from = {state.write_stages, state.write_access, state.layout};
        if (waits) state.visible.push_back(to);
        state.read_stages |= to.stages;
        return waits;
    }
    from = {state.write_stages | state.read_stages, state.write_access,
            use.discards ? VK_IMAGE_LAYOUT_UNDEFINED : state.layout};
    // A write is not visible to any access yet, not even to reads in its own shaders. Later readers wait
    // for a layout transition, which completes before the stages of this use.
    if (writes(to))
        state = {to.layout, to.stages, to.access & writeAccesses, 0, {}};
    else
        state = {to.layout, to.stages, 0, to.stages, {to}};
    return layoutChanges || from.stages != 0;  // a buffer's first write waits for nothing
}

std::vector<Barrier> BarrierTracker::before(const std::string& pass, const std::vector<Use>& uses) {
    std::vector<Use> united;
    for (const Use& use : uses) {
        const auto same = std::ranges::find_if(
            united, [&](const Use& u) { return u.resource == use.resource && overlap(u.part, use.part); });
        if (same == united.end()) {
            united.push_back(use);
            continue;
        }
        const std::string& resource = name(use.resource);
        if (same->part != use.part)
            throw std::logic_error(fmt::format(
                "pass {}: uses of {} overlap partially; declare the same levels and layers", pass, resource));
        if (same->access.layout != use.access.layout)
            throw std::logic_error(fmt::format("pass {}: uses {} in two layouts at once", pass, resource));
        if (writes(same->access) != writes(use.access) && same->access.stages != use.access.stages)
            throw std::logic_error(
                fmt::format("pass {}: writes and reads {} in different stages", pass, resource));
        same->access.stages |= use.access.stages;
        same->access.access |= use.access.access;
        same->discards = same->discards && use.discards;
    }
    std::vector<Barrier> barriers;
    for (const Use& use : united) {
        Resource& resource = resources_.at(use.resource);
        if (use.part.level + use.part.levels > resource.levels ||
            use.part.layer + use.part.layers > resource.layers)
            throw std::logic_error(
                fmt::format("pass {}: {} has no such level or layer", pass, resource.name));
        const std::size_t begin = barriers.size();
        for (std::uint32_t layer = use.part.layer; layer < use.part.layer + use.part.layers; ++layer) {
            std::vector<Barrier> runs;  // of levels in this layer with the same source state
            for (std::uint32_t level = use.part.level; level < use.part.level + use.part.levels; ++level) {
                Access from;
                if (!advance(resource.states[std::size_t{layer} * resource.levels + level], use, from))
                    continue;
                if (!runs.empty() && runs.back().from == from &&
                    runs.back().part.level + runs.back().part.levels == level)
                    ++runs.back().part.levels;
                else
                    runs.push_back({use.resource, {level, 1, layer, 1}, from, use.access});
            }
            for (const Barrier& run : runs) {
                const auto above = std::find_if(barriers.begin() + static_cast<std::ptrdiff_t>(begin),
                                                barriers.end(), [&](const Barrier& b) {
                                                    return b.from == run.from &&
                                                           b.part.level == run.part.level &&
                                                           b.part.levels == run.part.levels &&
                                                           b.part.layer + b.part.layers == layer;
                                                });
                if (above == barriers.end())
                    barriers.push_back(run);
                else
                    ++above->part.layers;
            }
        }
    }
    return barriers;
}

}  // namespace diptych
