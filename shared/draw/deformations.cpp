// SPDX-License-Identifier: MIT
#include "shared/draw/deformations.h"

#include "shared/contract/geometry.h"
#include "shared/draw/arena.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace diptych {

namespace {

// Stores offsets into the arena plus 1, which become addresses once the buffer exists; 0: none.
class Collector {
public:
    Collector(Arena& arena, const Geometry& geometry) : arena_(arena), geometry_(geometry) {}

    Deformations::Rest take(const Primitive& p, const PrimitiveRange& range) {
        Deformations::Rest rest;
        gpu::PosedInstance& i = rest.instance;
        const auto first = static_cast<VkDeviceAddress>(range.vertex_offset);
        i.positions = addressWords(geometry_.positions().address() + first * sizeof(glm::vec3));
        i.attributes = addressWords(geometry_.attributes().address() + first * sizeof(gpu::VertexAttributes));
        i.indices = addressWords(geometry_.indices().address() +
                                 VkDeviceAddress{range.first_index} * sizeof(std::uint32_t));
        i.first_vertex = static_cast<gpu::uint>(range.vertex_offset);
        i.vertices = static_cast<gpu::uint>(p.positions.size());
        i.pivot = glm::vec3((range.bounds_min + range.bounds_max) / 2.0);
        i.flat_normals = p.flat ? 1 : 0;
        if (!p.joint_sets.empty()) takeJoints(p, i);
        for (const MorphTarget& t : p.targets)
            rest.targets.push_back({add(t.positions), add(t.normals), add(t.tangents), add(t.texcoords[0]),
                                    add(t.texcoords[1]), add(t.colors)});
        if (!p.tangent_groups.empty()) {
            i.groups = p.tangent_groups.count();
            i.group_of_vertex = addressWords(add(p.tangent_groups.of_vertex));
            i.group_first = addressWords(add(p.tangent_groups.first));
            i.group_corners = addressWords(add(p.tangent_groups.corners));
        }
        return rest;
    }

private:
    // Offset plus 1.
    template <class T>
    VkDeviceAddress add(const std::vector<T>& values) {
        return values.empty() ? 0 : arena_.add(values) + 1;
    }

    void takeJoints(const Primitive& p, gpu::PosedInstance& i) {
        std::vector<glm::uvec2> joints;
        std::vector<glm::vec4> weights;
        std::vector<double> whole(p.positions.size(), 0);
        for (const JointSet& set : p.joint_sets)
            for (std::size_t v = 0; v < whole.size(); ++v)
                for (int c = 0; c < 4; ++c) whole[v] += set.weights[v][c];
        for (const JointSet& set : p.joint_sets)
            for (std::size_t v = 0; v < whole.size(); ++v) {
                const glm::u16vec4& j = set.joints[v];
                joints.emplace_back(j.x | std::uint32_t{j.y} << 16, j.z | std::uint32_t{j.w} << 16);
                weights.emplace_back(glm::dvec4(set.weights[v]) / whole[v]);
            }
        i.joint_sets = static_cast<gpu::uint>(p.joint_sets.size());
        i.joints = addressWords(add(joints));
        i.joint_weights = addressWords(add(weights));
    }

    Arena& arena_;
    const Geometry& geometry_;
};

// Converts an offset plus 1.
void place(VkDeviceAddress base, VkDeviceAddress& address) {
    if (address != 0) address += base - 1;
}
void place(VkDeviceAddress base, gpu::uvec2& words) {
    VkDeviceAddress address = words.x | VkDeviceAddress{words.y} << 32;
    place(base, address);
    words = addressWords(address);
}

}  // namespace

Deformations::Deformations(Device& device, Uploader& uploader, const Scene& scene, const Geometry& geometry) {
    Arena arena;
    Collector collector(arena, geometry);
    for (std::size_t m = 0; m < scene.meshes.size(); ++m)
        for (std::size_t p = 0; p < scene.meshes[m].primitives.size(); ++p) {
            const Primitive& primitive = scene.meshes[m].primitives[p];
            if (primitive.indices.empty() || (primitive.joint_sets.empty() && primitive.targets.empty() &&
                                              primitive.tangent_groups.empty()))
                continue;
            const std::pair place(static_cast<int>(m), static_cast<int>(p));
            rest_.emplace(place, collector.take(primitive, geometry.range(place.first, place.second)));
        }
    if (rest_.empty()) return;
    buffer_ = arena.makeBuffer(device, "joints and morph targets");
    const VkDeviceAddress base = buffer_.address();
    for (auto& [where, rest] : rest_) {
        gpu::PosedInstance& i = rest.instance;
        for (gpu::uvec2* const words :
             {&i.joints, &i.joint_weights, &i.group_of_vertex, &i.group_first, &i.group_corners})
            place(base, *words);
        for (Target& t : rest.targets)
            for (VkDeviceAddress* const address :
                 {&t.positions, &t.normals, &t.tangents, &t.texcoords0, &t.texcoords1, &t.colors})
                place(base, *address);
    }
    arena.upload(uploader, buffer_);
}

}  // namespace diptych
