// SPDX-License-Identifier: MIT
// A wall of equal tiles with layered materials on chosen fractions of it. Shows what drawing a layer costs.
#include "shared/scene/builtin/scenes.h"
#include "shared/scene/lights/rig.h"
#include "shared/text/fail.h"

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace diptych::builtin {
namespace {

// The wall exactly fills an image of 16:9, m.
constexpr glm::dvec2 wallSize(16, 9);
constexpr std::uint32_t tilesAcross = 20, tilesOfWall = tilesAcross * tilesAcross;  // 4 are 1 %
constexpr double fieldOfView = 60;                                                  // vertical, degrees
constexpr double behindGlass = 0.5;                                                 // m

// A layer added to the plain material of the other tiles.
struct CoverKind {
    const char* name;
    std::uint32_t CoverFractions::*percent;
    void (*put)(Material&);
};
constexpr CoverKind coverKinds[] = {
    {"coated", &CoverFractions::coated,
     [](Material& m) {
         m.clearcoat = 1;
         m.clearcoat_roughness = 0.1f;
     }},
    {"woven", &CoverFractions::woven,
     [](Material& m) {
         m.sheen_color = glm::vec3(0.5f);
         m.sheen_roughness = 0.4f;
     }},
    {"brushed", &CoverFractions::brushed, [](Material& m) { m.anisotropy = 0.8f; }},
    {"glass", &CoverFractions::glass, [](Material& m) { m.transmission = 1; }}};

// Tiles in a fixed scattered order. The hash is a bijection: no two tie.
std::vector<std::uint32_t> scatteredTiles() {
    std::vector<std::uint32_t> tiles(tilesOfWall);
    std::iota(tiles.begin(), tiles.end(), 0u);
    std::ranges::sort(tiles, {}, pcg);
    return tiles;
}

// A sun, and points before the wall. Each pixel is in range of about 3 of 64 and 35 of 1024 lights.
// Positions: the R2 sequence (Roberts 2018, "The Unreasonable Effectiveness of Quasirandom Sequences").
void addLights(Builder& b, std::uint32_t lights) {
    if (lights > 0) b.sun({-0.3, -0.5, -1}, glm::vec3(1), 1);
    for (std::uint32_t i = 1; i < lights; ++i) {
        const double n = i;
        const glm::dvec2 random = glm::fract(0.5 + n * glm::dvec2(0.7548776662466927, 0.5698402909980532));
        const glm::dvec3 color(u01(3 * i), u01(3 * i + 1), u01(3 * i + 2));
        b.point({(random - 0.5) * wallSize, 0.75}, glm::vec3(0.3 + 0.7 * color), 1, 1.5f);
    }
}

}  // namespace

void covered(Builder& b, const CoverFractions& fractions, std::uint32_t lights) {
    const std::uint32_t percent = fractions.coated + fractions.woven + fractions.brushed + fractions.glass;
    if (percent > 100)
        fail(fmt::format(
            "builtin:covered: coated, woven, brushed and glass are {} % together; they take up to 100",
            percent));

    b.scene.background = {0.02f, 0.02f, 0.03f};
    const double eye = 0.5 * wallSize.y / std::tan(glm::radians(0.5 * fieldOfView));
    b.camera("front", {0, 0, eye}, {0, 0, 0}, fieldOfView, 0.1, 100).aspect = wallSize.x / wallSize.y;
    const glm::dvec2 size = wallSize / double{tilesAcross};
    const auto addTile = [&](const char* name) {
        const int material = b.material(name, {glm::vec3(0.5f), 0, 0.4f});
        return b.addMesh(quad({-0.5 * size, 0}, {size.x, 0, 0}, {0, size.y, 0}), material, name);
    };
    const auto put = [&](std::uint32_t tile, int mesh, double distance) {
        const glm::dvec2 cell(tile % tilesAcross, tile / tilesAcross);
        // A more distant tile is larger: it covers the same pixels.
        const double scale = (eye + distance) / eye;
        const glm::dvec2 center = scale * ((cell + 0.5) * size - 0.5 * wallSize);
        b.addNode(fmt::format("tile {}", tile), mesh,
                  at(center.x, center.y, -distance) * scaled(scale, scale, 1));
    };

    const int plain = addTile("plain");
    const std::vector<std::uint32_t> tiles = scatteredTiles();
    std::size_t next = 0;
    for (const CoverKind& kind : coverKinds) {
        if (fractions.*kind.percent == 0) continue;
        const int mesh = addTile(kind.name);
        Material& material = b.last();
        kind.put(material);
        for (const std::size_t end = next + fractions.*kind.percent * tilesOfWall / 100; next < end; ++next) {
            put(tiles[next], mesh, 0);
            if (transmits(material)) put(tiles[next], plain, behindGlass);
        }
    }
    for (; next < tiles.size(); ++next) put(tiles[next], plain, 0);
    addLights(b, lights);
}

}  // namespace diptych::builtin
