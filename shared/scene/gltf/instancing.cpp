// SPDX-License-Identifier: MIT
#include "shared/scene/gltf/motion.h"

#include "shared/scene/gltf/value.h"
#include "shared/scene/motion/animation.h"
#include "shared/scene/motion/instances.h"
#include "shared/text/counted.h"
#include "shared/text/fail.h"

#include <fmt/format.h>
#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace diptych::gltf {

using Json = nlohmann::json;

namespace {

struct Attributes {
    const Model& model;
    const Json& attributes;
    const std::string& who;

    // The number of instances, common to all attributes; none without attributes.
    std::optional<std::size_t> count() const {
        std::optional<std::size_t> count;
        for (const auto& [name, accessor] : attributes.items()) {
            const std::string what = fmt::format("{}: {}", who, name);
            const std::size_t these = soundCount(model, accessor.get<int>(), what);
            if (count && these != *count)
                fail(what, fmt::format("{} instances, but other attributes have {}", these, *count));
            count = these;
        }
        return count;
    }

    // `width` numbers per instance; empty if the attribute is absent.
    std::vector<float> read(const char* name, std::size_t width, bool mayBeIntegers,
                            MotionBudget& budget) const {
        const int accessor = attributes.value(name, -1);
        if (accessor < 0) return {};
        const std::string what = fmt::format("{}: {}", who, name);
        Numbers numbers = budget.read(model, accessor, what);
        const bool integers = numbers.normalized && (numbers.component_type == TINYGLTF_COMPONENT_TYPE_BYTE ||
                                                     numbers.component_type == TINYGLTF_COMPONENT_TYPE_SHORT);
        if (numbers.width != width ||
            !(numbers.component_type == TINYGLTF_COMPONENT_TYPE_FLOAT || (mayBeIntegers && integers)))
            fail(what, fmt::format("accessor {} is not VEC{} of floats{}", accessor, width,
                                   mayBeIntegers ? " or normalized signed integers" : ""));
        if (!std::ranges::all_of(numbers.values, [](float v) { return std::isfinite(v); }))
            fail(what, "has values that are not finite");
        return std::move(numbers.values);
    }
};

std::vector<glm::dmat4> copiesOf(const Attributes& attributes, std::size_t count, MotionBudget& budget,
                                 std::vector<std::string>& notes) {
    const std::vector<float> t = attributes.read("TRANSLATION", 3, false, budget);
    const std::vector<float> r = attributes.read("ROTATION", 4, true, budget);
    const std::vector<float> s = attributes.read("SCALE", 3, false, budget);
    std::vector<glm::dmat4> copies;
    std::size_t unturned = 0;
    for (std::size_t i = 0; i < count; ++i) {
        Transform parts;
        if (!r.empty()) {
            const glm::dquat q(r[4 * i + 3], r[4 * i], r[4 * i + 1], r[4 * i + 2]);
            if (glm::length(q) > 0)
                parts.rotation = glm::normalize(q);
            else
                ++unturned;
        }
        if (!s.empty()) parts.scale = {s[3 * i], s[3 * i + 1], s[3 * i + 2]};
        if (!t.empty()) parts.translation = {t[3 * i], t[3 * i + 1], t[3 * i + 2]};
        copies.push_back(matrixOf(parts));
    }
    if (unturned)
        notes.push_back(fmt::format("{}: {} 0 0 0 0: no rotation is used", attributes.who,
                                    counted(unturned, "rotation")));
    return copies;
}

}  // namespace

void readInstancing(const MotionSource& source) {
    const auto& [model, sceneNode, scene, budget] = source;
    const std::size_t before = scene.notes.size();
    const Json& files = arrayAt(model.rest, "/nodes");
    for (std::size_t n = 0; n < files.size(); ++n) {
        const Json* e = extension(files[n], "EXT_mesh_gpu_instancing");
        if (sceneNode[n] < 0 || !e) continue;
        Node& node = source.nodeOf(n);
        const std::string who = fmt::format("node {}: EXT_mesh_gpu_instancing", n);
        if (node.mesh < 0 || node.skin >= 0) {
            scene.notes.push_back(who + (node.mesh < 0
                                             ? ": the node has no mesh: left out"
                                             : ": its mesh is skinned, so nodes do not move it: drawn once"));
            continue;
        }
        const Attributes attributes{model, (*e)["attributes"], who};
        const std::optional<std::size_t> count = attributes.count();
        if (!count) {
            scene.notes.push_back(who + ": names no attribute: drawn once");
            continue;
        }
        const auto& primitives = model.meshes[static_cast<std::size_t>(node.mesh)].primitives;
        budget.hold(sizeof(glm::dmat4) + primitives.size() * sizeof(Instance), *count, who, "instances");
        node.copies = static_cast<int>(scene.copies.size());
        scene.copies.push_back(copiesOf(attributes, *count, budget, scene.notes));
    }
    limitNotes(scene.notes, before, "instances");
}

}  // namespace diptych::gltf
