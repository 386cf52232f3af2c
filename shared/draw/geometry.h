// SPDX-License-Identifier: MIT
// All primitives of a scene in three buffers: positions, other attributes, indices.
#pragma once

#include "shared/draw/meshlet_triangles.h"
#include "shared/scene/model/scene.h"
#include "shared/scene/motion/instances.h"
#include "shared/vulkan/device/resources.h"

#include <span>
#include <vector>

namespace diptych {

struct PrimitiveRange {
    std::uint32_t first_index = 0, index_count = 0;
    std::int32_t vertex_offset = 0;
    std::uint32_t material = 0;
    bool vertex_color = false;
    bool vanishing_normals = false;           // an interpolated normal may be zero
    glm::dvec3 origin{0};                     // object space, m: origin of the stored positions
    glm::dvec3 bounds_min{0}, bounds_max{0};  // object space, relative to the origin
    std::uint32_t first_meshlet = 0, meshlet_count = 0;
    static constexpr std::uint32_t not_kept = ~0u;
    std::uint32_t kept_indices = not_kept, kept_positions = 0;  // for Geometry::triangles()
};

// Triangles of a primitive on the CPU.
struct TriangleView {
    std::span<const glm::vec3> positions;    // object, m
    std::span<const std::uint32_t> indices;  // into positions, three per triangle
};

// A primitive as an instance draws it, rigid or deformed. World axes; deformed vertices are relative to
// their box's origin.
struct PlacedPrimitive {
    PrimitiveRange range;
    glm::dmat4 world_from_object{1};  // of stored positions: relative to the range's origin
    bool mirrored = false;
    int box = -1;     // into Pose::boxes; -1: not deformed
    Meshlet whole{};  // the only meshlet of a deformed primitive
};

// Triangles of an instance on the CPU.
struct PlacedTriangles {
    TriangleView rest;
    std::vector<glm::dvec3> posed;  // replaces rest's positions if deformed; NaN: not drawn
    glm::dmat4 world_from_object{1};
    glm::dvec3 corner(std::size_t i) const {
        return posed.empty() ? glm::dvec3(rest.positions[rest.indices[i]]) : posed[rest.indices[i]];
    }
};

class Geometry {
public:
    // The scene must outlive it.
    Geometry(Device& device, Uploader& uploader, const Scene& scene);

    const PrimitiveRange& range(int mesh, int primitive) const {
        return ranges_[static_cast<std::size_t>(mesh)][static_cast<std::size_t>(primitive)];
    }
    // Meshlets that draw the range, in another order of triangles; their indices are contiguous.
    std::span<const Meshlet> meshlets(const PrimitiveRange& range) const {
        return std::span(meshlets_).subspan(range.first_meshlet, range.meshlet_count);
    }
    // By index, which starts at PrimitiveRange::first_meshlet.
    const Meshlet& meshlet(std::uint32_t index) const { return meshlets_[index]; }
    const MeshletTriangles& meshletTriangles() const { return meshlet_triangles_; }
    std::span<const std::uint32_t> indicesOf(const Meshlet& meshlet) const {
        return std::span(meshlet_indices_)
            .subspan(meshlet.first_index - first_meshlet_index_, meshlet.index_count);
    }
    PlacedPrimitive placed(const Pose& pose, const Instance& instance) const;
    std::span<const Meshlet> meshlets(const PlacedPrimitive& placed) const {
        return placed.box >= 0 ? std::span(&placed.whole, 1) : meshlets(placed.range);
    }
    // In scene order. Empty unless the primitive's material blends at some time.
    TriangleView triangles(const PrimitiveRange& range) const;
    PlacedTriangles triangles(const Pose& pose, const Instance& instance) const;
    // `indices`: replaces the scene's index buffer.
    void bind(VkCommandBuffer commands, VkBuffer draws, VkBuffer indices = VK_NULL_HANDLE) const;
    void bindVertices(VkCommandBuffer commands) const;  // without draws and indices
    void bindIndices(VkCommandBuffer commands, VkBuffer indices = VK_NULL_HANDLE) const;
    const Scene& scene() const { return scene_; }
    const GpuBuffer& positions() const { return positions_; }
    const GpuBuffer& attributes() const { return attributes_; }
    const GpuBuffer& indices() const { return indices_; }
    // CulledMeshlet[] by meshlet index; empty if the CPU culls (DeviceProfile::culls_by_compute).
    const GpuBuffer& meshletBuffer() const { return meshlet_buffer_; }
    std::uint64_t bytes() const {
        return positions_.size() + attributes_.size() + indices_.size() + meshlet_buffer_.size();
    }
    // CPU memory of blended primitives, and of meshlets.
    std::uint64_t hostBytes() const {
        return kept_positions_.size() * sizeof(glm::vec3) + kept_indices_.size() * sizeof(std::uint32_t);
    }
    std::uint64_t meshletBytes() const {
        return meshlets_.size() * sizeof(Meshlet) + meshlet_triangles_.bytes() +
               meshlet_indices_.size() * sizeof(std::uint32_t);
    }

private:
    struct CutPrimitive;
    // Splits every primitive, mesh by mesh.
    static std::vector<CutPrimitive> cut(const Scene& scene, const glm::dvec3& origin);
    void addMeshlets(PrimitiveRange& range, const CutPrimitive& cut);
    // Keeps triangles for sorting.
    void keep(PrimitiveRange& range, const Primitive& p);

    const Scene& scene_;
    std::vector<std::vector<PrimitiveRange>> ranges_;
    std::vector<Meshlet> meshlets_;
    MeshletTriangles meshlet_triangles_;
    std::vector<std::uint32_t> meshlet_indices_;  // their indices, as in the device's buffer
    std::uint32_t first_meshlet_index_ = 0;       // offset of meshlet_indices_ in that buffer
    std::vector<glm::vec3> kept_positions_;       // of blended primitives
    std::vector<std::uint32_t> kept_indices_;
    GpuBuffer positions_, attributes_, indices_, meshlet_buffer_;
};

}  // namespace diptych
