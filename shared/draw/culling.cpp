// SPDX-License-Identifier: MIT
#include "shared/draw/culling.h"

#include "shared/contract/features.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>
#include <cstring>

namespace diptych {

namespace {

// Clusters that one thread goes through at a time.
constexpr std::uint32_t partClusters = 64;

SampleGrid gridOf(const Device& device, const View& view, int samples) {
    // A step of the grid that corners are moved to; nothing says whether they go to the nearest.
    return {view.width, view.height, samples,
            std::ldexp(1.0, -static_cast<int>(device.limits().subPixelPrecisionBits))};
}

}  // namespace

Culling::Culling(Device& device, const Geometry& geometry, const Pose& pose, const View& view, int samples,
                 bool on, DrawList& draws)
    : geometry_(geometry), draws_(draws) {
    if (!on) return;
    const SampleGrid grid = gridOf(device, view, samples);
    const glm::dmat4 clipFromWorld = view.clipFromWorld();
    std::uint32_t place = 0;
    draws_.runs.clear();
    for (std::uint32_t i = 0; i < draws_.solid; ++i) {
        DrawItem& item = draws_.items[i];
        const PlacedPrimitive placed = geometry.placed(pose, pose.instances[item.instance]);
        const bool oneSided = item.variant.get(gpu::FEATURE_double_sided) == 0;
        shown_.emplace_back(grid, clipFromWorld * fromEye(placed, view.eye()), item.range.bounds_min,
                            item.range.bounds_max, oneSided, item.mirrored);
        if (item.box >= 0) continue;
        item.chosen = true;
        item.first_run = static_cast<std::uint32_t>(draws_.runs.size());
        for (std::uint32_t first = 0; first < item.range.cluster_count; first += partClusters) {
            const std::uint32_t clusters = std::min(partClusters, item.range.cluster_count - first);
            parts_.push_back({i, item.range.first_cluster + first, clusters,
                              static_cast<std::uint32_t>(draws_.runs.size()), place});
            draws_.runs.push_back({place, 0});
            for (const Cluster& cluster : geometry.clusters(item.range).subspan(first, clusters))
                place += cluster.index_count;
        }
        item.runs = static_cast<std::uint32_t>(draws_.runs.size()) - item.first_run;
    }
    if (!any()) return;
    indices_ = GpuBuffer(device, "chosen indices", std::uint64_t{place} * sizeof(std::uint32_t),
                         VK_BUFFER_USAGE_INDEX_BUFFER_BIT, MemoryUse::upload);
    run();
}

void Culling::choose(const Part& part, std::uint32_t* indices) const {
    const ShownClusters& shown = shown_[part.item];
    const ClusterTriangles& triangles = geometry_.clusterTriangles();
    std::uint32_t* const first = indices + part.place;
    std::uint32_t* next = first;
    for (std::uint32_t k = part.first_cluster; k < part.first_cluster + part.clusters; ++k) {
        const Cluster& cluster = geometry_.cluster(k);
        const TriangleSet set = shown.of(cluster, triangles, triangles[k]);
        const std::span<const std::uint32_t> of = geometry_.indicesOf(cluster);
        if (set == triangles[k].all()) {
            std::memcpy(next, of.data(), of.size_bytes());
            next += of.size();
            continue;
        }
        for (TriangleSet left = set; left != 0; left &= left - 1, next += 3)
            std::memcpy(next, of.data() + 3 * std::countr_zero(left), 3 * sizeof(std::uint32_t));
    }
    draws_.runs[part.run].count = static_cast<std::uint32_t>(next - first);
}

double Culling::run() {
    if (!any()) return 0;
    const auto start = std::chrono::steady_clock::now();
    auto* const indices = static_cast<std::uint32_t*>(indices_.mapped());
    tbb::parallel_for(std::size_t{0}, parts_.size(), [&](std::size_t i) { choose(parts_[i], indices); });
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

DrawnCounts drawnCounts(const DrawList& draws, const Geometry& geometry, const Culling& culling) {
    DrawnCounts counts;
    std::vector<std::uint32_t> used;
    for (const DrawItem& item : draws.items) {
        counts.in_view += item.range.index_count / 3;
        used.clear();
        if (item.chosen)
            for (const IndexRun& run : std::span(draws.runs).subspan(item.first_run, item.runs)) {
                const std::span<const std::uint32_t> of = culling.chosen(run);
                used.insert(used.end(), of.begin(), of.end());
            }
        else
            for (const Cluster& cluster : geometry.clusters(item.range)) {
                const std::span<const std::uint32_t> of = geometry.indicesOf(cluster);
                used.insert(used.end(), of.begin(), of.end());
            }
        counts.drawn += used.size() / 3;
        std::ranges::sort(used);
        counts.vertices += static_cast<std::uint64_t>(std::ranges::unique(used).begin() - used.begin());
    }
    return counts;
}

}  // namespace diptych
