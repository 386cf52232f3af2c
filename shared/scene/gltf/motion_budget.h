// SPDX-License-Identifier: MIT
#pragma once

#include "shared/scene/gltf/accessor.h"
#include "shared/scene/gltf/limits.h"
#include "shared/scene/gltf/model.h"
#include "shared/text/fail.h"

#include <fmt/format.h>

#include <cstddef>
#include <string>

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

}  // namespace diptych::gltf
