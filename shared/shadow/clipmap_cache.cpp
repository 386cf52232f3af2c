// SPDX-License-Identifier: MIT
#include "shared/shadow/clipmap_cache.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <limits>
#include <set>
#include <stdexcept>
#include <tuple>
#include <utility>

namespace diptych {

namespace {

using Level = std::set<std::pair<int, int>>;  // y and x of its pages in the window

// Pages with the same parent.
struct Siblings {
    double distance = 0;  // of the parent's centre from the clipmap's centre, across the light
    Clipmap::Place parent;
    std::vector<std::pair<int, int>> pages;
};

std::vector<Siblings> siblingsOf(const Clipmap& clipmap, std::size_t level, const Level& pages) {
    std::map<std::pair<int, int>, Siblings> groups;
    for (const auto& [y, x] : pages) {
        const Clipmap::Place parent = clipmap.parentOf({level, x, y});
        Siblings& group = groups[{parent.y, parent.x}];
        group.parent = parent;
        group.pages.emplace_back(y, x);
    }
    const glm::dvec2 centre(clipmap.grid.space.from(clipmap.centre));
    std::vector<Siblings> all;
    for (auto& [place, group] : groups) {
        const CascadeArea area = clipmap.grid.areaOf(clipmap.addressOf(group.parent));
        group.distance = glm::distance(area.corner + area.texel * clipmap.grid.slot() / 2.0, centre);
        all.push_back(std::move(group));
    }
    std::ranges::stable_sort(all, std::ranges::greater(), &Siblings::distance);
    return all;
}

// Pages per level, reduced to `max`; excludes the whole scene's page.
std::vector<Level> fitting(const Clipmap& clipmap, std::vector<Level> levels, std::size_t max) {
    std::size_t count = 0;
    for (const Level& level : levels) count += level.size();
    for (std::size_t i = 0; i < levels.size() && count > max; ++i)
        for (const Siblings& group : siblingsOf(clipmap, i, levels[i])) {
            if (count <= max) break;
            for (const auto& page : group.pages) levels[i].erase(page);
            count -= group.pages.size();
            if (i + 1 < levels.size()) count += levels[i + 1].insert({group.parent.y, group.parent.x}).second;
        }
    return levels;
}

bool isMarked(std::span<const gpu::uint> marks, std::size_t page) {
    return (marks[page / 32] >> (page % 32) & 1u) != 0;
}

}  // namespace

ResidentPages ClipmapCache::makeResident(const Clipmap& clipmap, std::span<const gpu::uint> marks) {
    if (marks.size() * 32 < clipmap.pages()) throw std::logic_error("ClipmapCache: too few marks");
    if (grid_ != clipmap.grid) held_.clear();
    grid_ = clipmap.grid;
    ++updates_;

    const std::size_t whole = clipmap.levels.size() - 1;
    std::vector<Level> marked(whole);
    ResidentPages pages;
    for (std::size_t page = 0; page < clipmap.pages(); ++page) {
        if (!isMarked(marks, page)) continue;
        ++pages.requested;
        const Clipmap::Place place = clipmap.placeOf(page);
        if (place.level < whole) marked[place.level].emplace(place.y, place.x);
    }
    const std::vector<Level> levels = fitting(clipmap, std::move(marked), slots_ - 1);

    // Pages that are already resident keep their slots, independent of the order of assignment.
    std::vector<Clipmap::Place> places;
    for (std::size_t i = 0; i < whole; ++i)
        for (const auto& [y, x] : levels[i]) places.push_back({i, x, y});
    places.push_back({whole, 0, 0});
    for (const Clipmap::Place& place : places)
        if (const auto found = held_.find(clipmap.addressOf(place)); found != held_.end())
            found->second.needed = updates_;
    constexpr ResidentPages::Entry none{~0u, 0};
    pages.table.assign(clipmap.pages(), none);
    for (const Clipmap::Place& place : places) {
        const PageAddress address = clipmap.addressOf(place);
        pages.table[clipmap.numberOf(place)] = {static_cast<std::uint32_t>(pages.resident.size()),
                                                static_cast<std::uint32_t>(place.level)};
        pages.resident.push_back({address, take(address)});
    }
    for (std::size_t page = clipmap.pages(); page-- > 0;) {
        const Clipmap::Place place = clipmap.placeOf(page);
        ResidentPages::Entry& entry = pages.table[page];
        if (entry.resident == none.resident) entry = pages.table[clipmap.numberOf(clipmap.parentOf(place))];
        pages.fallback += isMarked(marks, page) && entry.level != place.level;
    }
    return pages;
}

// Slot of a page; assigns one if needed.
std::uint32_t ClipmapCache::take(const PageAddress& page) {
    if (const auto found = held_.find(page); found != held_.end()) return found->second.slot;
    std::uint32_t slot = static_cast<std::uint32_t>(held_.size());
    if (held_.size() == slots_) {
        const auto oldest = std::ranges::min_element(
            held_, {}, [](const auto& held) { return std::tie(held.second.needed, held.first); });
        slot = oldest->second.slot;
        held_.erase(oldest);
    }
    held_[page] = {.slot = slot, .needed = updates_, .drawn = false};
    return slot;
}

std::vector<PageDraw> ClipmapCache::stale(std::span<const PageDraw> pages) const {
    std::vector<PageDraw> all;
    for (const PageDraw& page : pages)
        if (!held_.at(page.page).drawn) all.push_back(page);
    return all;
}

void ClipmapCache::drawn(const PageDraw& page) {
    held_.at(page.page).drawn = true;
}

void ClipmapCache::moved(const glm::dvec2& lower, const glm::dvec2& upper) {
    if (!grid_) return;
    for (auto& [address, held] : held_) {
        const CascadeArea area = grid_->areaOf(address);
        const glm::dvec2 begin = area.corner, end = begin + area.texel * grid_->slot();
        if (begin.x <= upper.x && lower.x <= end.x && begin.y <= upper.y && lower.y <= end.y)
            held.drawn = false;
    }
}

}  // namespace diptych
