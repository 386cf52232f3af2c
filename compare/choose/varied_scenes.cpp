// SPDX-License-Identifier: MIT
#include "compare/choose/variations.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace diptych::choose {

namespace {

glm::vec3 extentOf(const Primitive& primitive) {
    glm::vec3 low = primitive.positions.front(), high = low;
    for (const glm::vec3& position : primitive.positions) {
        low = glm::min(low, position);
        high = glm::max(high, position);
    }
    return high - low;
}

// Inserts `copies` before each triangle, each slightly deeper below the surface. They are rendered first,
// so without a pre-pass they are shaded and then overdrawn.
void addBelow(Primitive& primitive, int copies) {
    constexpr float deeper = 1e-3f;  // fraction of the primitive's extent; far above depth precision
    const std::size_t count = primitive.positions.size();
    const float step = deeper * glm::length(extentOf(primitive));
    std::vector<std::uint32_t> indices;
    const std::vector<std::uint32_t> own = primitive.indices;
    const Primitive surface = primitive;
    const auto append = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
    for (int copy = 0; copy < copies; ++copy) {
        for (std::size_t i = 0; i < count; ++i)
            primitive.positions.push_back(surface.positions[i] -
                                          static_cast<float>(copies - copy) * step * surface.normals[i]);
        append(primitive.normals, surface.normals);
        append(primitive.tangents, surface.tangents);
        for (int set = 0; set < 2; ++set) append(primitive.texcoords[set], surface.texcoords[set]);
        append(primitive.colors, surface.colors);
    }
    for (std::size_t at = 0; at + 2 < own.size(); at += 3) {
        for (int copy = 0; copy < copies; ++copy)
            for (std::size_t corner = 0; corner < 3; ++corner)
                indices.push_back(own[at + corner] +
                                  static_cast<std::uint32_t>(count * static_cast<std::size_t>(copy + 1)));
        for (std::size_t corner = 0; corner < 3; ++corner) indices.push_back(own[at + corner]);
    }
    primitive.indices = std::move(indices);
}

template <class Vary>
Scene withPrimitives(Scene scene, const Vary& vary) {
    for (Mesh& mesh : scene.meshes)
        for (Primitive& primitive : mesh.primitives) vary(primitive);
    return scene;
}

const Material& materialOf(const Scene& scene, const Primitive& primitive) {
    return scene.materials[static_cast<std::size_t>(primitive.material)];
}

}  // namespace

Scene withLights(const Scene& scene, std::span<const Light> lights, double factor) {
    Scene varied = scene;
    varied.lights.clear();
    for (std::size_t i = 0; i < lights.size(); ++i) {
        Light light = lights[i];
        light.node = -1;  // `lights` have world transforms
        light.source = -1;
        if (factor >= 1) {
            // Full brightness: --light-cutoff would shrink the range of a darker light.
            varied.lights.push_back(light);
            light.shadow = false;
            for (int copy = 1; copy < static_cast<int>(factor); ++copy) varied.lights.push_back(light);
        } else if (i % static_cast<std::size_t>(std::lround(1 / factor)) == 0) {
            varied.lights.push_back(light);
        }
    }
    return varied;
}

Scene withOverdraw(const Scene& scene, int copies) {
    return withPrimitives(scene, [&](Primitive& primitive) {
        const bool moves = !primitive.joint_sets.empty() || !primitive.targets.empty();
        if (!moves && !primitive.positions.empty() && !blends(materialOf(scene, primitive)))
            addBelow(primitive, copies);
    });
}

Scene withEmptyTriangles(const Scene& scene, int copies) {
    return withPrimitives(scene, [&](Primitive& primitive) {
        const std::vector<std::uint32_t> own = primitive.indices;
        for (int copy = 0; copy < copies; ++copy)
            for (std::size_t at = 0; at + 2 < own.size(); at += 3)
                primitive.indices.insert(primitive.indices.end(), {own[at], own[at + 1], own[at + 1]});
    });
}

Scene withOneMaterial(const Scene& scene) {
    std::optional<int> first;
    return withPrimitives(scene, [&](Primitive& primitive) {
        if (blends(materialOf(scene, primitive))) return;
        if (!first) first = primitive.material;
        primitive.material = *first;
    });
}

Scene withOwnMaterials(const Scene& scene) {
    Scene varied = scene;
    std::vector<bool> used(scene.materials.size(), false);
    for (Mesh& mesh : varied.meshes)
        for (Primitive& primitive : mesh.primitives) {
            const auto material = static_cast<std::size_t>(primitive.material);
            if (used[material]) {
                varied.materials.push_back(scene.materials[material]);
                primitive.material = static_cast<int>(varied.materials.size()) - 1;
            }
            used[material] = true;
        }
    return varied;
}

Scene withBlends(const Scene& scene, bool all) {
    Scene varied = scene;
    for (Material& material : varied.materials) {
        if (all && blends(material)) continue;
        material.alpha_mode = all ? AlphaMode::blend : material.alpha_mode;
        if (!all && material.alpha_mode == AlphaMode::blend) material.alpha_mode = AlphaMode::opaque;
        if (!all) material.transmission = 0;
    }
    return varied;
}

}  // namespace diptych::choose
