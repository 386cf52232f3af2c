// SPDX-License-Identifier: MIT
#include "shared/scene/gltf/motion.h"

#include "shared/scene/gltf/accessor.h"
#include "shared/scene/gltf/limits.h"
#include "shared/scene/gltf/value.h"
#include "shared/text/fail.h"

#include <fmt/format.h>
#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <stdexcept>
#include <utility>

namespace diptych::gltf {

namespace {

bool allFinite(const std::vector<float>& values) {
    return std::all_of(values.begin(), values.end(), [](float v) { return std::isfinite(v); });
}

std::size_t targetsOf(const tinygltf::Model& model, const tinygltf::Node& node) {
    if (node.mesh < 0) return 0;
    const auto& primitives = model.meshes[static_cast<std::size_t>(node.mesh)].primitives;
    return primitives.empty() ? 0 : primitives[0].targets.size();
}

// Counts, over the whole file, data that decodes to more bytes than the file has for it.
class Budget {
public:
    explicit Budget(const tinygltf::Model& model) : left_(FREE_DECODED_BYTES) {
        for (const tinygltf::Buffer& buffer : model.buffers)
            left_ += buffer.data.size() * DECODED_BYTES_PER_BYTE;
    }
    Numbers read(const tinygltf::Model& model, int accessor, const std::string& who) {
        // The widest element is a MAT4; sparse elements are visited twice.
        const std::size_t count = soundCount(model, accessor, who), bytes = 2 * 16 * sizeof(float) * count;
        if (bytes > left_) fail(who, fmt::format("{} keys or matrices more are too many", count));
        left_ -= bytes;
        return readNumbers(model, accessor, who);
    }
    // Channels may share keyframes, but every animated node has its own weights.
    void holdWeights(std::size_t count, const std::string& who) {
        const std::size_t bytes = count * sizeof(double);
        if (bytes > left_) fail(who, fmt::format("{} weights more are too many", count));
        left_ -= bytes;
    }

private:
    std::size_t left_;
};

// ---- skins -------------------------------------------------------------------------------------------

class SkinReader {
public:
    SkinReader(const tinygltf::Model& model, const std::vector<int>& sceneNode, Budget& budget, Scene& scene)
        : model_(model), scene_node_(sceneNode), budget_(budget), scene_(scene) {}

    void read() {
        std::map<int, int> place;  // the file's skin -> its index in Scene::skins
        const std::size_t before = scene_.notes.size();
        for (std::size_t n = 0; n < model_.nodes.size(); ++n) {
            const tinygltf::Node& file = model_.nodes[n];
            if (scene_node_[n] < 0 || file.skin < 0 || file.mesh < 0) continue;
            const std::string who = fmt::format("node {}", n);
            checkedIndex(file.skin, model_.skins.size(), who, "skin");
            if (!hasJoints(file.mesh)) {
                scene_.notes.push_back(who + ": has a skin, but its mesh has no JOINTS_0: drawn unskinned");
                continue;
            }
            const auto [at, fresh] = place.emplace(file.skin, static_cast<int>(scene_.skins.size()));
            if (fresh) scene_.skins.push_back(skin(file.skin));
            scene_.nodes[static_cast<std::size_t>(scene_node_[n])].skin = at->second;
        }
        limitNotes(scene_.notes, before, "skins");
    }

private:
    const tinygltf::Model& model_;
    const std::vector<int>& scene_node_;
    Budget& budget_;
    Scene& scene_;

    bool hasJoints(int mesh) const {
        const auto& primitives = model_.meshes[static_cast<std::size_t>(mesh)].primitives;
        return std::any_of(primitives.begin(), primitives.end(), [](const tinygltf::Primitive& p) {
            return p.attributes.contains("JOINTS_0") || p.attributes.contains("WEIGHTS_0");
        });
    }

