// SPDX-License-Identifier: MIT
#include "shared/scene/gltf/motion.h"

#include "shared/scene/gltf/value.h"
#include "shared/text/fail.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace diptych::gltf {

namespace {

struct SkinReader : MotionSource {
    void read() {
        std::map<int, int> skin_index;  // the file's skin -> index in Scene::skins
        const std::size_t before = scene.notes.size();
        for (std::size_t n = 0; n < model.nodes.size(); ++n) {
            const tinygltf::Node& file = model.nodes[n];
            if (scene_node[n] < 0 || file.skin < 0 || file.mesh < 0) continue;
            if (!hasJoints(file.mesh)) {
                scene.notes.push_back(
                    fmt::format("node {}: has a skin, but its mesh has no JOINTS_0: drawn unskinned", n));
                continue;
            }
            const auto [at, fresh] = skin_index.emplace(file.skin, static_cast<int>(scene.skins.size()));
            if (fresh) scene.skins.push_back(skin(file.skin));
            nodeOf(n).skin = at->second;
        }
        limitNotes(scene.notes, before, "skins");
    }

private:
    bool hasJoints(int mesh) const {
        const auto& primitives = model.meshes[static_cast<std::size_t>(mesh)].primitives;
        return std::any_of(primitives.begin(), primitives.end(), [](const tinygltf::Primitive& p) {
            return p.attributes.contains("JOINTS_0") || p.attributes.contains("WEIGHTS_0");
        });
    }

    Skin skin(int index) {
        const tinygltf::Skin& file = model.skins[static_cast<std::size_t>(index)];
        const std::string who = fmt::format("skin {}", index);
        Skin result;
        result.name = file.name;
        if (file.joints.empty()) fail(who, "has no joints");
        for (const int joint : file.joints) {
            result.joints.push_back(scene_node[static_cast<std::size_t>(joint)]);
            if (result.joints.back() < 0)
                fail(who, fmt::format("joint node {} is not in the drawn scene", joint));
        }
        // The skeleton is only a hint; it is dropped if it is outside the scene.
        if (file.skeleton >= 0) result.skeleton = scene_node[static_cast<std::size_t>(file.skeleton)];
        result.joint_from_mesh.assign(result.joints.size(), glm::mat4(1.0f));
        if (file.inverseBindMatrices >= 0)
            readMatrices(file.inverseBindMatrices, who, result.joint_from_mesh);
        return result;
    }

    void readMatrices(int accessor, const std::string& skin, std::vector<glm::mat4>& matrices) {
        const std::string who = skin + ": inverseBindMatrices";
        const Numbers read = budget.read(model, accessor, who);
        if (read.width != 16 || read.component_type != TINYGLTF_COMPONENT_TYPE_FLOAT)
            fail(who, fmt::format("accessor {} is not MAT4 of floats", accessor));
        if (read.count < matrices.size())
            fail(who, fmt::format("{} matrices for {} joints", read.count, matrices.size()));
        for (std::size_t j = 0; j < matrices.size(); ++j) {
            for (std::size_t i = 0; i < 16; ++i) {
                const float value = read.values[16 * j + i];
                if (!std::isfinite(value)) fail(who, fmt::format("matrix {} is not finite", j));
                matrices[j][static_cast<int>(i / 4)][static_cast<int>(i % 4)] = value;
            }
            // Exporters round; 1e-4 is far above rounding and far below visibility.
            for (int c = 0; c < 4; ++c) {
                const float last = c == 3 ? 1.0f : 0.0f;
                if (std::abs(matrices[j][c][3] - last) > 1e-4f)
                    fail(who, fmt::format("the last row of matrix {} is not 0 0 0 1", j));
                matrices[j][c][3] = last;
            }
        }
    }
};

void readNodeWeights(const MotionSource& source) {
    const Model& model = source.model;
    for (std::size_t n = 0; n < model.nodes.size(); ++n) {
        const tinygltf::Node& file = model.nodes[n];
        if (source.scene_node[n] < 0 || file.weights.empty() || file.mesh < 0) continue;
        const std::string who = fmt::format("node {}", n);
        if (model.meshes[static_cast<std::size_t>(file.mesh)].primitives.empty()) continue;  // omitted
        source.nodeOf(n).weights = static_cast<int>(source.scene.weights.size());
        source.scene.weights.push_back(targetWeights(file.weights, targetsOf(model, file), who));
    }
}

}  // namespace

void readMotion(const Model& model, const std::vector<int>& sceneNode, Scene& scene) {
    MotionBudget budget(model);
    const MotionSource source{model, sceneNode, scene, budget};
    SkinReader{source}.read();
    readNodeWeights(source);
    readInstancing(source);
    readAnimations(source);
}

}  // namespace diptych::gltf
