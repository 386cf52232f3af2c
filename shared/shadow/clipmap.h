// SPDX-License-Identifier: MIT
// Levels and pages of the sun's clipmap (Tanner, Migdal and Jones 1998, "The Clipmap: A Virtual Mipmap";
// as a shadow map Lloyd et al. 2006). In double and metres.
#pragma once

#include "shared/contract/clipmap.h"
#include "shared/shadow/cascades.h"

#include <glm/gtc/type_precision.hpp>

#include <compare>
#include <cstdint>
#include <vector>

namespace diptych {

// User settings.
struct ClipmapRequest {
    int size = 2048;    // texels across a level; at least 4 pages
    int page = 128;     // texels along a page's side: a power of two
    int kernel = 3;     // side of the filter, texels
    double bias = 0.5;  // texels, along the geometric normal
};

// Address of a page in the whole clipmap: its level by the side, 2^exponent m, and its lower corner in
// pages, in light space relative to the world's origin.
struct PageAddress {
    static constexpr int whole_scene = 1 << 20;  // exponent of the page that covers the whole scene
    int exponent = whole_scene;
    std::int64_t x = 0, y = 0;
    auto operator<=>(const PageAddress&) const = default;
};

// Everything besides casters that affects a page's texels. Pages of equal grids are interchangeable.
struct PageGrid {
    LightSpace space{};
    double near = 0, far = 0;    // z of light space, m, at depths 1 and 0
    glm::dvec2 corner{0};        // of the whole scene's page, m
    double side = 0;             // of that page, m
    int page = 128, gutter = 0;  // texels: of a page's side, and of the border that filters sample on each
                                 // side
    int slot() const { return page + 2 * gutter; }
    // A page with its gutter, as a cascade.
    CascadeArea areaOf(const PageAddress& page) const;
    bool operator==(const PageGrid&) const = default;
};

// Window of pages around the camera, for one level.
struct ClipmapLevel {
    int exponent = PageAddress::whole_scene;
    glm::i64vec2 first{0};  // its page with the lowest coordinates
    CascadeArea area{};     // begins at `first`; end: distance from the centre up to which the level is
                            // requested
};

struct Clipmap {
    PageGrid grid{};
    glm::dvec3 centre{0};                // world; of all windows
    int width = 0;                       // pages along a window's side
    std::vector<ClipmapLevel> levels{};  // fine to coarse; the last is the whole scene's single page

    // Number of pages in all windows, in the order of ClipmapPage in shaders; the last is the whole
    // scene's.
    std::size_t pages() const;
    struct Place {
        std::size_t level = 0;
        int x = 0, y = 0;  // in the level's window
    };
    Place placeOf(std::size_t page) const;
    std::size_t numberOf(const Place& place) const;
    PageAddress addressOf(const Place& place) const;
    // Page of the next level that covers it; the whole scene's page is its own parent.
    Place parentOf(const Place& place) const;
};

// `bounds`: of all casters and receivers. Windows are centred at the camera, or for an orthographic view
// at the centre of the scene along its axis. A level is requested up to half its window's width away.
// Level 0 resolves the nearest possible receiver: at the near plane, at the scene's distance, or over the
// whole width of an orthographic image. It is no finer than float32 positions and depths allow. The depth
// range is the scene's, rounded to steps, and does not follow the camera.
Clipmap fitClipmap(const View& view, const Bounds& bounds, const glm::dvec3& to_light,
                   const ClipmapRequest& request);

// For shaders: parameters shared by all levels, and the levels.
gpu::Clipmap gpuClipmap(const Clipmap& clipmap, const glm::dvec3& eye);
Cascades cascadesOf(const Clipmap& clipmap);

}  // namespace diptych
