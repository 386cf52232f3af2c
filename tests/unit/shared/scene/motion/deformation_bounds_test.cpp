// SPDX-License-Identifier: MIT
// Bounding boxes of deformed vertices, compared with vertices deformed one by one.
#include "shared/scene/motion/deformation_bounds.h"

#include "shared/scene/load.h"
#include "shared/scene/motion/pose.h"
#include "shared/scene/motion/posed.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <random>
#include <string>
#include <vector>

namespace diptych {
namespace {

constexpr int poseCount = 256;

struct PoseBuilder {
    std::mt19937 random{20};
    double uniform(double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random);
    }
    glm::dvec3 vector() { return {uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)}; }
    // Every joint is rotated by up to 90 degrees around any axis. One joint per skin is stretched 4:1
    // along any of its axes. Target weights are -1 to 2.
    Scene posed(const Scene& rest) {
        Scene scene = rest;
        scene.animations.clear();
        for (const Skin& skin : scene.skins) {
            const auto stretched =
                static_cast<std::size_t>(uniform(0, static_cast<double>(skin.joints.size())));
            for (std::size_t j = 0; j < skin.joints.size(); ++j) {
                glm::dmat4& m = scene.nodes[static_cast<std::size_t>(skin.joints[j])].parent_from_node;
                m *= glm::mat4_cast(glm::angleAxis(uniform(0, glm::radians(90.0)), glm::normalize(vector())));
                if (j != std::min(stretched, skin.joints.size() - 1)) continue;
                glm::dvec3 stretch(0.5);
                stretch[static_cast<int>(uniform(0, 2.999))] = 2;
                m = glm::scale(m, stretch);
            }
        }
        scene.weights.clear();
        for (Node& node : scene.nodes) node.weights = -1;
        for (Mesh& mesh : scene.meshes)
            for (float& weight : mesh.weights) weight = static_cast<float>(uniform(-1, 2));
        return scene;
    }
};

struct Ratios {
    std::vector<double> all;
    double at(double fraction) {
        std::ranges::sort(all);
        return all.at(static_cast<std::size_t>(fraction * static_cast<double>(all.size() - 1)));
    }
    void print(const std::string& name) {
        fmt::print("{}: {} boxes; of the vertices' diagonal: median {:.3f}, 95 % {:.3f}, largest {:.3f}\n",
                   name, all.size(), at(0.5), at(0.95), at(1));
    }
};

// Adds the ratio of the box's diagonal to that of the deformed vertices, for each deformed instance.
void check(const Scene& scene, Ratios& ratios, const std::string& what) {
    const Pose pose = poseAt(scene, 0);
    for (const Instance& instance : pose.instances) {
        if (!instance.deformed()) continue;
        const PosedBox& box = pose.boxes.at(static_cast<std::size_t>(instance.box));
        glm::dvec3 min(1e300), max(-1e300);
        for (const glm::dvec3& p : posedPositions(scene, pose, instance)) {
            min = glm::min(min, p);
            max = glm::max(max, p);
        }
        const double size = glm::length(max - min), near = 1e-5 * size;  // float32 error
        for (int c = 0; c < 3; ++c) {
            ASSERT_GE(min[c] - near, box.origin[c] + box.min[c]) << what << " axis " << c;
            ASSERT_LE(max[c] + near, box.origin[c] + box.max[c]) << what << " axis " << c;
        }
        ratios.all.push_back(glm::length(box.max - box.min) / size);
    }
}

Ratios ofRandomPoses(const Scene& scene, const std::string& what) {
    PoseBuilder builder;
    Ratios ratios;
    for (int i = 0; i < poseCount; ++i)
        check(builder.posed(scene), ratios, fmt::format("{} pose {}", what, i));
    return ratios;
}

