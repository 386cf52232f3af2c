// SPDX-License-Identifier: MIT
// Which pages of a clipmap have a slot in the atlas, over all pictures that are drawn from it. No Vulkan.
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

// What one picture is served by.
struct ServedPages {
    std::vector<PageDraw> resident;  // every page that the picture may read, the whole scene's among them
    // Of each ClipmapPage in the shaders' order: which of `resident` serves it, and of which level that is.
    struct Entry {
        std::uint32_t resident = 0, level = 0;
    };
    std::vector<Entry> table;
    // Marked pages: requested = served by themselves + by a coarser level.
    std::uint32_t requested = 0, fallback = 0;
};

// Pages keep their slots while they are not needed, until others need them; then those go first that were
// needed longest ago. Which pages are resident follows from the marks alone, never from what was drawn
// before.
class ClipmapCache {
public:
    explicit ClipmapCache(std::uint32_t slots) : slots_(slots) {}

    // `marks`: a bit for each ClipmapPage. Where the pool does not hold all marked pages, those of the finest
    // level that share a parent are replaced by it, the farthest from the centre first, level after level;
    // with a pool of one page the whole scene's serves everything. Pages of another grid are forgotten.
    ServedPages serve(const Clipmap& clipmap, std::span<const gpu::uint> marks);

    // Of pages that serve() has given a slot: those that must be drawn, and that they have been.
    std::vector<PageDraw> stale(std::span<const PageDraw> pages) const;
    void drawn(const PageDraw& page);

    // Something has moved in, into or out of this part of light space (of the world's origin): pages that
    // read it must be drawn anew.
    void moved(const glm::dvec2& lower, const glm::dvec2& upper);

    std::uint32_t slots() const { return slots_; }

private:
    struct Held {
        std::uint32_t slot = 0;
        std::uint64_t needed = 0;  // the last serve() that it was for
        bool drawn = false;
    };
    std::uint32_t take(const PageAddress& page);

    std::uint32_t slots_;
    std::uint64_t serves_ = 0;
    std::optional<PageGrid> grid_;
    std::map<PageAddress, Held> held_;
};

}  // namespace diptych
