// SPDX-License-Identifier: MIT
// Scenes of random skinned and morphed meshes.
#pragma once

#include "shared/scene/model/scene.h"
#include "shared/scene/model/tangents.h"

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

namespace diptych {

struct PosingChoice {
    int joints = 6, joint_sets = 0;  // no joint sets: no skin
    int targets = 0;
    bool flat = false;
    bool fresh_tangents = false;  // made by makeTangents; targets bend the surface only slightly
    int map_texcoord = 0;
    double size = 1;            // m, of the mesh
    glm::dvec3 offset{0};       // of the mesh from its own origin, m
    glm::dmat4 root{1.0};       // of all nodes
    double joint_scale = 1;     // of every joint, before a stretch of 4:1 along one axis
    bool inverse_binds = true;  // false: vertices are in each joint's space
    int cells = 7;              // along one side of the surface
};

class PosingBuilder {
public:
    explicit PosingBuilder(unsigned seed) : random_(seed) {}

    double uniform(double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random_);
    }
    int below(int end) { return static_cast<int>(uniform(0, end - 1e-9)); }
    glm::dvec3 vector() { return {uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)}; }

    // One mesh with one primitive, on node 0; node 1 is the root of the joints.
    Scene scene(const PosingChoice& c) {
        Scene scene;
        scene.materials.resize(1);
        TextureSlot& map = scene.materials[0].normal_texture;
        map.texcoord = c.map_texcoord;
        map.u = {0.8, 0.5, 0.1};
        map.v = {0.4, -0.9, 0.2};
        scene.meshes.resize(1);
        scene.meshes[0].primitives = {primitive(c)};
        for (int t = 0; t < c.targets; ++t)
            scene.meshes[0].weights.push_back(t % 5 == 4 ? 0.0f : static_cast<float>(uniform(-1, 2)));
        scene.nodes.resize(2);
        scene.nodes[0].mesh = 0;
        scene.nodes[0].parent_from_node = scene.nodes[1].parent_from_node = c.root;
        if (c.joint_sets > 0) addSkin(scene, c);
        Primitive& p = scene.meshes[0].primitives[0];
        if (c.fresh_tangents) makeTangents(p, map);
        return scene;
    }

    // A second skin with as many new joints, and a node that uses the mesh with it.
    void addSkin(Scene& scene, const PosingChoice& c) {
        Skin skin;
        for (int j = 0; j < c.joints; ++j) {
            skin.joints.push_back(static_cast<int>(scene.nodes.size()));
            const glm::dmat4 from_joint = glm::translate(glm::dmat4(1), c.offset + c.size * 0.4 * vector());
            skin.joint_from_mesh.push_back(c.inverse_binds ? glm::mat4(glm::inverse(from_joint))
                                                           : glm::mat4(1));
            Node joint;
            joint.parent = 1;
            glm::dvec3 stretch(0.5);
            stretch[below(3)] = 2;
            joint.parent_from_node =
                (c.inverse_binds ? from_joint : glm::dmat4(1)) *
                glm::mat4_cast(glm::angleAxis(uniform(0, glm::radians(90.0)), glm::normalize(vector())));
            joint.parent_from_node =
                glm::scale(joint.parent_from_node, c.joint_scale * (j == 0 ? stretch : glm::dvec3(1)));
            scene.nodes.push_back(joint);
        }
        if (!scene.skins.empty()) {
            scene.nodes.emplace_back();
            scene.nodes.back().mesh = 0;
        }
        (scene.skins.empty() ? scene.nodes[0] : scene.nodes.back()).skin =
            static_cast<int>(scene.skins.size());
        scene.skins.push_back(std::move(skin));
    }

