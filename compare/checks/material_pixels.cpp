// SPDX-License-Identifier: MIT
#include "compare/checks/material_pixels.h"
#include "shared/scene/motion/bounds.h"

#include <glm/common.hpp>
#include <glm/vector_relational.hpp>

#include <algorithm>
#include <utility>

namespace diptych {
namespace {

PixelBox common(const PixelBox& a, const PixelBox& b) {
    return {std::max(a.x0, b.x0), std::max(a.y0, b.y0), std::min(a.x1, b.x1), std::min(a.y1, b.y1)};
}
void include(PixelBox& box, const PixelBox& more) {
    box = box.empty() ? more
                      : PixelBox{std::min(box.x0, more.x0), std::min(box.y0, more.y0),
                                 std::max(box.x1, more.x1), std::max(box.y1, more.y1)};
}

bool contains(const Bounds& bounds, const glm::dvec3& p) {
    return glm::all(glm::lessThanEqual(bounds.min, p)) && glm::all(glm::lessThanEqual(p, bounds.max));
}
bool contains(const Bounds& bounds, const Bounds& other) {
    return contains(bounds, other.min) && contains(bounds, other.max);
}
bool disjoint(const Bounds& a, const Bounds& b) {
    return glm::any(glm::lessThan(a.max, b.min)) || glm::any(glm::lessThan(b.max, a.min));
}

}  // namespace

void MaterialPixels::Visible::add(std::uint64_t count, const PixelBox& where) {
    pixels += count;
    include(box, where);
}

// IDs are integers below 2^24. Other values, NaN included, become -1: no material.
int MaterialPixels::at(int x, int y) const {
    const float id = ids_.at(x, y);
    return id >= 0 && id < 0x1p24f ? static_cast<int>(id) : -1;
}

glm::dvec3 MaterialPixels::positionAt(int x, int y) const {
    return positions_ ? glm::dvec3(positions_->at(x, y, 0), positions_->at(x, y, 1), positions_->at(x, y, 2))
                      : glm::dvec3(0);
}

MaterialPixels::MaterialPixels(const Image& ids, const Image* positions)
    : ids_(ids), positions_(positions), columns_((ids.width + tile - 1) / tile) {
    std::vector<Entry> here;
    for (int y = 0; y < ids.height; y += tile)
        for (int x = 0; x < ids.width; x += tile) {
            here.clear();
            for (int v = y; v < std::min(y + tile, ids.height); ++v)
                for (int u = x; u < std::min(x + tile, ids.width); ++u) {
                    const int material = at(u, v);
                    if (material < 0) continue;
                    if (here.empty() || here.back().material != material) {
                        const auto known = std::ranges::find(here, material, &Entry::material);
                        if (known == here.end())
                            here.push_back({material, {}, {}});
                        else
                            std::swap(*known, here.back());
                    }
                    Entry& entry = here.back();
                    entry.visible.add(1, {u, v, u + 1, v + 1});
                    const glm::dvec3 p = positionAt(u, v);
                    entry.positions.min = glm::min(entry.positions.min, p);
                    entry.positions.max = glm::max(entry.positions.max, p);
                }
            std::ranges::sort(here, {}, &Entry::material);
            first_.push_back(entries_.size());
            entries_.insert(entries_.end(), here.begin(), here.end());
            if (here.empty()) continue;
            const auto max = static_cast<std::size_t>(here.back().material) + 1;
            if (extents_.size() < max) extents_.resize(max);
            for (const Entry& entry : here)
                include(extents_[static_cast<std::size_t>(entry.material)], entry.visible.box);
        }
    first_.push_back(entries_.size());
}

void MaterialPixels::scan(int material, const PixelBox& box, const Bounds& bounds, Visible& visible) const {
    for (int y = box.y0; y < box.y1; ++y)
        for (int x = box.x0; x < box.x1; ++x)
            if (at(x, y) == material && (!positions_ || contains(bounds, positionAt(x, y))))
                visible.add(1, {x, y, x + 1, y + 1});
}

MaterialPixels::Visible MaterialPixels::within(int material, const PixelBox& allowed,
                                               const Bounds& bounds) const {
    Visible visible;
    if (material < 0 || static_cast<std::size_t>(material) >= extents_.size()) return visible;
    const PixelBox box = common(allowed, extents_[static_cast<std::size_t>(material)]);
    if (box.empty()) return visible;
    for (int row = box.y0 / tile; row * tile < box.y1; ++row)
        for (int column = box.x0 / tile; column * tile < box.x1; ++column) {
            const auto t = static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                           static_cast<std::size_t>(column);
            const auto begin = entries_.begin() + static_cast<std::ptrdiff_t>(first_[t]);
            const auto end = entries_.begin() + static_cast<std::ptrdiff_t>(first_[t + 1]);
            const auto entry = std::ranges::lower_bound(begin, end, material, {}, &Entry::material);
            if (entry == end || entry->material != material) continue;
            const PixelBox part = common(box, entry->visible.box);
            if (positions_ && disjoint(bounds, entry->positions)) continue;
            if (part == entry->visible.box && (!positions_ || contains(bounds, entry->positions)))
                visible.add(entry->visible.pixels, part);
            else
                scan(material, part, bounds, visible);
        }
    return visible;
}

}  // namespace diptych
