// SPDX-License-Identifier: MIT
#include "shared/scene/gltf/motion.h"

#include "shared/scene/gltf/accessor.h"
#include "shared/scene/gltf/animation.h"
#include "shared/scene/gltf/instancing.h"
#include "shared/scene/gltf/motion_budget.h"
#include "shared/scene/gltf/value.h"
#include "shared/text/counted.h"
#include "shared/text/fail.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace diptych::gltf {

namespace {

class SkinReader {
public:
    SkinReader(const Model& model, const std::vector<int>& sceneNode, MotionBudget& budget, Scene& scene)
        : model_(model), scene_node_(sceneNode), budget_(budget), scene_(scene) {}

    void read() {
        std::map<int, int> place;  // the file's skin -> index in Scene::skins
        const std::size_t before = scene_.notes.size();
        for (std::size_t n = 0; n < model_.nodes.size(); ++n) {
            const tinygltf::Node& file = model_.nodes[n];
            if (scene_node_[n] < 0 || file.skin < 0 || file.mesh < 0) continue;
            if (!hasJoints(file.mesh)) {
                scene_.notes.push_back(
                    fmt::format("node {}: has a skin, but its mesh has no JOINTS_0: drawn unskinned", n));
                continue;
            }
            const auto [at, fresh] = place.emplace(file.skin, static_cast<int>(scene_.skins.size()));
            if (fresh) scene_.skins.push_back(skin(file.skin));
            scene_.nodes[static_cast<std::size_t>(scene_node_[n])].skin = at->second;
        }
        limitNotes(scene_.notes, before, "skins");
    }

private:
    const Model& model_;
    const std::vector<int>& scene_node_;
    MotionBudget& budget_;
    Scene& scene_;

    bool hasJoints(int mesh) const {
        const auto& primitives = model_.meshes[static_cast<std::size_t>(mesh)].primitives;
        return std::any_of(primitives.begin(), primitives.end(), [](const tinygltf::Primitive& p) {
            return p.attributes.contains("JOINTS_0") || p.attributes.contains("WEIGHTS_0");
        });
    }

    Skin skin(int index) {
        const tinygltf::Skin& file = model_.skins[static_cast<std::size_t>(index)];
        const std::string who = fmt::format("skin {}", index);
        Skin result;
        result.name = file.name;
        if (file.joints.empty()) fail(who, "has no joints");
        for (const int joint : file.joints) {
            result.joints.push_back(scene_node_[static_cast<std::size_t>(joint)]);
            if (result.joints.back() < 0)
                fail(who, fmt::format("joint node {} is not in the drawn scene", joint));
        }
        // The skeleton is only a hint; it is dropped if it is outside the scene.
        if (file.skeleton >= 0) result.skeleton = scene_node_[static_cast<std::size_t>(file.skeleton)];
        result.joint_from_mesh.assign(result.joints.size(), glm::mat4(1.0f));
        if (file.inverseBindMatrices >= 0)
            readMatrices(file.inverseBindMatrices, who, result.joint_from_mesh);
        return result;
    }

    void readMatrices(int accessor, const std::string& skin, std::vector<glm::mat4>& matrices) {
        const std::string who = skin + ": inverseBindMatrices";
        const Numbers read = budget_.read(model_, accessor, who);
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

void readNodeWeights(const Model& model, const std::vector<int>& sceneNode, Scene& scene) {
    for (std::size_t n = 0; n < model.nodes.size(); ++n) {
        const tinygltf::Node& file = model.nodes[n];
        if (sceneNode[n] < 0 || file.weights.empty() || file.mesh < 0) continue;
        const std::string who = fmt::format("node {}", n);
        if (model.meshes[static_cast<std::size_t>(file.mesh)].primitives.empty()) continue;  // omitted
        const std::size_t targets = targetsOf(model, file);
        if (file.weights.size() != targets)
            fail(who, fmt::format("{} for {}", counted(file.weights.size(), "weight"),
                                  counted(targets, "morph target")));
        std::vector<float> weights(file.weights.begin(), file.weights.end());
        scene.nodes[static_cast<std::size_t>(sceneNode[n])].weights = static_cast<int>(scene.weights.size());
        scene.weights.push_back(std::move(weights));
    }
}

}  // namespace

void readMotion(const Model& model, const std::vector<int>& sceneNode, Scene& scene) {
    MotionBudget budget(model);
    SkinReader(model, sceneNode, budget, scene).read();
    readNodeWeights(model, sceneNode, scene);
    readInstancing(model, sceneNode, budget, scene);
    readAnimations(model, sceneNode, budget, scene);
}

}  // namespace diptych::gltf
