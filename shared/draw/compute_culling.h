// SPDX-License-Identifier: MIT
// Chooses the triangles of a view that may show on the device: a kernel writes their indices and the indirect
// draws of them. What the host knows better, the order of clusters, it is given.
#pragma once

#include "shared/contract/culling.h"
#include "shared/draw/geometry.h"
#include "shared/draw/shown_clusters.h"
#include "shared/vulkan/pass_list.h"
#include "shared/vulkan/pipelines.h"

#include <cstdint>
#include <span>
#include <vector>

namespace diptych {

class ComputeCulling {
public:
    // What it may be asked to choose of.
    struct Sizes {
        std::uint32_t parts = 0, clusters = 0, indices = 0;  // clusters: of all parts
        std::uint32_t draws = 0;
    };
    // `items`: that parts refer to. `layout`: Layouts::culling. Geometry and layout must outlive it.
    ComputeCulling(Device& device, Pipelines& pipelines, VkPipelineLayout layout, const Geometry& geometry,
                   const SampleGrid& grid, std::span<const gpu::CulledItem> items, const Sizes& sizes);

    // What the kernel reads, in memory that the host writes while no frame is drawn.
    std::span<gpu::CulledPart> parts();
    std::span<std::uint32_t> order();  // numbers of clusters, part by part from near to far

    void addPass(PassList& passes, const char* name) const;
    void read(PassList& passes, Pass& pass) const;
    // Runs it, and waits: for what is drawn before a frame.
    void runOnce(const char* name) const;

    VkBuffer indices() const { return indices_.handle(); }
    VkBuffer draws() const { return draws_.handle(); }
    // As the kernel left them last.
    std::vector<gpu::IndirectDraw> readDraws() const;
    std::vector<std::uint32_t> readIndices() const;
    std::uint64_t bytes() const;

private:
    template <class T>
    std::vector<T> readBack(const GpuBuffer& from) const;

    Device& device_;
    Pipelines& pipelines_;
    VkPipelineLayout layout_;
    Sizes sizes_;
    GpuBuffer items_, parts_, order_, indices_, draws_;
    gpu::CullingConstants constants_{};
};

}  // namespace diptych