    int sceneNode(int node, const std::string& who, const char* what) const {
        if (checkedIndex(node, model_.nodes.size(), who, what) < 0) fail(who, fmt::format("{} -1", what));
        return scene_node_[static_cast<std::size_t>(node)];
    }

    Skin skin(int index) {
        const tinygltf::Skin& file = model_.skins[static_cast<std::size_t>(index)];
        const std::string who = fmt::format("skin {}", index);
        Skin result;
        result.name = file.name;
        if (file.joints.empty()) fail(who, "has no joints");
        for (const int joint : file.joints) {
            result.joints.push_back(sceneNode(joint, who, "joint"));
            if (result.joints.back() < 0)
                fail(who, fmt::format("joint node {} is not in the scene that is drawn", joint));
        }
        // The skeleton only hints at what the joints say already; one outside the scene is dropped.
        if (file.skeleton >= 0) result.skeleton = sceneNode(file.skeleton, who, "skeleton");
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
            // Exporters round; 1e-4 is far above rounding and far below what is visible.
            for (int c = 0; c < 4; ++c) {
                const float last = c == 3 ? 1.0f : 0.0f;
                if (std::abs(matrices[j][c][3] - last) > 1e-4f)
                    fail(who, fmt::format("the last row of matrix {} is not 0 0 0 1", j));
                matrices[j][c][3] = last;
            }
        }
    }
};

// ---- animations --------------------------------------------------------------------------------------

class AnimationReader {
public:
    AnimationReader(const tinygltf::Model& model, const std::vector<int>& sceneNode, Budget& budget,
                    Scene& scene)
        : model_(model), scene_node_(sceneNode), budget_(budget), scene_(scene) {}

    void read() {
        const std::size_t before = scene_.notes.size();
        for (std::size_t a = 0; a < model_.animations.size(); ++a) animation(a);
        limitNotes(scene_.notes, before, "animations");
        const auto moving = std::ranges::count_if(scene_.animations, movesAnything);
        if (moving == 0) scene_.animations.clear();
        if (moving > 1)
            scene_.notes.push_back(fmt::format(
                "{} animations: all play at once, later ones win; --animation plays one alone", moving));
    }

private:
    const tinygltf::Model& model_;
    const std::vector<int>& scene_node_;
    Budget& budget_;
    Scene& scene_;
    const tinygltf::Animation* file_ = nullptr;
    std::string who_;  // "animation 2"

    void animation(std::size_t index) {
        file_ = &model_.animations[index];
        who_ = fmt::format("animation {}", index);
        Animation result;
        result.name = file_->name;
        // (the file's sampler, part) -> its index in result.keyframes.
        std::map<std::pair<int, AnimatedPart>, int> place;
        std::set<std::pair<int, AnimatedPart>> moved;
        std::size_t faulty = 0;
        std::string first;  // the fault of the first of them
        for (std::size_t c = 0; c < file_->channels.size(); ++c) {
            const tinygltf::AnimationChannel& channel = file_->channels[c];
            const std::string who = fmt::format("channel {}", c);
            try {
                const int node = checkedIndex(channel.target_node, model_.nodes.size(), who, "node");
                if (node < 0 || scene_node_[static_cast<std::size_t>(node)] < 0) continue;
                const AnimatedPart part = partOf(channel, who);
                if (!moved.emplace(node, part).second)
                    fail(who, fmt::format("node {} is moved by an earlier channel already", node));
                const auto known = place.find({channel.sampler, part});
                const int keys =
                    known == place.end() ? static_cast<int>(result.keyframes.size()) : known->second;
                Keyframes fresh;
                if (known == place.end()) fresh = keyframes(channel.sampler, part, who);
                const Keyframes& these =
                    known == place.end() ? fresh : result.keyframes[static_cast<std::size_t>(keys)];
                checkWidth(these, node, part, who);
                if (part == AnimatedPart::weights) budget_.holdWeights(these.width, who);
                if (known == place.end()) {
                    place[{channel.sampler, part}] = keys;
                    result.keyframes.push_back(std::move(fresh));
                }
                const int target = scene_node_[static_cast<std::size_t>(node)];
                if (part != AnimatedPart::weights) giveTransform(node);
                result.channels.push_back({target, keys, part});
            } catch (const std::runtime_error& e) {
                if (faulty++ == 0) first = e.what();
            }
        }
        if (faulty)
            scene_.notes.push_back(fmt::format("{}: {} of {} channels left out: {}", who_, faulty,
                                               file_->channels.size(), first));
        if (result.channels.empty()) result.keyframes.clear();
        scene_.animations.push_back(std::move(result));
    }

