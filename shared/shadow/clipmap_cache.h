// SPDX-License-Identifier: MIT
// Assignment of clipmap pages to slots of the atlas, over all images drawn with it. No Vulkan.
#pragma once

#include "shared/shadow/clipmap.h"

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <vector>

namespace diptych {

struct PageDraw {
    PageAddress page;
    std::uint32_t slot = 0;
};

// Pages of one image.
struct ResidentPages {
    std::vector<PageDraw> resident;  // all pages that the image may sample, including the whole scene's
    // Per ClipmapPage in shader order: index in `resident` of the page that it samples, and that page's
    // level.
    struct Entry {
        std::uint32_t resident = 0, level = 0;
    };
    std::vector<Entry> table;
    // Marked pages: requested = resident + replaced by a coarser level (fallback).
    std::uint32_t requested = 0, fallback = 0;
};

// Pages keep their slots until others need them; the least recently needed go first. Residency depends on
// the marks alone, never on earlier images.
class ClipmapCache {
public:
    explicit ClipmapCache(std::uint32_t slots) : slots_(slots) {}

    // `marks`: a bit per ClipmapPage. If the marked pages exceed the slots, marked siblings of the finest
    // level are replaced by their parent, farthest from the centre first, level by level. With one slot
    // the whole scene's page serves everything. Pages of another grid are dropped.
    ResidentPages makeResident(const Clipmap& clipmap, std::span<const gpu::uint> marks);

    // stale(): pages of makeResident() that must be drawn. drawn(): marks a page as drawn.
    std::vector<PageDraw> stale(std::span<const PageDraw> pages) const;
    void drawn(const PageDraw& page);

    // Geometry has moved within, into or out of this area of light space, relative to the world's origin:
    // invalidates pages that overlap it.
    void moved(const glm::dvec2& lower, const glm::dvec2& upper);

    std::uint32_t slots() const { return slots_; }

private:
    struct Held {
        std::uint32_t slot = 0;
        std::uint64_t needed = 0;  // the last makeResident() that needed it
        bool drawn = false;
    };
    std::uint32_t take(const PageAddress& page);

    std::uint32_t slots_;
    std::uint64_t updates_ = 0;
    std::optional<PageGrid> grid_;
    std::map<PageAddress, Held> held_;
};

}  // namespace diptych
