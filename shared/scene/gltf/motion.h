// SPDX-License-Identifier: MIT
// Helpers that read skins, animations and instances, and the budget of their decoded bytes.
#pragma once

#include "shared/scene/gltf/accessor.h"
#include "shared/scene/gltf/limits.h"
#include "shared/scene/gltf/model.h"
#include "shared/scene/model/scene.h"
#include "shared/text/counted.h"
#include "shared/text/fail.h"

#include <fmt/format.h>

#include <cstddef>
#include <string>
#include <vector>

namespace diptych::gltf {

// Number of morph targets.
inline std::size_t targetsOf(const tinygltf::Mesh& mesh) {
    return mesh.primitives.empty() ? 0 : mesh.primitives[0].targets.size();
}
inline std::size_t targetsOf(const Model& model, const tinygltf::Node& node) {
    return node.mesh < 0 ? 0 : targetsOf(model.meshes[static_cast<std::size_t>(node.mesh)]);
}

// Limits the memory of decoded animation data over the whole file.
class MotionBudget {
public:
    explicit MotionBudget(const Model& model)
        : left_(FREE_DECODED_BYTES + model.dataBytes() * DECODED_BYTES_PER_BYTE) {}
    Numbers read(const Model& model, int accessor, const std::string& who) {
        // Upper bound: the widest element is MAT4, and sparse elements are visited twice.
        const std::size_t count = soundCount(model, accessor, who);
        hold(2 * 16 * sizeof(float), count, who, "keys or matrices");
        return readNumbers(model, accessor, who);
    }
    void hold(std::size_t bytesEach, std::size_t count, const std::string& who, const char* what) {
        if (count > left_ / bytesEach)
            fail(who, fmt::format("{} more {} exceed the memory limit", count, what));
        left_ -= bytesEach * count;
    }

private:
    std::size_t left_;
};

// Weights of that many morph targets. Throws std::runtime_error if there is another number of them.
inline std::vector<float> targetWeights(const std::vector<double>& weights, std::size_t targets,
                                        const std::string& who) {
    if (weights.size() != targets)
        fail(who,
             fmt::format("{} for {}", counted(weights.size(), "weight"), counted(targets, "morph target")));
    return {weights.begin(), weights.end()};
}

// A file, and the scene that receives its motion.
struct MotionSource {
    const Model& model;
    // Index in Scene::nodes of each node of the file; -1: not in the scene.
    const std::vector<int>& scene_node;
    Scene& scene;
    MotionBudget& budget;

    // The scene's node of the file's node.
    Node& nodeOf(std::size_t node) const { return scene.nodes[static_cast<std::size_t>(scene_node[node])]; }
};

// Reads Scene::animations and sets Node::transform of animated nodes. Ignores channels that affect nothing in
// the scene; omits faulty ones with a note. If keys have equal times, the last one counts from that time on,
// which is noted.
void readAnimations(const MotionSource& source);

// EXT_mesh_gpu_instancing: sets Node::copies; call it after skins have been read. Throws std::runtime_error,
// "node 3: ...", for faulty attributes. A skinned mesh is drawn once, with a note: it ignores node transforms
// (glTF 2.0, 3.7.3.3), so its instances would coincide. A rotation 0 0 0 0 means none, as for nodes.
void readInstancing(const MotionSource& source);

// Reads skins, instances and animations, and sets Node::skin, transform, weights and copies.
// `sceneNode[n]` is the index in Scene::nodes of the file's node n, -1 if it is not in the scene. Lights
// and cameras must already be read.
//
// A skin of a drawn mesh must be valid: every joint in the scene, inverse bind matrices finite and affine.
// Otherwise throws std::runtime_error, "skin 0: ...". Channels of nodes outside the scene are ignored;
// faulty channels are omitted with a note.
void readMotion(const Model& model, const std::vector<int>& sceneNode, Scene& scene);

}  // namespace diptych::gltf