    AnimatedPart partOf(const tinygltf::AnimationChannel& channel, const std::string& who) const {
        const tinygltf::Node& node = model_.nodes[static_cast<std::size_t>(channel.target_node)];
        if (channel.target_path == "weights") {
            if (targetsOf(model_, node) == 0)
                fail(who, fmt::format("node {} has no morph targets", channel.target_node));
            return AnimatedPart::weights;
        }
        static const std::map<std::string, AnimatedPart> parts{{"translation", AnimatedPart::translation},
                                                               {"rotation", AnimatedPart::rotation},
                                                               {"scale", AnimatedPart::scale}};
        const auto part = parts.find(channel.target_path);
        if (part == parts.end())
            fail(who, fmt::format("path \"{}\" is none of translation, rotation, scale, weights",
                                  channel.target_path));
        if (!node.matrix.empty())
            fail(who, fmt::format("node {} has a matrix, which cannot be animated", channel.target_node));
        return part->second;
    }

    Keyframes keyframes(int index, AnimatedPart part, const std::string& who) {
        if (checkedIndex(index, file_->samplers.size(), who, "sampler") < 0) fail(who, "names no sampler");
        const tinygltf::AnimationSampler& file = file_->samplers[static_cast<std::size_t>(index)];
        Keyframes result;
        if (file.interpolation == "STEP")
            result.interpolation = Interpolation::step;
        else if (file.interpolation == "CUBICSPLINE")
            result.interpolation = Interpolation::cubic_spline;
        else if (file.interpolation != "LINEAR")
            fail(who, fmt::format("interpolation \"{}\" is none of STEP, LINEAR, CUBICSPLINE",
                                  file.interpolation));
        readTimes(file.input, who + ": input", result);
        readValues(file.output, part, who + ": output", result);
        return result;
    }

    void readTimes(int accessor, const std::string& who, Keyframes& result) {
        Numbers times = budget_.read(model_, accessor, who);
        if (times.width != 1 || times.component_type != TINYGLTF_COMPONENT_TYPE_FLOAT)
            fail(who, fmt::format("accessor {} is not SCALAR of floats", accessor));
        if (times.count == 0) fail(who, "has no keys");
        for (std::size_t i = 0; i < times.count; ++i) {
            const float t = times.values[i];
            if (!std::isfinite(t) || t < 0) fail(who, fmt::format("key {} is at {:g} s", i, t));
            if (i > 0 && !(t > times.values[i - 1]))
                fail(who, fmt::format("key {} at {:g} s is not after the one before it", i, t));
        }
        result.times = std::move(times.values);
    }

    void readValues(int accessor, AnimatedPart part, const std::string& who, Keyframes& result) {
        Numbers read = budget_.read(model_, accessor, who);
        const std::size_t width = part == AnimatedPart::weights ? 1 : part == AnimatedPart::rotation ? 4 : 3;
        const bool floats = read.component_type == TINYGLTF_COMPONENT_TYPE_FLOAT;
        const bool integers = read.normalized && read.component_type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
        const bool mayBeIntegers = part == AnimatedPart::rotation || part == AnimatedPart::weights;
        if (read.width != width || !(floats || (integers && mayBeIntegers)))
            fail(who, fmt::format("accessor {} is not {} of floats{}", accessor,
                                  width == 1 ? "SCALAR" : fmt::format("VEC{}", width),
                                  mayBeIntegers ? " or normalized integers" : ""));
        if (!allFinite(read.values)) fail(who, "holds values that are not finite");
        const std::size_t keys =
            result.times.size() * (result.interpolation == Interpolation::cubic_spline ? 3 : 1);
        if (read.count == 0 || read.count % keys != 0 || (width > 1 && read.count != keys))
            fail(who, fmt::format("{} elements for {} keys", read.count, result.times.size()));
        result.width = read.values.size() / keys;
        result.values = std::move(read.values);
        if (part == AnimatedPart::rotation && result.interpolation != Interpolation::cubic_spline)
            makeUnit(result.values, who);
    }