private:
    Primitive primitive(const PosingChoice& c) {
        Primitive p;
        p.flat = c.flat;
        const int row = c.cells + 1;
        std::vector<glm::ivec2> corners;
        for (int y = 0; y < c.cells; ++y)
            for (int x = 0; x < c.cells; ++x)
                for (const glm::ivec2 at : {glm::ivec2{0, 0}, {1, 0}, {1, 1}, {0, 0}, {1, 1}, {0, 1}})
                    corners.push_back(glm::ivec2{x, y} + at);
        if (c.flat) {
            for (const glm::ivec2& corner : corners) {
                p.indices.push_back(static_cast<std::uint32_t>(p.positions.size()));
                addVertex(p, c, corner);
            }
            makeFlatNormals(p);
        } else {
            for (int y = 0; y < row; ++y)
                for (int x = 0; x < row; ++x) addVertex(p, c, {x, y});
            for (const glm::ivec2& corner : corners)
                p.indices.push_back(static_cast<std::uint32_t>(corner.y * row + corner.x));
        }
        for (int s = 0; s < c.joint_sets; ++s) p.joint_sets.emplace_back();
        for (std::size_t v = 0; v < p.positions.size(); ++v) addJoints(p, c);
        for (int t = 0; t < c.targets; ++t) p.targets.push_back(target(p, c, t));
        return p;
    }

    static double wave(const glm::dvec2& at, double shift) {
        return std::sin(3.1 * at.x + 2.3 * at.y + 1.7 * shift);
    }
    void addVertex(Primitive& p, const PosingChoice& c, const glm::ivec2& corner) {
        const glm::dvec2 at = glm::dvec2(corner) / double(c.cells);
        p.positions.emplace_back(c.offset +
                                 c.size * glm::dvec3(at - 0.5, 0.1 * wave(at, 0) + 0.04 * wave(at, 7)));
        const glm::dvec3 normal = glm::normalize(glm::dvec3(0.3 * wave(at, 1), 0.3 * wave(at, 2), 1));
        p.normals.emplace_back(normal);
        p.tangents.emplace_back(
            glm::normalize(glm::cross(glm::normalize(glm::dvec3(0.2 * wave(at, 3), 1, 0.1)), normal)),
            c.fresh_tangents || corner.x % 2 == 0 ? 1 : -1);
        p.texcoords[0].emplace_back(at);
        p.texcoords[1].emplace_back(at.y + 0.1 * at.x, 0.7 * at.x);
        p.colors.emplace_back(0.5 + 0.5 * wave(at, 4), at, 0.5);
    }

    // Weights over all sets, some of them zero. They sum to 1 up to float32 rounding.
    void addJoints(Primitive& p, const PosingChoice& c) {
        std::vector<double> weights(static_cast<std::size_t>(4 * c.joint_sets));
        double whole = 0;
        for (double& w : weights) whole += w = uniform(0, 1) < 0.4 ? 0 : uniform(0.01, 1);
        if (!weights.empty() && whole == 0) whole = weights[0] = 1;
        for (std::size_t s = 0; s < p.joint_sets.size(); ++s) {
            glm::u16vec4 joints{0};
            glm::vec4 fraction{0};
            for (int i = 0; i < 4; ++i) {
                fraction[i] = static_cast<float>(weights[4 * s + static_cast<std::size_t>(i)] / whole);
                if (fraction[i] > 0) joints[i] = static_cast<std::uint16_t>(below(c.joints));
            }
            p.joint_sets[s].joints.push_back(joints);
            p.joint_sets[s].weights.push_back(fraction);
        }
    }

    // Except with fresh tangents, every target but the first lacks some attributes.
    MorphTarget target(const Primitive& p, const PosingChoice& c, int number) {
        MorphTarget target;
        const auto has = [&](int attribute) {
            return c.fresh_tangents || number == 0 || (number + attribute) % 3 != 0;
        };
        // Fresh tangents need a smooth displacement, which keeps the triangles of a flat primitive connected.
        const double max = c.fresh_tangents ? 0.05 : 0.3 / std::sqrt(c.targets);
        for (std::size_t v = 0; v < p.positions.size(); ++v) {
            const glm::dvec2 at(p.texcoords[0][v]);
            const auto by = [&](int attribute) {
                return max * (c.fresh_tangents ? wave(at, number + 1.3 * attribute) : uniform(-1, 1));
            };
            if (has(0)) target.positions.emplace_back(c.size * glm::dvec3(by(0), by(1), by(2)));
            if (has(1)) target.normals.emplace_back(by(3), by(4), by(5));
            if (has(2) && !c.fresh_tangents) target.tangents.emplace_back(by(6), by(7), by(8));
            if (has(3)) target.texcoords[0].emplace_back(0.3 * by(9), 0.3 * by(10));
            if (has(4)) target.texcoords[1].emplace_back(0.3 * by(11), 0.3 * by(12));
            if (has(5)) target.colors.emplace_back(3 * by(13), by(14), by(15), by(16));
        }
        return target;
    }

    std::mt19937 random_;
};

}  // namespace diptych