// A star of tubes with this number of limbs and joints per limb; weights blend over a fifth of a bone.
// Every vertex has a target of waves and one of growth.
Scene star(int limbs, int jointsOfALimb, int vertices) {
    Scene scene;
    scene.materials.resize(1);
    Primitive p;
    Skin skin;
    scene.nodes.resize(1);
    const int rings = std::max(vertices / limbs / 16, 2);
    for (int l = 0; l < limbs; ++l) {
        // A direction of a spherical Fibonacci lattice.
        const double y = 1 - 2 * (l + 0.5) / limbs, around = 2.399963229728653 * l;
        const glm::dvec3 along(std::sqrt(1 - y * y) * std::cos(around), y,
                               std::sqrt(1 - y * y) * std::sin(around));
        const glm::dvec3 side = glm::normalize(glm::cross(along, glm::dvec3(0.3, 0.5, 0.8))),
                         other = glm::cross(along, side);
        const auto first = static_cast<int>(skin.joints.size());
        for (int j = 0; j < jointsOfALimb; ++j) {
            Node node;
            node.parent = j == 0 ? 0 : static_cast<int>(scene.nodes.size()) - 1;
            const glm::dvec3 step = along / static_cast<double>(jointsOfALimb);
            node.parent_from_node = glm::translate(glm::dmat4(1), j == 0 ? glm::dvec3(0) : step);
            skin.joints.push_back(static_cast<int>(scene.nodes.size()));
            skin.joint_from_mesh.emplace_back(glm::translate(glm::dmat4(1), -step * static_cast<double>(j)));
            scene.nodes.push_back(node);
        }
        for (int r = 0; r < rings; ++r)
            for (int s = 0; s < 16; ++s) {
                const double far = static_cast<double>(r) / (rings - 1), angle = 0.3926990816987241 * s;
                p.positions.emplace_back(far * along +
                                         0.05 * (std::cos(angle) * side + std::sin(angle) * other));
                const double bone = std::min(far * jointsOfALimb, jointsOfALimb - 1e-6);
                const int joint = static_cast<int>(bone);
                const double next =
                    joint + 1 == jointsOfALimb ? 0 : std::clamp((bone - joint - 0.8) / 0.4, 0.0, 1.0);
                const double last = joint == 0 ? 0 : std::clamp(0.5 - (bone - joint) / 0.4, 0.0, 1.0);
                if (p.joint_sets.empty()) p.joint_sets.resize(1);
                p.joint_sets[0].joints.emplace_back(first + joint, next > 0 ? first + joint + 1 : 0,
                                                    last > 0 ? first + joint - 1 : 0, 0);
                p.joint_sets[0].weights.emplace_back(1 - next - last, next, last, 0);
            }
    }
    MorphTarget waves, growth;
    for (const glm::vec3& at : p.positions) {
        waves.positions.push_back(0.05f * glm::sin(7.0f * at));
        growth.positions.push_back(0.2f * at);
    }
    p.targets = {waves, growth};
    const std::size_t count = p.positions.size();
    p.normals.assign(count, {0, 0, 1});
    p.tangents.assign(count, {1, 0, 0, 1});
    p.indices = {0, 1, 2};
    scene.skins = {skin};
    scene.meshes.resize(1);
    scene.meshes[0].primitives = {std::move(p)};
    scene.meshes[0].weights = {0, 0};
    scene.nodes.emplace_back();
    scene.nodes.back().mesh = 0;
    scene.nodes.back().skin = 0;
    prepareDeformationBounds(scene);
    return scene;
}

TEST(DeformationBounds, RandomPosesStayWithinBoxesAtMostTwiceTooLarge) {
    struct Named {
        const char* name;
        Scene scene;
    };
    std::vector<Named> scenes;
    scenes.push_back({"a chain of 8 joints", star(1, 8, 400)});
    scenes.push_back({"six limbs of 5 joints", star(6, 5, 3000)});
    scenes.push_back({"builtin:motion", loadScene("builtin:motion")});
    for (const Named& named : scenes) {
        Ratios ratios = ofRandomPoses(named.scene, named.name);
        ASSERT_GE(ratios.all.size(), static_cast<std::size_t>(poseCount));
        ratios.print(named.name);
        EXPECT_LE(ratios.at(1), 2) << named.name;
    }
}