    static void makeUnit(std::vector<float>& rotations, const std::string& who) {
        for (std::size_t i = 0; i + 3 < rotations.size(); i += 4) {
            const glm::dvec4 q(rotations[i], rotations[i + 1], rotations[i + 2], rotations[i + 3]);
            const double length = glm::length(q);
            if (!(length > 0)) fail(who, fmt::format("rotation {} is 0 0 0 0", i / 4));
            for (std::size_t c = 0; c < 4; ++c)
                rotations[i + c] = static_cast<float>(q[static_cast<int>(c)] / length);
        }
    }

    void checkWidth(const Keyframes& keys, int node, AnimatedPart part, const std::string& who) const {
        const std::size_t targets = targetsOf(model_, model_.nodes[static_cast<std::size_t>(node)]);
        if (part == AnimatedPart::weights && keys.width != targets)
            fail(who, fmt::format("{} weights a key, but node {} has {} morph targets", keys.width, node,
                                  targets));
    }

    // The numbers have been checked when the node's matrix was made from them.
    void giveTransform(int node) {
        Node& target = scene_.nodes[static_cast<std::size_t>(scene_node_[static_cast<std::size_t>(node)])];
        if (target.transform >= 0) return;
        const tinygltf::Node& file = model_.nodes[static_cast<std::size_t>(node)];
        Transform t;
        for (std::size_t c = 0; c < 3; ++c) {
            if (file.translation.size() == 3) t.translation[static_cast<int>(c)] = file.translation[c];
            if (file.scale.size() == 3) t.scale[static_cast<int>(c)] = file.scale[c];
        }
        if (file.rotation.size() == 4) {
            const std::vector<double>& r = file.rotation;
            const glm::dquat q(r[3], r[0], r[1], r[2]);
            if (glm::length(q) > 0) t.rotation = glm::normalize(q);
        }
        target.transform = static_cast<int>(scene_.transforms.size());
        scene_.transforms.push_back(t);
    }
};

void readNodeWeights(const tinygltf::Model& model, const std::vector<int>& sceneNode, Scene& scene) {
    for (std::size_t n = 0; n < model.nodes.size(); ++n) {
        const tinygltf::Node& file = model.nodes[n];
        if (sceneNode[n] < 0 || file.weights.empty() || file.mesh < 0) continue;
        const std::string who = fmt::format("node {}", n);
        const std::size_t targets = targetsOf(model, file);
        if (file.weights.size() != targets)
            fail(who, fmt::format("{} weights for {} morph target{}", file.weights.size(), targets,
                                  targets == 1 ? "" : "s"));
        std::vector<float> weights(file.weights.begin(), file.weights.end());
        if (!allFinite(weights)) fail(who, "a weight is not finite");
        scene.nodes[static_cast<std::size_t>(sceneNode[n])].weights = static_cast<int>(scene.weights.size());
        scene.weights.push_back(std::move(weights));
    }
}

}  // namespace

void readMotion(const tinygltf::Model& model, const std::vector<int>& sceneNode, Scene& scene) {
    Budget budget(model);
    SkinReader(model, sceneNode, budget, scene).read();
    readNodeWeights(model, sceneNode, scene);
    AnimationReader(model, sceneNode, budget, scene).read();
}

}  // namespace diptych::gltf
