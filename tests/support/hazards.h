// SPDX-License-Identifier: MIT
// Checks that barriers suffice for the declared uses between them. Implements the memory model of Vulkan
// 1.3, chapter 7, for one queue, independently of BarrierTracker. It also finds missing source stages and
// accesses, which the validation layer does not.
#pragma once

#include "shared/vulkan/passes/pass_list.h"

#include <fmt/format.h>

#include <map>
#include <string>
#include <tuple>
#include <vector>

namespace diptych {

class Hazards {
public:
    // One run of a pass list: its declared uses and the barriers recorded before each pass.
    void run(const std::vector<DeclaredUse>& uses, const std::vector<RecordedBarrier>& barriers) {
        std::size_t passes = 0;
        for (const DeclaredUse& use : uses) passes = std::max(passes, use.number + 1);
        for (std::size_t pass = 0; pass < passes; ++pass) {
            for (const RecordedBarrier& barrier : barriers)
                if (barrier.number == pass)
                    eachPlace(barrier.resource, barrier.part, [&](Place& p) { wait(p, barrier); });
            // All uses of a subresource by one pass are merged and checked against earlier passes.
            std::map<Key, DeclaredUse> together;
            for (const DeclaredUse& use : uses)
                if (use.number == pass)
                    eachKey(use.resource, use.part, [&](const Key& key) {
                        const auto [at, fresh] = together.emplace(key, use);
                        at->second.access.stages |= use.access.stages;
                        at->second.access.access |= use.access.access;
                    });
            for (const auto& [key, use] : together) takePlace(places_[key], use);
        }
    }
    const std::vector<std::string>& found() const { return found_; }

private:
    using Key = std::tuple<std::string, std::uint32_t, std::uint32_t>;
    // An access to a subresource, and everything ordered after it so far.
    struct Event {
        std::string what;
        VkPipelineStageFlags2 stages = 0;
        VkAccessFlags2 written = 0;        // 0: a read or a layout transition
        bool available = false;            // of a write: flushed from its stage's cache
        VkPipelineStageFlags2 before = 0;  // stages that wait for it
        std::vector<Access> visible;       // stages and accesses it is visible to
        bool isRead = false;
    };
    struct Place {
        VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;
        std::vector<Event> events;
    };

    static bool coversStages(VkPipelineStageFlags2 all, VkPipelineStageFlags2 some) {
        return (all & VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT) != 0 || (some & ~all) == 0;
    }

    template <class Visit>
    static void eachKey(const std::string& resource, const Part& part, Visit&& visit) {
        for (std::uint32_t layer = part.layer; layer < part.layer + part.layers; ++layer)
            for (std::uint32_t level = part.level; level < part.level + part.levels; ++level)
                visit(Key{resource, layer, level});
    }
    template <class Visit>
    void eachPlace(const std::string& resource, const Part& part, Visit&& visit) {
        eachKey(resource, part, [&](const Key& key) { visit(places_[key]); });
    }

    void say(const std::string& pass, const std::string& resource, const Event& event, const char* why) {
        found_.push_back(fmt::format("{}: {}: {} {}", pass, resource, event.what, why));
    }

    void wait(Place& place, const RecordedBarrier& b) {
        for (Event& e : place.events) {
            // Directly, or chained through a stage that an earlier barrier made wait.
            const bool direct = b.from.stages != 0 && coversStages(b.from.stages, e.stages);
            if (!direct && (e.before & b.from.stages) == 0) continue;
            e.before |= b.to.stages;
            if (direct && (e.written & ~b.from.access) == 0) e.available = true;
            if (e.available) e.visible.push_back(b.to);
        }
        if (b.to.layout == VK_IMAGE_LAYOUT_UNDEFINED || b.to.layout == place.layout) return;
        // A layout transition is a write: all earlier accesses must be complete.
        for (const Event& e : place.events) {
            if (!coversStages(e.before, b.to.stages))
                say(b.pass, b.resource, e, "is not waited for by a change of layout");
            if (!e.isRead && !e.available)
                say(b.pass, b.resource, e, "is not available to a change of layout");
        }
        if (b.from.layout != VK_IMAGE_LAYOUT_UNDEFINED && b.from.layout != place.layout)
            found_.push_back(fmt::format("{}: {}: leaves another layout than it has", b.pass, b.resource));
        place.layout = b.to.layout;
        place.events = {
            {"the change of layout before " + b.pass, b.to.stages, 0, true, b.to.stages, {b.to}, false}};
    }

    void takePlace(Place& place, const DeclaredUse& use) {
        const VkAccessFlags2 written = use.access.access & writeAccesses;
        if (use.access.layout != VK_IMAGE_LAYOUT_UNDEFINED && use.access.layout != place.layout)
            found_.push_back(fmt::format("{}: {}: is in another layout", use.pass, use.resource));
        for (const Event& e : place.events) {
            if (e.isRead && written == 0) continue;
            if (!coversStages(e.before, use.access.stages))
                say(use.pass, use.resource, e, "is not waited for");
            if (e.isRead) continue;
            const bool seen = std::ranges::any_of(e.visible, [&](const Access& a) {
                return coversStages(a.stages, use.access.stages) && (use.access.access & ~a.access) == 0;
            });
            if (!seen) say(use.pass, use.resource, e, "is not visible");
        }
        const Event own{use.pass, use.access.stages, written, false, 0, {}, written == 0};
        if (written != 0)
            place.events = {own};  // earlier accesses are ordered before it
        else
            place.events.push_back(own);
    }

    std::map<Key, Place> places_;
    std::vector<std::string> found_;
};

}  // namespace diptych
