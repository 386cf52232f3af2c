// SPDX-License-Identifier: MIT
// What of a view's solid draws may show, chosen anew for every frame (--cull): indices of their triangles in
// the order of clusters, which is that of --cull off.
#pragma once

#include "shared/draw/draw_list.h"
#include "shared/draw/shown_clusters.h"
#include "shared/vulkan/resources.h"

#include <cstdint>
#include <span>
#include <vector>

namespace diptych {

class Culling {
public:
    // `draws`: of the pose and the view, and drawn from then on with what is chosen; its items stay as they
    // are. Geometry and draws must outlive it. Posed instances are drawn whole, as their clusters move.
    Culling(Device& device, const Geometry& geometry, const Pose& pose, const View& view, int samples,
            bool on, DrawList& draws);
    Culling(const Culling&) = delete;
    Culling& operator=(const Culling&) = delete;

    // Chooses, into the buffer of indices(): before a frame is submitted that draws from it, and while none
    // is drawn. Returns how long it took, ms; 0 where nothing is to choose.
    double run();
    bool any() const { return !parts_.empty(); }
    VkBuffer indices() const { return indices_.handle(); }  // of DrawItem::chosen
    std::span<const std::uint32_t> chosen(const IndexRun& run) const {
        return {static_cast<const std::uint32_t*>(indices_.mapped()) + run.first, run.count};
    }
    std::uint64_t bytes() const { return any() ? indices_.size() : 0; }

private:
    // Clusters of one item that follow one another, whose indices one run has.
    struct Part {
        std::uint32_t item, first_cluster, clusters;
        std::uint32_t run;    // into DrawList::runs
        std::uint32_t place;  // of its first index
    };
    void choose(const Part& part, std::uint32_t* indices) const;

    const Geometry& geometry_;
    DrawList& draws_;
    std::vector<ShownClusters> shown_;  // by item
    std::vector<Part> parts_;
    GpuBuffer indices_;
};

// What the draws of a view amount to.
struct DrawnCounts {
    std::uint64_t in_view = 0;   // triangles of instances that are drawn at all
    std::uint64_t drawn = 0;     // of these, those that Culling leaves
    std::uint64_t vertices = 0;  // that differ, draw by draw: a device shades no fewer
};
DrawnCounts drawnCounts(const DrawList& draws, const Geometry& geometry, const Culling& culling);

}  // namespace diptych
