// SPDX-License-Identifier: MIT
#include "shared/scene/motion/animation.h"

#include "shared/scene/model/animated.h"
#include "shared/text/fail.h"
#include "shared/text/indexed_names.h"
#include "shared/text/one_line.h"

#include <fmt/format.h>
#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <cmath>
#include <span>

namespace diptych {

namespace {

constexpr glm::dvec4 noRotation(0, 0, 0, 1);

glm::dvec4 unit(const glm::dvec4& q) {
    const double length = glm::length(q);
    return length > 0 && std::isfinite(length) ? q / length : noRotation;
}

glm::dvec4 rotationOf(const std::vector<double>& xyzw) {
    return {xyzw[0], xyzw[1], xyzw[2], xyzw[3]};
}

// Spherical linear interpolation (Shoemake 1985, "Animating Rotation with Quaternion Curves"). The angle
// comes from atan2, because acos loses half of the digits near 0.
glm::dvec4 slerp(const glm::dvec4& from, glm::dvec4 to, double u) {
    if (glm::dot(from, to) < 0) to = -to;
    const double angle = 2 * std::atan2(glm::length(to - from), glm::length(to + from));
    const double sine = std::sin(angle);
    if (!(sine > 0)) return from;
    return unit((std::sin((1 - u) * angle) * from + std::sin(u * angle) * to) / sine);
}

// The two keys around a time; u is 0 at the first, 1 at the second.
struct KeyPair {
    std::size_t first, second;
    double u, interval;  // s
};

KeyPair keysAround(const std::vector<float>& times, double seconds) {
    const auto after = static_cast<std::size_t>(
        std::ranges::upper_bound(times, seconds, {}, [](float t) { return double{t}; }) - times.begin());
    if (after == 0) return {0, 0, 0, 0};
    if (after == times.size()) return {after - 1, after - 1, 0, 0};
    const double from = times[after - 1], interval = times[after] - from;
    return {after - 1, after, (seconds - from) / interval, interval};
}

// Cubic Hermite spline; tangents are per second.
double spline(double from, double out, double in, double to, double u, double interval) {
    const double u2 = u * u, u3 = u2 * u;
    return (2 * u3 - 3 * u2 + 1) * from + interval * (u3 - 2 * u2 + u) * out + (3 * u2 - 2 * u3) * to +
           interval * (u3 - u2) * in;
}

}  // namespace

glm::dmat4 matrixOf(const Transform& transform) {
    glm::dmat4 m = glm::mat4_cast(transform.rotation);
    for (int c = 0; c < 3; ++c) m[c] *= transform.scale[c];
    m[3] = glm::dvec4(transform.translation, 1);
    return m;
}

std::vector<double> sampled(const Keyframes& keyframes, AnimatedPart part, double seconds) {
    const bool cubic = keyframes.interpolation == Interpolation::cubic_spline;
    const std::size_t width = keyframes.width;
    // Order of the values in a cubic spline's key.
    enum : std::size_t { in, value, out };
    const auto at = [&](std::size_t key, std::size_t which = value) {
        const std::size_t first = cubic ? (3 * key + which) * width : key * width;
        return std::span(keyframes.values).subspan(first, width);
    };
    const KeyPair keys = keysAround(keyframes.times, seconds);
    const bool rotation = part == AnimatedPart::rotation;
    std::vector<double> result(at(keys.first).begin(), at(keys.first).end());
    if (keys.first != keys.second && keyframes.interpolation != Interpolation::step) {
        const std::span<const float> to = at(keys.second);
        if (cubic) {
            const std::span<const float> leaving = at(keys.first, out), arriving = at(keys.second, in);
            for (std::size_t i = 0; i < width; ++i)
                result[i] = spline(result[i], leaving[i], arriving[i], to[i], keys.u, keys.interval);
        } else if (rotation) {
            const glm::dvec4 q = slerp(unit(rotationOf(result)), unit({to[0], to[1], to[2], to[3]}), keys.u);
            return {q.x, q.y, q.z, q.w};
        } else {
            for (std::size_t i = 0; i < width; ++i)
                result[i] = (1 - keys.u) * result[i] + keys.u * double{to[i]};
        }
    }
    if (!rotation) return result;
    // A spline may pass through 0; then no rotation is applied.
    const glm::dvec4 q = unit(rotationOf(result));
    return {q.x, q.y, q.z, q.w};
}

std::span<const Animation> animationsOf(const Scene& scene, const std::string& choice) {
    const std::span<const Animation> all(scene.animations);
    if (choice.empty()) return all;
    std::vector<std::string> names;
    for (const Animation& animation : all) names.push_back(animation.name);
    const std::string who = fmt::format("--animation \"{}\"", oneLine(choice));
    if (const auto index = indexOfNamed(choice, names, who)) return all.subspan(*index, 1);
    fail(who,
         all.empty() ? "the scene has no animation" : "the scene's animations are " + indexedNames(names));
}

namespace {

template <class Weight>
std::vector<double> inDouble(const std::vector<Weight>& weights) {
    return {weights.begin(), weights.end()};
}

// Applies weights of all targets, or of one. The others keep their default or an earlier channel's value.
void moveWeights(const Scene& scene, const AnimationChannel& channel, std::vector<double> values,
                 NodeMotion& motion) {
    const bool ofNode = isNodePart(channel.part);
    const int key = ofNode ? channel.node : channel.object;
    std::map<int, std::vector<double>>& all = ofNode ? motion.weights : motion.mesh_weights;
    if (channel.part == AnimatedPart::weights || channel.part == AnimatedPart::mesh_weights) {
        all[key] = std::move(values);
        return;
    }
    const auto [at, isNew] = all.try_emplace(key);
    if (isNew) {
        const Node* node = ofNode ? &scene.nodes[static_cast<std::size_t>(key)] : nullptr;
        const int mesh = node ? node->mesh : key;
        at->second = node && node->weights >= 0
                         ? inDouble(scene.weights[static_cast<std::size_t>(node->weights)])
                         : inDouble(scene.meshes[static_cast<std::size_t>(mesh)].weights);
    }
    at->second[static_cast<std::size_t>(channel.element)] = values[0];
}

}  // namespace

NodeMotion motionAt(const Scene& scene, double seconds, const std::string& choice) {
    NodeMotion motion;
    for (const Node& node : scene.nodes) motion.parent_from_node.push_back(node.parent_from_node);
    std::map<int, Transform> moved;  // by node
    for (const Animation& animation : animationsOf(scene, choice)) {
        for (const AnimationChannel& channel : animation.channels) {
            std::vector<double> values = sampled(
                animation.keyframes[static_cast<std::size_t>(channel.keyframes)], channel.part, seconds);
            if (!isNodePart(channel.part) && !isMeshPart(channel.part)) continue;
            if (channel.part >= AnimatedPart::weights) {
                moveWeights(scene, channel, std::move(values), motion);
                continue;
            }
            const int rest = scene.nodes[static_cast<std::size_t>(channel.node)].transform;
            Transform& t = moved.try_emplace(channel.node, scene.transforms[static_cast<std::size_t>(rest)])
                               .first->second;
            if (channel.part == AnimatedPart::rotation)
                t.rotation = {values[3], values[0], values[1], values[2]};
            else
                (channel.part == AnimatedPart::scale ? t.scale : t.translation) =
                    glm::dvec3(values[0], values[1], values[2]);
        }
    }
    for (const auto& [node, transform] : moved)
        motion.parent_from_node[static_cast<std::size_t>(node)] = matrixOf(transform);
    return motion;
}

}  // namespace diptych
