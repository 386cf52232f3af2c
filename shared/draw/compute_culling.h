// SPDX-License-Identifier: MIT
// GPU culling: a compute shader writes the indices of triangles that may be visible and their indirect
// draws. The CPU provides the order of meshlets.
#pragma once

#include "shared/contract/meshlet_culling.h"
#include "shared/draw/geometry.h"
#include "shared/draw/visible_meshlets.h"
#include "shared/vulkan/passes/pass_list.h"
#include "shared/vulkan/pipelines/pipelines.h"

#include <cstdint>
#include <span>
#include <vector>

namespace diptych {

class ComputeCulling {
public:
    // Capacities.
    struct Sizes {
        std::uint32_t items = 0, parts = 0, meshlets = 0, indices = 0;  // meshlets: of all parts together
        std::uint32_t draws = 0;
    };
    // `layout`: Layouts::culling. Geometry and layout must outlive it.
    ComputeCulling(Device& device, Pipelines& pipelines, VkPipelineLayout layout, const Geometry& geometry,
                   const SampleGrid& grid, const Sizes& sizes);

    // Inputs of the compute shader. The CPU writes them while no frame is in flight.
    std::span<gpu::CulledItem> items();  // the items of parts
    std::span<gpu::CulledPart> parts();
    std::span<std::uint32_t> order();  // meshlet indices, part by part, near to far

    void addPass(PassList& passes, const char* name) const;
    void read(PassList& passes, Pass& pass) const;
    // Runs the pass and waits: for draws before the first frame.
    void runOnce(const char* name) const;

    VkBuffer indices() const { return indices_.handle(); }
    VkBuffer draws() const { return draws_.handle(); }
    // Results of the last run.
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
