// SPDX-License-Identifier: MIT
#include "shared/scene/gltf/instancing.h"

#include "shared/scene/gltf/value.h"
#include "shared/scene/motion/pose.h"
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

class Attributes {
public:
    Attributes(const Model& model, const Json& attributes, const std::string& who)
        : model_(model), attributes_(attributes), who_(who) {}

    // The number of instances, common to all attributes; none without attributes.
    std::optional<std::size_t> count() const {
        std::optional<std::size_t> count;
        for (const auto& [name, accessor] : attributes_.items()) {
            const std::string what = fmt::format("{}: {}", who_, name);
            const std::size_t these = soundCount(model_, accessor.get<int>(), what);
            if (count && these != *count)
                fail(what, fmt::format("{} instances, but other attributes have {}", these, *count));
            count = these;
        }
        return count;
    }

    // `width` numbers per instance; empty if the attribute is absent.
    std::vector<float> read(const char* name, std::size_t width, bool mayBeIntegers, MotionBudget& budget) {
        const int accessor = attributes_.value(name, -1);
        if (accessor < 0) return {};
        const std::string what = fmt::format("{}: {}", who_, name);
        Numbers numbers = budget.read(model_, accessor, what);
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

private:
    const Model& model_;
    const Json& attributes_;
    const std::string& who_;
};

std::vector<glm::dmat4> copiesOf(Attributes attributes, std::size_t count, const std::string& who,
                                 MotionBudget& budget, std::vector<std::string>& notes) {
    const std::vector<float> t = attributes.read("TRANSLATION", 3, false, budget);
    const std::vector<float> r = attributes.read("ROTATION", 4, true, budget);
    const std::vector<float> s = attributes.read("SCALE", 3, false, budget);
    std::vector<glm::dmat4> copies;
    std::size_t unturned = 0;
    for (std::size_t i = 0; i < count; ++i) {
        glm::dmat4 m(1.0);
        if (!r.empty()) {
            const glm::dquat q(r[4 * i + 3], r[4 * i], r[4 * i + 1], r[4 * i + 2]);
            if (glm::length(q) > 0)
                m = glm::mat4_cast(glm::normalize(q));
            else
                ++unturned;
        }
        for (int c = 0; c < 3; ++c) {
            if (!s.empty()) m[c] *= double{s[3 * i + static_cast<std::size_t>(c)]};
            if (!t.empty()) m[3][c] = t[3 * i + static_cast<std::size_t>(c)];
        }
        copies.push_back(m);
    }
    if (unturned)
        notes.push_back(
            fmt::format("{}: {} 0 0 0 0: no rotation is used", who, counted(unturned, "rotation")));
    return copies;
}

}  // namespace

void readInstancing(const Model& model, const std::vector<int>& sceneNode, MotionBudget& budget,
                    Scene& scene) {
    const std::size_t before = scene.notes.size();
    const Json& files = arrayAt(model.rest, "/nodes");
    for (std::size_t n = 0; n < files.size(); ++n) {
        const Json* e = extension(files[n], "EXT_mesh_gpu_instancing");
        if (sceneNode[n] < 0 || !e) continue;
        Node& node = scene.nodes[static_cast<std::size_t>(sceneNode[n])];
        const std::string who = fmt::format("node {}: EXT_mesh_gpu_instancing", n);
        if (node.mesh < 0) {
            scene.notes.push_back(who + ": the node has no mesh: left out");
            continue;
        }
        if (node.skin >= 0) {
            scene.notes.push_back(who + ": its mesh is skinned, so nodes do not move it: drawn once");
            continue;
        }
        const Attributes attributes(model, (*e)["attributes"], who);
        const std::optional<std::size_t> count = attributes.count();
        if (!count) {
            scene.notes.push_back(who + ": names no attribute: drawn once");
            continue;
        }
        const auto& primitives = model.meshes[static_cast<std::size_t>(node.mesh)].primitives;
        budget.hold(sizeof(glm::dmat4) + primitives.size() * sizeof(Instance), *count, who, "instances");
        std::vector<glm::dmat4> copies = copiesOf(attributes, *count, who, budget, scene.notes);
        node.copies = static_cast<int>(scene.copies.size());
        scene.copies.push_back(std::move(copies));
    }
    limitNotes(scene.notes, before, "instances");
}

}  // namespace diptych::gltf
