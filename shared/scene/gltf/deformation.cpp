// SPDX-License-Identifier: MIT
#include "shared/scene/gltf/attributes.h"

#include "shared/text/counted.h"
#include "shared/text/fail.h"

#include <fmt/format.h>

#include <cmath>
#include <string>

namespace diptych::gltf {

namespace {

void normalizeWeights(const AttributeReader& reader, std::size_t joints,
                      std::span<const std::uint32_t> vertices, Primitive& primitive) {
    // Each weight may be rounded to 8 bits, an error of half a step.
    const double rounding = 4.0 * static_cast<double>(primitive.joint_sets.size()) * 0.5 / 255;
    std::size_t broken = 0, unweighted = 0, uneven = 0;
    for (std::size_t v = 0; v < primitive.positions.size(); ++v) {
        double sum = 0;
        for (JointSet& set : primitive.joint_sets)
            for (int c = 0; c < 4; ++c) {
                float& weight = set.weights[v][c];
                if (!(weight >= 0 && weight <= maxCoordinate)) weight = 0, ++broken;
                sum += weight;
            }
        if (!(sum > 0)) {
            primitive.joint_sets[0].weights[v].x = 1;
            sum = 1, ++unweighted;
        }
        uneven += std::abs(sum - 1) > rounding;
        for (JointSet& set : primitive.joint_sets)
            for (int c = 0; c < 4; ++c) {
                set.weights[v][c] = static_cast<float>(set.weights[v][c] / sum);
                if (set.weights[v][c] == 0) set.joints[v][c] = 0;
                if (set.joints[v][c] >= joints)
                    fail(reader.who, fmt::format("vertex {} names joint {}, but its skin has {}", vertices[v],
                                                 set.joints[v][c], joints));
            }
    }
    if (broken)
        reader.note("{} negative or not finite: 0 is used",
                    broken == 1 ? "1 joint weight is" : counted(broken, "joint weight") + " are");
    if (uneven)
        reader.note("the joint weights of {} do not add up to 1: normalized",
                    counted(uneven, "vertex", "vertices"));
    if (unweighted)
        reader.note("{} without a joint weight: the first joint that each names is used",
                    counted(unweighted, "vertex", "vertices"));
}

// RGB deltas do not change alpha.
std::vector<glm::vec4> readColorDeltas(const Model& model, int accessor, const std::string& who,
                                       const Selection& which) {
    std::vector<glm::vec4> deltas = readColors(model, accessor, who, which);
    if (model.accessors[static_cast<std::size_t>(accessor)].type == TINYGLTF_TYPE_VEC3)
        for (glm::vec4& delta : deltas) delta.a = 0;
    return deltas;
}

}  // namespace

void readJointSets(const AttributeReader& reader, std::size_t joints, std::span<const std::uint32_t> vertices,
                   Primitive& primitive) {
    for (std::size_t set = 0;; ++set) {
        const std::string indices = fmt::format("JOINTS_{}", set), weights = fmt::format("WEIGHTS_{}", set);
        const bool indexed = reader.has(indices);
        if (indexed != reader.has(weights))
            fail(reader.who,
                 fmt::format("has {} without {}", indexed ? indices : weights, indexed ? weights : indices));
        if (!indexed) break;
        primitive.joint_sets.push_back({reader.read<glm::u16vec4>(indices, readJoints),
                                        reader.read<glm::vec4>(weights, readVectors<glm::vec4>)});
    }
    if (!primitive.joint_sets.empty()) normalizeWeights(reader, joints, vertices, primitive);
}

void readTargets(const AttributeReader& reader, std::size_t count, Primitive& primitive) {
    if (reader.file.targets.size() != count)
        fail(reader.who, fmt::format("{} morph targets, but the mesh's first primitive has {}",
                                     reader.file.targets.size(), count));
    for (std::size_t t = 0; t < count; ++t) {
        MorphTarget& target = primitive.targets.emplace_back();
        for (const auto& [name, accessor] : reader.file.targets[t]) {
            if (name.starts_with('_')) continue;
            const std::string what = fmt::format("target {}: {}", t, name);
            const auto take = [&, from = accessor](auto& deltas, const auto& read) {
                deltas = read(reader.model, from, reader.who + ": " + what, reader.which);
                using Delta = typename std::remove_reference_t<decltype(deltas)>::value_type;
                reader.repair(deltas, Delta(0), what, "0");
            };
            // A delta needs a base attribute. Generated normals and tangents follow from the morphed
            // positions instead.
            const bool based = reader.has(name);
            if (based && name == "POSITION")
                take(target.positions, readVectors<glm::vec3>);
            else if (based && name == "NORMAL")
                take(target.normals, readVectors<glm::vec3>);
            else if (based && name == "TANGENT")
                take(target.tangents, readVectors<glm::vec3>);
            else if (based && (name == "TEXCOORD_0" || name == "TEXCOORD_1"))
                take(target.texcoords[name.back() - '0'], readVectors<glm::vec2>);
            else if (based && name == "COLOR_0")
                take(target.colors, readColorDeltas);
            else
                reader.note("{}: left out", what);
        }
    }
}

}  // namespace diptych::gltf
