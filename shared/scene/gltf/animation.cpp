// SPDX-License-Identifier: MIT
#include "shared/scene/gltf/motion.h"

#include "shared/scene/gltf/animation_pointer.h"
#include "shared/scene/gltf/node.h"
#include "shared/scene/gltf/value.h"
#include "shared/scene/model/animated.h"
#include "shared/text/fail.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>

#include <algorithm>
#include <cmath>
#include <compare>
#include <map>
#include <set>
#include <stdexcept>
#include <string_view>
#include <utility>

namespace diptych::gltf {

using Json = nlohmann::json;

namespace {

// The pointer of a channel, from Model::rest; nullptr if it has none.
const Json* pointerOf(const Json& channel) {
    const Json* target = memberOf(channel, "target");
    const Json* e = target ? extension(*target, "KHR_animation_pointer") : nullptr;
    return e ? memberOf(*e, "pointer") : nullptr;
}

bool hasTransform(AnimatedPart part) {
    return part <= AnimatedPart::scale;
}

// Format of a sampler's output. Channels with the same sampler and format share keyframes.
struct OutputShape {
    std::size_t width;  // components per element of its accessor
    bool several;       // several elements per key: the weights of all morph targets
    bool rotation;
    bool integers;  // any integers may be used: KHR_animation_pointer
    auto operator<=>(const OutputShape&) const = default;
};

// The word for the object that has the part.
std::string_view objectOf(AnimatedPart part) {
    return isNodePart(part)     ? "node"
           : isMeshPart(part)   ? "mesh"
           : isLightPart(part)  ? "light"
           : isCameraPart(part) ? "camera"
                                : "material";
}

// Objects but nodes that the scene contains, by objectOf().
std::map<std::string_view, std::set<int>> containedObjects(const MotionSource& source) {
    std::map<std::string_view, std::set<int>> all;
    for (const Node& node : source.scene.nodes)
        if (node.mesh >= 0) all["mesh"].insert(node.mesh);
    for (const int mesh : all["mesh"])
        for (const tinygltf::Primitive& p : source.model.meshes[static_cast<std::size_t>(mesh)].primitives)
            all["material"].insert(p.material);
    for (const Light& light : source.scene.lights) all["light"].insert(light.source);
    for (const Camera& camera : source.scene.cameras) all["camera"].insert(camera.source);
    return all;
}

class AnimationReader : MotionSource {
public:
    explicit AnimationReader(const MotionSource& source)
        : MotionSource(source), contained_(containedObjects(source)) {}

    void read() {
        const std::size_t before = scene.notes.size();
        for (std::size_t a = 0; a < model.animations.size(); ++a) animation(a);
        limitNotes(scene.notes, before, "animations");
        const auto moving = std::ranges::count_if(scene.animations, movesAnything);
        if (moving == 0) scene.animations.clear();
        if (moving > 1)
            scene.notes.push_back(fmt::format(
                "{} animations: all play at once, later ones override earlier ones; --animation selects one",
                moving));
    }

private:
    std::map<std::string_view, std::set<int>> contained_;
    const tinygltf::Animation* file_ = nullptr;
    // (the file's sampler, shape) -> index of keyframes
    std::map<std::pair<int, OutputShape>, int> keyframes_index_;
    std::set<ChannelTarget> moved_;

    void animation(std::size_t index) {
        file_ = &model.animations[index];
        keyframes_index_.clear();
        moved_.clear();
        const std::string who = fmt::format("animation {}", index);
        const Json* channels = memberOf(elementOf(arrayAt(model.rest, "/animations"), index), "channels");
        Animation result;
        result.name = file_->name;
        std::size_t faulty = 0;
        std::string first;  // the first fault
        for (std::size_t c = 0; c < file_->channels.size(); ++c) {
            try {
                const tinygltf::AnimationChannel& file = file_->channels[c];
                const Json* pointer =
                    channels && file.target_path == "pointer" ? pointerOf(elementOf(*channels, c)) : nullptr;
                channel(file, pointer, who, fmt::format("channel {}", c), result);
            } catch (const std::runtime_error& e) {
                if (faulty++ == 0) first = e.what();
            }
        }
        if (faulty)
            scene.notes.push_back(fmt::format("{}: {} of {} channels left out: {}", who, faulty,
                                              file_->channels.size(), first));
        if (result.channels.empty()) result.keyframes.clear();
        scene.animations.push_back(std::move(result));
    }

