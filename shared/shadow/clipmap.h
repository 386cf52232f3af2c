// SPDX-License-Identifier: MIT
// Where the levels and pages of the sun's clipmap lie (Tanner, Migdal and Jones 1998, "The Clipmap: A Virtual
// Mipmap"; as a shadow map Lloyd et al. 2006). Everything is in double and in metres.
#pragma once

#include "shared/contract/clipmap.h"
#include "shared/shadow/cascades.h"

#include <glm/gtc/type_precision.hpp>

#include <compare>
#include <cstdint>
#include <vector>

namespace diptych {

// What the user chooses.
struct ClipmapRequest {
    int size = 2048;    // texels over which a level reaches; at least 4 pages
    int page = 128;     // texels of a page's side: a power of two
    int kernel = 3;     // side of the filter, texels
    double bias = 0.5;  // texels, along the geometric normal
};

// A page of all that there are: its level by its side, 2^exponent m, and its place in the light space of the
// world's origin, by its lower corner in pages.
struct PageAddress {
    static constexpr int whole_scene = 1 << 20;  // the exponent of the one page that covers everything
    int exponent = whole_scene;
    std::int64_t x = 0, y = 0;
    auto operator<=>(const PageAddress&) const = default;
};

// What a page's texels depend on beside what casts. Pages of equal grids are interchangeable.
struct PageGrid {
    LightSpace space{};
    double near = 0, far = 0;    // z of light space, m: of the depths 1 and 0
    glm::dvec2 corner{0};        // of the whole scene's page, m
    double side = 0;             // of that page, m
    int page = 128, gutter = 0;  // texels: of a page's side, and what filters read beyond it on each side
    int slot() const { return page + 2 * gutter; }
    // A page with its gutter, as a cascade.
    CascadeArea areaOf(const PageAddress& page) const;
    bool operator==(const PageGrid&) const = default;
};

// A level's window of pages around the camera.
struct ClipmapLevel {
    int exponent = PageAddress::whole_scene;
    glm::i64vec2 first{0};  // its lowest page
    CascadeArea area{};     // begins at `first`; end: distance from the centre up to which the level serves
};

struct Clipmap {
    PageGrid grid{};
    glm::dvec3 centre{0};                // world: of all windows
    int width = 0;                       // pages of a window's side
    std::vector<ClipmapLevel> levels{};  // fine to coarse; the last is the whole scene's, of one page

    // Pages of all windows, in the order of the shaders' ClipmapPage; the whole scene's is the last.
    std::size_t pages() const;
    struct Place {
        std::size_t level = 0;
        int x = 0, y = 0;  // in the level's window
    };
    Place placeOf(std::size_t page) const;
    std::size_t numberOf(const Place& place) const;
    PageAddress addressOf(const Place& place) const;
    // The page of the next level that covers it; the whole scene's of that itself.
    Place parentOf(const Place& place) const;
};

// `bounds`: of everything that casts or receives. Windows are centred on the camera, or where it is
// orthographic on the middle of what lies along its axis, and a level serves up to half its window's width
// away. Level 0 is as fine as what can be nearest needs: at the near plane, or the scene's distance, or over
// the whole width of an orthographic picture; but no finer than positions and depths in float32 are.
// The depth range is the scene's, in steps, and does not follow the camera.
Clipmap fitClipmap(const View& view, const Bounds& bounds, const glm::dvec3& to_light,
                   const ClipmapRequest& request);

// For the shaders: what all levels share, and the levels.
gpu::Clipmap gpuClipmap(const Clipmap& clipmap, const glm::dvec3& eye);
Cascades cascadesOf(const Clipmap& clipmap);

}  // namespace diptych
