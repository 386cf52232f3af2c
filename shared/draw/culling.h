// SPDX-License-Identifier: MIT
// The triangles of a view's solid draws, anew for every frame: clusters from near to far, and with --cull on
// only what may show. Instances of one small mesh that follow one another are shown whole or not at all, so
// that one draw draws them. Where the device chooses (DeviceProfile::culls_by_compute), the host sorts
// clusters and chooses among such instances alone.
#pragma once

#include "shared/draw/compute_culling.h"
#include "shared/draw/draw_list.h"
#include "shared/draw/layouts.h"
#include "shared/draw/shown_clusters.h"
#include "shared/vulkan/resources.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace diptych {

class Culling {
public:
    static constexpr const char* name = "clusters";  // among a frame's passes

    // `draws`: of the pose and the view, and drawn from then on with what is chosen; its items stay as they
    // are. `on`: what cannot show is left out; what is left comes in the same order. Geometry, layouts and
    // draws must outlive it. Posed instances are drawn whole, as in the scene: their clusters have moved. Has
    // chosen once, so that what is drawn before a frame finds it.
    Culling(Device& device, Pipelines& pipelines, const Layouts& layouts, const Geometry& geometry,
            const Pose& pose, const View& view, int samples, bool on, DrawList& draws);
    Culling(const Culling&) = delete;
    Culling& operator=(const Culling&) = delete;

    // What the host does of it, before a frame is submitted that draws from it, and while none is drawn.
    // Returns how long it took, ms; 0 where nothing is to choose.
    double run();
    // What the device does of it, before the first pass that draws; and declares that the pass draws what is
    // chosen.
    void addPasses(PassList& passes) const;
    void read(PassList& passes, Pass& pass) const;

    bool any() const { return !parts_.empty(); }
    // Of DrawItem::chosen.
    VkBuffer indices() const { return compute_ ? compute_->indices() : indices_.handle(); }
    // One for each of DrawList::runs, drawn where an item is chosen; none where the host chooses, whose runs
    // are drawn.
    VkBuffer indirectDraws() const { return compute_ ? compute_->draws() : VK_NULL_HANDLE; }
    // The indices that the runs of chosen items count from; of a device read back, as it chose last.
    std::vector<std::uint32_t> chosenIndices() const;
    std::uint64_t bytes() const { return any() ? indices_.size() + (compute_ ? compute_->bytes() : 0) : 0; }

private:
    // One instance: which of its clusters may show, and how deep they are.
    struct Item {
        ShownClusters shown;
        glm::dvec4 depth;  // the view depth of an object's point is dot(depth, (point, 1)), m
        std::uint32_t first_cluster, clusters;
        std::uint32_t first;  // of as many, into order_
        std::uint32_t first_part, parts;
        std::uint32_t place;  // of its first index
        bool whole;           // drawn as the scene has it, or not at all; of one cluster
    };
    // Instances that one draw may draw. At most `gap` of them that cannot show are drawn all the same
    // where they stand between two that may, since another draw would take longer.
    struct Instances {
        std::uint32_t first_part, count;
        double gap;
    };
    // Clusters of one item that follow one another in order_, whose indices one run has.
    struct Part {
        std::uint32_t item, first, clusters;
        std::uint32_t place = 0;  // of its first index
    };
    void order(const Item& item);
    void choose(std::size_t part, std::uint32_t* indices);
    void fillGaps(const Instances& instances);

    const Geometry& geometry_;
    DrawList& draws_;
    bool on_;
    std::vector<Item> items_;
    std::vector<Part> parts_;  // each has the run of its number
    std::vector<Instances> instances_;
    std::vector<std::uint32_t> order_;  // numbers of clusters
    GpuBuffer indices_;                 // of the host's choice
    // Where the device chooses: of all that is not drawn whole, its parts' commands by the numbers of runs.
    std::vector<gpu::CulledItem> culled_items_;
    std::vector<gpu::CulledPart> culled_parts_;
    std::optional<ComputeCulling> compute_;
};

// What the draws of a view amount to.
struct DrawnCounts {
    std::uint64_t in_view = 0;    // triangles of instances that are drawn at all
    std::uint64_t drawn = 0;      // of these, those that Culling leaves
    std::uint64_t vertices = 0;   // that differ, draw by draw: a device shades no fewer
    std::uint64_t instances = 0;  // that are drawn
    std::uint64_t draws = 0;      // of all of them, blended ones too
};
DrawnCounts drawnCounts(const DrawList& draws, const Geometry& geometry, const Culling& culling);

}  // namespace diptych