    // `pointer`: of KHR_animation_pointer; nullptr: none.
    void channel(const tinygltf::AnimationChannel& file, const Json* pointer, const std::string& animation,
                 const std::string& who, Animation& result) {
        const ChannelTarget target = pointer ? pointerTarget(model, *pointer, who) : targetOf(file, who);
        if (target.object < 0 || !isContained(target)) return;
        if (hasTransform(target.part) && !fileOf(target).matrix.empty())
            fail(who, fmt::format("node {} has a matrix, which cannot be animated", target.object));
        claim(target, who);
        const OutputShape shape{
            propertiesOf(target.part).width,
            target.part == AnimatedPart::weights || target.part == AnimatedPart::mesh_weights,
            target.part == AnimatedPart::rotation, pointer != nullptr};
        const auto known = keyframes_index_.find({file.sampler, shape});
        const int keys =
            known == keyframes_index_.end() ? static_cast<int>(result.keyframes.size()) : known->second;
        Keyframes fresh;
        if (known == keyframes_index_.end()) fresh = keyframes(file.sampler, shape, who);
        const Keyframes& these =
            known == keyframes_index_.end() ? fresh : result.keyframes[static_cast<std::size_t>(keys)];
        checkWeights(these, target, who);
        noteKeys(these, target, known == keyframes_index_.end(), fmt::format("{}: {}", animation, who));
        AnimationChannel made{.keyframes = keys, .part = target.part, .element = target.element};
        if (isNodePart(target.part))
            made.node = scene_node[static_cast<std::size_t>(target.object)];
        else
            made.object = target.object;
        if (known == keyframes_index_.end()) {
            keyframes_index_[{file.sampler, shape}] = keys;
            result.keyframes.push_back(std::move(fresh));
        }
        if (hasTransform(target.part)) {
            Node& node = nodeOf(static_cast<std::size_t>(target.object));
            if (node.transform < 0) {
                node.transform = static_cast<int>(scene.transforms.size());
                scene.transforms.push_back(partsOf(fileOf(target)));
            }
        }
        result.channels.push_back(made);
    }

    const tinygltf::Node& fileOf(const ChannelTarget& target) const {
        return model.nodes[static_cast<std::size_t>(target.object)];
    }

    ChannelTarget targetOf(const tinygltf::AnimationChannel& channel, const std::string& who) {
        ChannelTarget target;
        target.object = channel.target_node;
        if (target.object < 0 || !isContained(target)) return target;
        static const std::map<std::string, AnimatedPart> parts{{"translation", AnimatedPart::translation},
                                                               {"rotation", AnimatedPart::rotation},
                                                               {"scale", AnimatedPart::scale},
                                                               {"weights", AnimatedPart::weights}};
        const auto part = parts.find(channel.target_path);
        if (part == parts.end())
            fail(who, fmt::format("path \"{}\" is not one of translation, rotation, scale, weights",
                                  channel.target_path));
        target.part = part->second;
        return target;
    }

    bool isContained(const ChannelTarget& target) {
        if (!target.effect) return false;
        if (isNodePart(target.part)) return scene_node[static_cast<std::size_t>(target.object)] >= 0;
        return contained_[objectOf(target.part)].contains(target.object);
    }

    // Within one animation, targets must be distinct; an array and one of its elements conflict.
    void claim(const ChannelTarget& target, const std::string& who) {
        constexpr int any = -1;
        const bool one = target.part == AnimatedPart::weight || target.part == AnimatedPart::mesh_weight;
        const AnimatedPart all = target.part == AnimatedPart::weight        ? AnimatedPart::weights
                                 : target.part == AnimatedPart::mesh_weight ? AnimatedPart::mesh_weights
                                                                            : target.part;
        if (moved_.contains(target) || moved_.contains({all, target.object, one ? 0 : any}))
            fail(who, fmt::format("an earlier channel already animates {} {}", objectOf(target.part),
                                  target.object));
        moved_.insert(target);
        if (one) moved_.insert({all, target.object, any});
    }

    Keyframes keyframes(int index, const OutputShape& shape, const std::string& who) {
        if (static_cast<std::size_t>(index) >= file_->samplers.size())
            fail(who, fmt::format("sampler {}, but the animation has {}", index, file_->samplers.size()));
        const tinygltf::AnimationSampler& file = file_->samplers[static_cast<std::size_t>(index)];
        Keyframes result;
        if (file.interpolation == "STEP")
            result.interpolation = Interpolation::step;
        else if (file.interpolation == "CUBICSPLINE")
            result.interpolation = Interpolation::cubic_spline;
        readTimes(file.input, who + ": input", result);
        readValues(file.output, shape, who + ": output", result);
        return result;
    }

