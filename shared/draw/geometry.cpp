// SPDX-License-Identifier: MIT
#include "shared/draw/geometry.h"

#include "shared/contract/geometry.h"
#include "shared/contract/meshlet_culling.h"
#include "shared/scene/model/animated.h"
#include "shared/scene/motion/bounds.h"
#include "shared/scene/motion/posed.h"

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include <tbb/parallel_for.h>

#include <array>
#include <limits>
#include <stdexcept>
#include <utility>

namespace diptych {

// A primitive split into meshlets.
struct Geometry::CutPrimitive {
    std::vector<glm::vec3> moved;  // positions relative to the origin, if that is not 0
    std::vector<std::uint32_t> indices;
    std::vector<Meshlet> meshlets;
    MeshletTriangles triangles;
    const std::vector<glm::vec3>& positions(const Primitive& p) const {
        return moved.empty() ? p.positions : moved;
    }
};

namespace {

gpu::VertexAttributes attributesOf(const Primitive& p, std::size_t i) {
    return {p.normals[i], p.tangents[i], p.texcoords[0].empty() ? glm::vec2(0) : p.texcoords[0][i],
            p.texcoords[1].empty() ? glm::vec2(0) : p.texcoords[1][i],
            p.colors.empty() ? glm::vec4(1) : p.colors[i]};
}

// If the normals of a triangle are unit vectors less than 90 degrees apart, their interpolation is at
// least 1 / sqrt(3) long. The threshold leaves a margin for rounding.
bool mayVanish(const Primitive& p) {
    const auto apart = [&](std::uint32_t a, std::uint32_t b) {
        return !(glm::dot(p.normals[a], p.normals[b]) > 0.01f);
    };
    for (std::size_t i = 0; i + 2 < p.indices.size(); i += 3)
        if (apart(p.indices[i], p.indices[i + 1]) || apart(p.indices[i + 1], p.indices[i + 2]) ||
            apart(p.indices[i + 2], p.indices[i]))
            return true;
    return false;
}

// Whether its vertices are never deformed.
bool isRigid(const Primitive& p, const Scene& scene) {
    return p.joint_sets.empty() && p.targets.empty() && (scene.animations.empty() || !p.tangents_made);
}

// Origin of stored positions: the centre of the scene's meshes if they lie together far from their origin,
// as georeferenced ones do; else 0. It preserves float32 precision. All meshes share it, so that touching
// vertices stay bit for bit equal.
glm::dvec3 originOf(const Scene& scene) {
    constexpr double far = 4;  // multiple of the meshes' radius
    Bounds bounds;
    for (const Mesh& mesh : scene.meshes)
        for (const Primitive& p : mesh.primitives)
            for (const glm::vec3& position : p.positions) {
                bounds.min = glm::min(bounds.min, glm::dvec3(position));
                bounds.max = glm::max(bounds.max, glm::dvec3(position));
            }
    if (bounds.empty() || !(glm::length(bounds.centre()) > far * bounds.radius())) return glm::dvec3(0);
    return glm::dvec3(glm::vec3(bounds.centre()));
}

// Exact if positions are nearer to the origin than the origin is to 0 (Sterbenz 1974): float32 represents
// the difference.
std::vector<glm::vec3> countedFrom(const glm::dvec3& origin, const std::vector<glm::vec3>& positions) {
    std::vector<glm::vec3> counted;
    counted.reserve(positions.size());
    for (const glm::vec3& position : positions) counted.emplace_back(glm::dvec3(position) - origin);
    return counted;
}

// Throws std::runtime_error if there are too many. They are stored up to twice: in scene order and in
// meshlet order.
std::uint32_t indexCountOf(const Scene& scene) {
    std::uint64_t sum = 0;
    for (const Mesh& mesh : scene.meshes)
        for (const Primitive& p : mesh.primitives) sum += p.indices.size();
    if (2 * sum > std::numeric_limits<std::uint32_t>::max())
        throw std::runtime_error("the scene has over 2^31 indices, too many for one buffer");
    return static_cast<std::uint32_t>(sum);
}

std::vector<gpu::CulledMeshlet> culledMeshlets(std::span<const Meshlet> meshlets) {
    std::vector<gpu::CulledMeshlet> culled;
    culled.reserve(meshlets.size());
    for (const Meshlet& c : meshlets) culled.push_back({c.min, c.first_index, c.max, c.index_count / 3});
    return culled;
}

}  // namespace

std::vector<Geometry::CutPrimitive> Geometry::cut(const Scene& scene, const glm::dvec3& origin) {
    std::vector<const Primitive*> all;
    for (const Mesh& mesh : scene.meshes)
        for (const Primitive& p : mesh.primitives) all.push_back(&p);
    std::vector<CutPrimitive> cuts(all.size());
    tbb::parallel_for(std::size_t{0}, all.size(), [&](std::size_t i) {
        const Primitive& p = *all[i];
        CutPrimitive& made = cuts[i];
        if (origin != glm::dvec3(0) && isRigid(p, scene)) made.moved = countedFrom(origin, p.positions);
        if (p.indices.empty()) return;
        made.indices = p.indices;
        made.meshlets = buildMeshlets(made.positions(p), made.indices);
        for (const Meshlet& meshlet : made.meshlets)
            made.triangles.add(
                meshlet, made.positions(p),
                std::span(std::as_const(made.indices)).subspan(meshlet.first_index, meshlet.index_count));
    });
    return cuts;
}

Geometry::Geometry(Device& device, Uploader& uploader, const Scene& scene) : scene_(scene) {
    std::vector<glm::vec3> positions;
    std::vector<gpu::VertexAttributes> attributes;
    std::vector<std::uint32_t> indices;
    first_meshlet_index_ = indexCountOf(scene);
    const std::vector<bool> mayBlend = materialsThatBlend(scene);
    const glm::dvec3 origin = originOf(scene);
    std::vector<CutPrimitive> cuts = cut(scene, origin);
    std::size_t next = 0;
    for (const Mesh& mesh : scene.meshes) {
        ranges_.emplace_back();
        for (const Primitive& p : mesh.primitives) {
            if (positions.size() + p.positions.size() > std::numeric_limits<std::int32_t>::max())
                throw std::runtime_error("the scene has over 2^31 vertices, too many for one buffer");
            PrimitiveRange range;
            range.first_index = static_cast<std::uint32_t>(indices.size());
            range.index_count = static_cast<std::uint32_t>(p.indices.size());
            range.vertex_offset = static_cast<std::int32_t>(positions.size());
            range.material = static_cast<std::uint32_t>(p.material);
            range.vertex_color = !p.colors.empty();
            range.vanishing_normals = mayVanish(p);
            CutPrimitive made = std::move(cuts[next++]);
            if (!made.moved.empty()) range.origin = origin;
            const std::vector<glm::vec3>& stored = made.positions(p);
            if (!stored.empty()) range.bounds_min = range.bounds_max = stored[0];
            for (std::size_t i = 0; i < stored.size(); ++i) {
                attributes.push_back(attributesOf(p, i));
                range.bounds_min = glm::min(range.bounds_min, glm::dvec3(stored[i]));
                range.bounds_max = glm::max(range.bounds_max, glm::dvec3(stored[i]));
            }
            positions.insert(positions.end(), stored.begin(), stored.end());
            indices.insert(indices.end(), p.indices.begin(), p.indices.end());
            addMeshlets(range, made);
            if (mayBlend[range.material]) keep(range, p);
            ranges_.back().push_back(range);
        }
    }
    indices.insert(indices.end(), meshlet_indices_.begin(), meshlet_indices_.end());
    // Deformation reads them by address and copies attributes that it does not change.
    constexpr VkBufferUsageFlags posed =
        VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT;
    positions_ = makeBuffer<glm::vec3>(device, uploader, "positions", positions,
                                       VK_BUFFER_USAGE_VERTEX_BUFFER_BIT | posed);
    attributes_ = makeBuffer<gpu::VertexAttributes>(device, uploader, "vertex attributes", attributes,
                                                    VK_BUFFER_USAGE_VERTEX_BUFFER_BIT | posed);
    indices_ = makeBuffer<std::uint32_t>(device, uploader, "indices", indices,
                                         VK_BUFFER_USAGE_INDEX_BUFFER_BIT | posed);
    if (device.profile().culls_by_compute)
        meshlet_buffer_ =
            makeBuffer<gpu::CulledMeshlet>(device, uploader, "clusters", culledMeshlets(meshlets_),
                                           VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT);
}

void Geometry::addMeshlets(PrimitiveRange& range, const CutPrimitive& cut) {
    range.first_meshlet = static_cast<std::uint32_t>(meshlets_.size());
    for (Meshlet meshlet : cut.meshlets) {
        meshlet.first_index += first_meshlet_index_ + static_cast<std::uint32_t>(meshlet_indices_.size());
        meshlets_.push_back(meshlet);
    }
    meshlet_indices_.insert(meshlet_indices_.end(), cut.indices.begin(), cut.indices.end());
    meshlet_triangles_.add(cut.triangles);
    range.meshlet_count = static_cast<std::uint32_t>(meshlets_.size()) - range.first_meshlet;
}

void Geometry::keep(PrimitiveRange& range, const Primitive& p) {
    range.kept_indices = static_cast<std::uint32_t>(kept_indices_.size());
    range.kept_positions = static_cast<std::uint32_t>(kept_positions_.size());
    kept_indices_.insert(kept_indices_.end(), p.indices.begin(), p.indices.end());
    kept_positions_.insert(kept_positions_.end(), p.positions.begin(), p.positions.end());
}

PlacedPrimitive Geometry::placed(const Pose& pose, const Instance& instance) const {
    PlacedPrimitive placed;
    placed.range = range(instance.mesh, instance.primitive);
    placed.world_from_object = glm::translate(instance.world_from_object, placed.range.origin);
    placed.mirrored = glm::determinant(glm::dmat3(instance.world_from_object)) < 0;
    placed.box = instance.box;
    if (instance.box < 0) return placed;
    placed.range.origin = glm::dvec3(0);
    const PosedBox& box = pose.boxes[static_cast<std::size_t>(instance.box)];
    placed.world_from_object = glm::translate(glm::dmat4(1), box.origin);
    placed.range.bounds_min = box.min;
    placed.range.bounds_max = box.max;
    placed.range.vanishing_normals = true;  // a pose may turn two normals against each other
    placed.whole = {placed.range.first_index, placed.range.index_count, glm::vec3(box.min),
                    glm::vec3(box.max)};
    return placed;
}

TriangleView Geometry::triangles(const PrimitiveRange& range) const {
    if (range.kept_indices == PrimitiveRange::not_kept) return {};
    return {std::span(kept_positions_).subspan(range.kept_positions),
            std::span(kept_indices_).subspan(range.kept_indices, range.index_count)};
}

PlacedTriangles Geometry::triangles(const Pose& pose, const Instance& instance) const {
    PlacedTriangles triangles{
        this->triangles(range(instance.mesh, instance.primitive)), {}, instance.world_from_object};
    if (!instance.deformed()) return triangles;
    triangles.posed = posedPositions(scene_, pose, instance);
    triangles.world_from_object = glm::dmat4(1);
    return triangles;
}

void Geometry::bindVertices(VkCommandBuffer commands) const {
    const std::array buffers{positions_.handle(), attributes_.handle()};
    const std::array<VkDeviceSize, 2> offsets{};
    vkCmdBindVertexBuffers(commands, 0, 2, buffers.data(), offsets.data());
}

void Geometry::bind(VkCommandBuffer commands, VkBuffer draws, VkBuffer indices) const {
    bindVertices(commands);
    constexpr VkDeviceSize none = 0;
    vkCmdBindVertexBuffers(commands, 2, 1, &draws, &none);
    bindIndices(commands, indices);
}

void Geometry::bindIndices(VkCommandBuffer commands, VkBuffer indices) const {
    vkCmdBindIndexBuffer(commands, indices != VK_NULL_HANDLE ? indices : indices_.handle(), 0,
                         VK_INDEX_TYPE_UINT32);
}

}  // namespace diptych
