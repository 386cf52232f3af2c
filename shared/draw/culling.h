// SPDX-License-Identifier: MIT
// Visible triangles of a view's opaque draws, recomputed for every frame: meshlets are sorted near to far,
// and with --cull on culled. Consecutive instances of a small mesh are culled as a whole, so that one draw
// covers them. If the GPU culls (DeviceProfile::culls_by_compute), the CPU only sorts meshlets and culls
// such instances.
#pragma once

#include "shared/draw/compute_culling.h"
#include "shared/draw/draw_list.h"
#include "shared/draw/layouts.h"
#include "shared/draw/visible_meshlets.h"
#include "shared/vulkan/device/resources.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace diptych {

class Culling {
public:
    static constexpr const char* name = "clusters";  // name of the pass

    struct Image {
        const Pose& pose;
        const View& view;
        int samples;  // per pixel
        bool culls;   // triangles; the order of the others is unchanged
    };
    // `draws`: of the image; from now on draws use the culled indices, and the items must not change.
    // Geometry, layouts and draws must outlive it. Deformed instances are not culled, because their meshlets
    // have moved. The constructor culls once, for draws before the first frame.
    Culling(Device& device, Pipelines& pipelines, const Layouts& layouts, const Geometry& geometry,
            const Image& image, DrawList& draws);
    Culling(const Culling&) = delete;
    Culling& operator=(const Culling&) = delete;

    // CPU part. Call before submitting a frame that draws from it, with no frame in flight. Returns its
    // time in ms; 0 if there is nothing to cull.
    double run();
    // addPasses() adds the GPU part and goes before the first pass that draws. read() declares that the
    // pass draws the result.
    void addPasses(PassList& passes) const;
    void read(PassList& passes, Pass& pass) const;

    bool any() const { return !parts_.empty(); }
    // Index buffer of draws with DrawItem::uses_visible_indices.
    VkBuffer indices() const { return compute_ ? compute_->indices() : indices_.handle(); }
    // An indirect draw for each of DrawList::runs, used by these items. Null if the CPU culls;
    // DrawList::runs then has the index ranges.
    VkBuffer indirectDraws() const { return compute_ ? compute_->draws() : VK_NULL_HANDLE; }
    // Indices that the index ranges of these items refer to. From the GPU, its last result is read back.
    std::vector<std::uint32_t> visibleIndices() const;
    std::uint64_t bytes() const { return any() ? indices_.size() + (compute_ ? compute_->bytes() : 0) : 0; }

private:
    // One instance: visibility of its meshlets, and their depth.
    struct Item {
        VisibleMeshlets shown;
        glm::dvec4 depth;  // view depth of an object-space point, m: dot(depth, (point, 1))
        std::uint32_t first_meshlet, meshlets;
        std::uint32_t first;  // offset in order_ of its `meshlets` entries
        std::uint32_t first_part, parts;
        std::uint32_t first_index;  // offset of its first index
        bool whole;                 // one meshlet, drawn from the scene's indices or not at all
    };
    // Instances that one draw may cover. Up to `gap` culled instances between two visible ones are drawn,
    // because splitting the draw would cost more.
    struct Instances {
        std::uint32_t first_part, count;
        double gap;
    };
    // Consecutive meshlets of one item in order_, which share one index range.
    struct Part {
        std::uint32_t item, first, meshlets;
        std::uint32_t first_index = 0;  // offset of its first index
    };
    void addParts(const Item& item);
    void addCulled(const Item& item, const gpu::CulledItem& culled);
    // Culls once on the GPU, and takes the index ranges.
    void runOnHost(Device& device, std::uint32_t indices);  // at most so many
    void runOnGpu();
    void order(const Item& item);
    void selectVisible(std::size_t part, std::uint32_t* indices);
    void fillGaps(const Instances& instances);

    const Geometry& geometry_;
    DrawList& draws_;
    bool on_;
    std::vector<Item> items_;
    std::vector<Part> parts_;  // part i has DrawList::runs[i]
    std::vector<Instances> instances_;
    std::vector<std::uint32_t> order_;  // meshlet indices
    GpuBuffer indices_;                 // of CPU culling
    // GPU culling: every item that is not `whole`. A part's command is the index of its run.
    std::vector<gpu::CulledItem> culled_items_;
    std::vector<gpu::CulledPart> culled_parts_;
    std::optional<ComputeCulling> compute_;
};

// Workload of a view's draws.
struct DrawnCounts {
    std::uint64_t in_view = 0;    // triangles of all instances that pass frustum culling
    std::uint64_t drawn = 0;      // triangles after Culling
    std::uint64_t vertices = 0;   // distinct vertices per draw: a lower bound of what the GPU shades
    std::uint64_t instances = 0;  // drawn instances
    std::uint64_t draws = 0;      // draw calls, blended ones included
};
DrawnCounts drawnCounts(const DrawList& draws, const Geometry& geometry, const Culling& culling);

}  // namespace diptych