    void readTimes(int accessor, const std::string& who, Keyframes& result) {
        Numbers times = budget.read(model, accessor, who);
        if (times.width != 1 || times.component_type != TINYGLTF_COMPONENT_TYPE_FLOAT)
            fail(who, fmt::format("accessor {} is not SCALAR of floats", accessor));
        if (times.count == 0) fail(who, "has no keys");
        for (std::size_t i = 0; i < times.count; ++i) {
            const float t = times.values[i];
            if (!std::isfinite(t) || t < 0)
                fail(who, fmt::format("key {} has the invalid time {:g} s", i, t));
            if (i > 0 && t < times.values[i - 1])
                fail(who, fmt::format("key {} at {:g} s is before the previous key", i, t));
        }
        result.times = std::move(times.values);
    }

    void readValues(int accessor, const OutputShape& shape, const std::string& who, Keyframes& result) {
        Numbers read = budget.read(model, accessor, who);
        const bool floats = read.component_type == TINYGLTF_COMPONENT_TYPE_FLOAT;
        const bool integers = read.normalized && read.component_type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
        const bool mayBeIntegers = shape.rotation || shape.several;
        if (read.width != shape.width || !(floats || shape.integers || (integers && mayBeIntegers)))
            fail(who, fmt::format("accessor {} is not {}{}", accessor,
                                  shape.width == 1 ? "SCALAR" : fmt::format("VEC{}", shape.width),
                                  shape.integers  ? ""
                                  : mayBeIntegers ? " of floats or normalized integers"
                                                  : " of floats"));
        if (!std::ranges::all_of(read.values, [](float v) { return std::isfinite(v); }))
            fail(who, "has values that are not finite");
        const std::size_t keys =
            result.times.size() * (result.interpolation == Interpolation::cubic_spline ? 3 : 1);
        if (read.count == 0 || read.count % keys != 0 || (!shape.several && read.count != keys))
            fail(who, fmt::format("{} elements for {} keys", read.count, result.times.size()));
        result.width = read.values.size() / keys;
        result.values = std::move(read.values);
        if (shape.rotation && result.interpolation != Interpolation::cubic_spline)
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

    // Channels may share keyframes, but every animated node or mesh has its own weights, which count here.
    void checkWeights(const Keyframes& keys, const ChannelTarget& target, const std::string& who) {
        const bool node = isNodePart(target.part);
        if (hasTransform(target.part) || !(node || isMeshPart(target.part))) return;
        const std::size_t targets = node ? targetsOf(model, fileOf(target))
                                         : targetsOf(model.meshes[static_cast<std::size_t>(target.object)]);
        const std::string_view what = objectOf(target.part);
        if (targets == 0) fail(who, fmt::format("{} {} has no morph targets", what, target.object));
        const bool all = target.part == AnimatedPart::weights || target.part == AnimatedPart::mesh_weights;
        if (all && keys.width != targets)
            fail(who, fmt::format("{} weights per key, but {} {} has {} morph targets", keys.width, what,
                                  target.object, targets));
        budget.hold(sizeof(double), targets, who, "weights");
    }

    void noteKeys(const Keyframes& keys, const ChannelTarget& target, bool fresh, const std::string& who) {
        if (fresh && std::ranges::adjacent_find(keys.times) != keys.times.end())
            scene.notes.push_back(who + ": several keys at one time: the last one is used");
        if (isNodePart(target.part) || isMeshPart(target.part)) return;
        const PartProperties properties = propertiesOf(target.part);
        const std::size_t width = keys.width;
        const std::size_t stride = keys.interpolation == Interpolation::cubic_spline ? 3 * width : width;
        const std::size_t first = stride - width > 0 ? width : 0;  // tangents are unlimited
        for (std::size_t k = first; k < keys.values.size(); k += stride)
            for (std::size_t i = k; i < k + width; ++i) {
                const double x = keys.values[i];
                const bool gap = target.part == AnimatedPart::ior && x > 0 && x < 1;
                if (x >= properties.min && x <= properties.max && !gap) continue;
                scene.notes.push_back(
                    gap ? fmt::format("{}: ior {} is not 0 or at least 1: 1 is used", who, x)
                        : fmt::format("{}: {} is outside {:g} to {:g}: the nearest value is used", who, x,
                                      properties.min, properties.max));
                return;
            }
    }
};

}  // namespace

void readAnimations(const MotionSource& source) {
    AnimationReader(source).read();
}

}  // namespace diptych::gltf