TEST(DeformationBounds, RandomPosesOfRealScenesToo) {
    const std::filesystem::path folder =
        std::filesystem::path(DIPTYCH_SOURCE_DIR) / "../shared/assets/scenes";
    bool any = false;
    for (const char* file : {"cesium_man/CesiumMan.gltf", "morph_stress_test/morph_stress_test.glb"}) {
        if (!std::filesystem::exists(folder / file)) continue;
        any = true;
        Ratios ratios = ofRandomPoses(loadScene((folder / file).string()), file);
        ratios.print(file);
        EXPECT_LE(ratios.at(1), 2) << file;
    }
    if (!any) GTEST_SKIP() << "there are no scenes in " << folder;
}

// The boxes of a pose cost as much as there are clusters, for any number of vertices.
TEST(DeformationBounds, CostDoesNotGrowWithTheVertices) {
    const auto clusters = [](int vertices) {
        return star(8, 8, vertices).meshes[0].primitives[0].deformation_bounds.clusters.size();
    };
    const std::size_t many = clusters(100000);
    EXPECT_LE(many, 4 * clusters(10000));
    EXPECT_LE(many, 1024u);
}

// Without prepared bounds, every pose would rebuild the clusters.
TEST(DeformationBounds, OfWhatATurnedMapPosesArePrepared) {
    const Scene scene = loadScene("builtin:tangents");
    for (const Instance& instance : poseAt(scene, 1).instances) {
        EXPECT_TRUE(instance.map_rotated);
        EXPECT_FALSE(primitiveOf(scene, instance).deformation_bounds.empty());
    }
}

// Unprepared primitives get the same bounds, and changed ones get up-to-date bounds.
TEST(DeformationBounds, OfAPrimitiveThatWasNotPrepared) {
    Scene scene = star(2, 3, 200), other = scene;
    other.meshes[0].primitives[0].deformation_bounds = {};
    const PosedBox a = poseAt(scene, 0).boxes.at(0), b = poseAt(other, 0).boxes.at(0);
    EXPECT_EQ(a.min, b.min);
    EXPECT_EQ(a.max, b.max);
    for (glm::vec3& p : other.meshes[0].primitives[0].positions) p *= 3;
    const PosedBox c = poseAt(other, 0).boxes.at(0);
    EXPECT_GT(c.max.x - c.min.x, 2 * (a.max.x - a.min.x));
}

// A few vertices are single clusters: their box is exact except for float32 rounding.
TEST(DeformationBounds, OfFewVerticesAreExact) {
    const Scene scene = star(1, 4, 60);
    ASSERT_LT(scene.meshes[0].primitives[0].positions.size(), 64u);
    Ratios ratios = ofRandomPoses(scene, "few");
    EXPECT_LE(ratios.at(1), 1.0001);
}

// Infinite matrices and positions beyond maxCoordinate: the box is finite and contains all drawn vertices.
TEST(DeformationBounds, OfWhatIsOutOfReachAreFinite) {
    Scene scene = star(1, 2, 60);
    scene.nodes[2].parent_from_node = glm::translate(glm::dmat4(1), glm::dvec3(3e18, 0, 0));
    const Pose pose = poseAt(scene, 0);
    const PosedBox& box = pose.boxes.at(0);
    for (const glm::dvec3& p : posedPositions(scene, pose, pose.instances.at(0))) {
        if (std::isnan(p.x)) continue;
        for (int c = 0; c < 3; ++c) {
            EXPECT_GE(p[c], box.origin[c] + box.min[c]);
            EXPECT_LE(p[c], box.origin[c] + box.max[c]);
        }
    }
    EXPECT_LE(box.origin.x + box.max.x, maxCoordinate);
}

}  // namespace
}  // namespace diptych
