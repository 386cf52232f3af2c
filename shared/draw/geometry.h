// SPDX-License-Identifier: MIT
// Every primitive of a scene in three buffers: positions, other attributes, indices.
#pragma once

#include "shared/draw/clusters.h"
#include "shared/scene/model/scene.h"
#include "shared/vulkan/resources.h"

#include <span>
#include <vector>

namespace diptych {

struct PrimitiveRange {
    std::uint32_t first_index = 0, index_count = 0;
    std::int32_t vertex_offset = 0;
    std::uint32_t material = 0;
    bool vertex_color = false;
    bool vanishing_normals = false;           // somewhere in a triangle the interpolated normal may be zero
    glm::dvec3 bounds_min{0}, bounds_max{0};  // object
    std::uint32_t first_cluster = 0, cluster_count = 0;
};

class Geometry {
public:
    Geometry(Device& device, Uploader& uploader, const Scene& scene);

    const PrimitiveRange& range(int mesh, int primitive) const {
        return ranges_[static_cast<std::size_t>(mesh)][static_cast<std::size_t>(primitive)];
    }
    // Parts that together draw the range, in another order of triangles; their indices follow one another.
    std::span<const Cluster> clusters(const PrimitiveRange& range) const {
        return std::span(clusters_).subspan(range.first_cluster, range.cluster_count);
    }
    void bind(VkCommandBuffer commands, VkBuffer draws) const;
    std::uint64_t bytes() const { return positions_.size() + attributes_.size() + indices_.size(); }

private:
    std::vector<std::vector<PrimitiveRange>> ranges_;
    std::vector<Cluster> clusters_;
    GpuBuffer positions_, attributes_, indices_;
};

}  // namespace diptych
