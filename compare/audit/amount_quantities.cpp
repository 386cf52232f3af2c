// SPDX-License-Identifier: MIT
#include "compare/audit/quantities.h"
#include "compare/audit/small_scene.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace diptych::audit {

namespace {

constexpr double maxCopies = 3000;
// Lights times pixels of an image; one second of lavapipe if every pixel evaluates every light.
constexpr double maxLit = 1e8;

// A side of an image, in whole pixels.
int wholePixels(double pixels) {
    return std::max(1, static_cast<int>(std::lround(pixels)));
}

// An image size of the same aspect ratio for which this many lights are affordable; equal at every
// magnitude.
Size sizeForLights(const Subject& subject) {
    const Size size = subject.original.settings.size;
    const double pixels = static_cast<double>(size.width) * size.height;
    const auto local = static_cast<double>(std::ranges::count_if(subject.original.scene.lights, isLocal));
    const double part = std::sqrt(std::min(1.0, maxLit / (maxCopies * local * pixels)));
    return {wholePixels(size.width * part), wholePixels(size.height * part)};
}

// This many copies of every local light, sharing its intensity, so that the image stays the same.
void applyLights(Case& changed, const Subject& subject, double copies) {
    const auto count = static_cast<std::size_t>(copies);
    changed.settings.size = sizeForLights(subject);
    std::vector<Light> lights;
    for (Light light : changed.scene.lights) {
        if (isLocal(light)) light.intensity = static_cast<float>(light.intensity / copies);
        lights.insert(lights.end(), isLocal(light) ? count : 1, light);
    }
    changed.scene.lights = std::move(lights);
}

// float32 sums, in order: each addition rounds to 2^-24 of the sum so far. Equal terms round one way while
// the sum has one exponent, half as far on average, and the other way in every second exponent.
Predicted predictLights(const Subject& subject, const Settings&, double error) {
    const auto reaching =
        static_cast<double>(std::ranges::count_if(subject.original.scene.lights, [&](const Light& light) {
            return isLocal(light) && glm::distance(light.position, subject.point) < double{light.range};
        }));
    return {
        .up = error * 0x1p26 / std::max(reaching, 1.0),
        .because = "float32 sums one light after another: N equal terms have a relative error of N 2^-26"};
}

// Splits every triangle into n x n similar ones.
Primitive divided(const Primitive& whole, int n) {
    Primitive parts = withoutVertices(whole);
    for (std::size_t t = 0; t + 2 < whole.indices.size(); t += 3) {
        const std::uint32_t a = whole.indices[t], b = whole.indices[t + 1], c = whole.indices[t + 2];
        const auto first = static_cast<std::uint32_t>(parts.positions.size());
        const auto at = [&](int row, int column) {
            return first + static_cast<std::uint32_t>(row * (row + 1) / 2 + column);
        };
        for (int row = 0; row <= n; ++row)
            for (int column = 0; column <= row; ++column) {
                const auto down = static_cast<float>(row) / static_cast<float>(n),
                           across = static_cast<float>(column) / static_cast<float>(n);
                const glm::vec3 weights{1 - down, down - across, across};
                eachAttribute(parts, whole, [&](auto& to, const auto& from) {
                    to.push_back(from[a] * weights.x + from[b] * weights.y + from[c] * weights.z);
                });
                parts.normals.back() = glm::normalize(parts.normals.back());
                parts.tangents.back().w = whole.tangents[a].w;
                if (row == n) continue;
                parts.indices.insert(parts.indices.end(),
                                     {at(row, column), at(row + 1, column), at(row + 1, column + 1)});
                if (column < row)
                    parts.indices.insert(parts.indices.end(),
                                         {at(row, column), at(row + 1, column + 1), at(row, column + 1)});
            }
    }
    return parts;
}

void applyTriangles(Case& changed, const Subject& subject, double triangles) {
    const double each =
        triangles / static_cast<double>(std::max<std::size_t>(triangleCount(subject.original.scene), 1));
    const int n = static_cast<int>(std::lround(std::sqrt(std::max(each, 1.0))));
    if (n < 2) return;
    for (Mesh& mesh : changed.scene.meshes)
        for (Primitive& primitive : mesh.primitives)
            if (isRigid(primitive)) primitive = divided(primitive, n);
}

std::string lacksRigid(const Subject& subject) {
    for (const Mesh& mesh : subject.original.scene.meshes)
        if (std::ranges::any_of(mesh.primitives, isRigid)) return {};
    return "every mesh of the scene is skinned or morphed";
}

void applySize(Case& changed, const Subject& subject, double height) {
    const double aspect = static_cast<double>(subject.view.width) / subject.view.height;
    changed.settings.size = {wholePixels(aspect * height), wholePixels(height)};
}

}  // namespace

std::vector<Quantity> amountQuantities() {
    return {
        {.name = "lights",
         .what = "number of copies of every local light, which share its intensity",
         .magnitudes = {1, 10, 100, 1000, maxCopies},
         .lacks = {lacksLocalLight},
         .apply = applyLights,
         .variants = {{"assign", "tiled"}, {"assign", "every"}},
         .same_image = true,
         .whole = true,
         .predict = predictLights},
        {.name = "triangles",
         .what = "number of triangles, by subdividing the scene's own",
         .magnitudes = ladder(1e2, 1e6),
         .original =
             [](const Subject& subject) {
                 return static_cast<double>(triangleCount(subject.original.scene));
             },
         .lacks = {lacksRigid},
         .apply = applyTriangles,
         .whole = true,
         .because = "new corners are float32 as the old ones are, and indices have 32 bits"},
        {.name = "size",
         .unit = "pixels",
         .what = "the picture's height at the same aspect ratio",
         .magnitudes = {1, 2, 4, 9, 18, 45, 90, 180, 360, 720},
         .original = [](const Subject& subject) { return double(subject.view.height); },
         .apply = applySize,
         .whole = true,
         .because = "pixel coordinates are float32, exact up to 2^24; a picture's side has at "
                    "most 2^14 pixels"},
        {.name = "time",
         .unit = "s",
         .what = "the animation time",
         .magnitudes = ladder(1e-3, 1e6, 10, {0}),
         .original = [](const Subject& subject) { return subject.original.settings.time; },
         .lacks = {[](const Subject& subject) -> std::string {
             return subject.moves ? "" : "nothing in the scene is animated";
         }},
         .apply = [](Case& changed, const Subject&, double seconds) { changed.settings.time = seconds; },
         .because = "time is double, which resolves 1e-10 s at 1e6 s, and nothing moves after the last key"},
    };
}

}  // namespace diptych::audit
