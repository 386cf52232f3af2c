// SPDX-License-Identifier: MIT
// Small scenes whose visual checks are known by hand.
#pragma once

#include "compare/checks/visual_checks.h"
#include "shared/scene/view.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace diptych {

inline void PrintTo(const PixelBox& b, std::ostream* out) {
    *out << b.x0 << "," << b.y0 << " " << b.x1 << "," << b.y1;
}

inline constexpr double infinity = std::numeric_limits<double>::infinity();

// 200 x 100 pixels, from the origin along -Z, vertical field of view 90 degrees. Point (x, y, -d) projects
// to
// (100 + 50 x / d, 50 - 50 y / d): at distance d the view is 4 d wide and 2 d high, in metres.
inline View viewOf(double near = 1, double far = infinity) {
    View view{Camera{}, 200, 100};
    view.camera.yfov = std::acos(0.0);
    view.camera.near = near;
    view.camera.far = far;
    return view;
}

inline Primitive shapeOf(std::vector<glm::vec3> positions) {
    Primitive p;
    p.normals.assign(positions.size(), {0, 0, 1});
    p.tangents.assign(positions.size(), {1, 0, 0, 1});
    for (std::uint32_t i = 2; i < positions.size(); ++i) p.indices.insert(p.indices.end(), {0, i - 1, i});
    p.positions = std::move(positions);
    return p;
}
// 2 m square centred at (x, y), facing +Z; texture coordinates from 0 to 1.
inline Primitive squareAt(float x, float y, float z) {
    Primitive p = shapeOf({{x - 1, y - 1, z}, {x + 1, y - 1, z}, {x + 1, y + 1, z}, {x - 1, y + 1, z}});
    p.texcoords[0] = p.texcoords[1] = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
    return p;
}

// One node with a mesh of one primitive. The material's only feature: it is double-sided.
inline Scene sceneOf(Primitive primitive) {
    Scene scene;
    scene.materials.resize(1);
    scene.materials[0].double_sided = true;
    scene.meshes.push_back({"mesh", {std::move(primitive)}});
    scene.nodes.emplace_back().mesh = 0;
    return scene;
}
// As sceneOf(), without any feature, and with a texture for a slot to read.
inline Scene plainScene() {
    Scene scene = sceneOf(squareAt(0, 0, -2));
    scene.materials[0].double_sided = false;
    scene.images.push_back({"image", 1, 1, {255, 255, 255, 255}});
    scene.textures.push_back({0, {}});
    return scene;
}

inline std::vector<FeatureChecks> checksIn(const Scene& scene, const View& view, const Image* ids = nullptr,
                                           const Image* positions = nullptr) {
    return visualChecksOf(scene, poseAt(scene, 0), view, ids, positions);
}

// The boxes of a scene with at most one feature.
inline std::vector<PixelBox> boxesOf(const std::vector<FeatureChecks>& features) {
    EXPECT_LE(features.size(), 1u);
    std::vector<PixelBox> boxes;
    for (const FeatureChecks& feature : features)
        for (const VisualCheck& check : feature.checks) boxes.push_back(check.box);
    return boxes;
}
using Boxes = std::vector<PixelBox>;

inline std::string what(const Scene& scene, const std::string& feature) {
    for (const FeatureChecks& checks : checksIn(scene, viewOf()))
        if (checks.feature == feature) return checks.checks.at(0).what;
    return "";
}
inline std::set<std::string> featuresIn(const Scene& scene) {
    std::set<std::string> names;
    for (const FeatureChecks& checks : checksIn(scene, viewOf())) names.emplace(checks.feature);
    return names;
}

}  // namespace diptych
