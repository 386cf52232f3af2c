// SPDX-License-Identifier: MIT
#include "shared/draw/culling.h"

#include "shared/contract/features.h"

#include <tbb/parallel_for.h>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>
#include <cstring>

namespace diptych {

namespace {

// Meshlets that one thread processes at a time.
constexpr std::uint32_t maxPartMeshlets = 64;

SampleGrid gridOf(const Device& device, const View& view, int samples) {
    // One step of the subpixel grid: Vulkan does not say that vertices are snapped to the nearest point.
    return {view.width, view.height, samples,
            std::ldexp(1.0, -static_cast<int>(device.limits().subPixelPrecisionBits))};
}

gpu::CulledItem culledItem(const DrawItem& item, const gpu::Draw& draw, const VisibleMeshlets& shown,
                           bool oneSided) {
    // Sum of two shaders' errors, rounded up.
    const glm::dvec4 error = shown.error() * (2 * (1 + 1e-3));
    return {draw.clip_from_object, glm::vec4(error), static_cast<gpu::uint>(item.range.vertex_offset),
            item.draw, (oneSided ? 0 : gpu::CULLED_BOTH_SIDES) | (item.mirrored ? gpu::CULLED_MIRRORED : 0)};
}

// Number of items from index i on that can be drawn as instances of one mesh with a single meshlet. A
// saved draw outweighs the meshlet's back-facing triangles.
std::uint32_t togetherFrom(const DrawList& draws, std::size_t i) {
    std::size_t end = i + 1;
    if (draws.items[i].range.meshlet_count != 1) return 1;
    while (end < draws.solid_count && isNextInstance(draws.items[end - 1], draws.items[end]) &&
           draws.items[end].variant == draws.items[i].variant)
        ++end;
    return static_cast<std::uint32_t>(end - i);
}

}  // namespace

Culling::Culling(Device& device, Pipelines& pipelines, const Layouts& layouts, const Geometry& geometry,
                 const Image& image, DrawList& draws)
    : geometry_(geometry), draws_(draws), on_(image.culls) {
    const auto& [pose, view, samples, culls] = image;
    const bool computes = culls && device.profile().culls_by_compute;
    const SampleGrid grid = gridOf(device, view, samples);
    const glm::dmat4 clipFromWorld = view.clipFromWorld();
    std::uint32_t slot = 0;
    draws_.runs.clear();
    const DeviceCosts& costs = device.profile().costs;
    std::uint32_t to_come = 0;  // remaining instances of the current draw
    bool whole = false;         // the item is one of them
    for (std::uint32_t i = 0; i < draws_.solid_count; ++i) {
        DrawItem& item = draws_.items[i];
        if (item.box >= 0) continue;
        const PrimitiveRange& range = item.range;
        if (to_come == 0) {
            to_come = togetherFrom(draws_, i);
            whole = to_come > 1;
            if (whole)
                instances_.push_back({static_cast<std::uint32_t>(parts_.size()), to_come,
                                      costs.draw / (costs.triangle * range.index_count / 3)});
        }
        const PlacedPrimitive placed = geometry.placed(pose, pose.instances[item.instance]);
        const glm::dmat4 fromCamera = fromEye(placed, view.eye());
        const bool oneSided = item.variant.get(gpu::FEATURE_double_sided) == 0;
        Item made{VisibleMeshlets(grid, clipFromWorld * fromCamera, range.bounds_min, range.bounds_max,
                                  oneSided, item.mirrored),
                  glm::transpose(fromCamera) * glm::dvec4(-view.backward(), 0),
                  range.first_meshlet,
                  range.meshlet_count,
                  static_cast<std::uint32_t>(order_.size()),
                  static_cast<std::uint32_t>(parts_.size()),
                  (range.meshlet_count + maxPartMeshlets - 1) / maxPartMeshlets,
                  slot,
                  whole};
        addParts(made);
        if (computes && !whole)
            addCulled(made, culledItem(item, draws_.draws[item.draw], made.shown, oneSided));
        if (!whole) slot += range.index_count;
        item.uses_visible_indices = !whole;
        item.first_run = made.first_part;
        item.runs = made.parts;
        items_.push_back(made);
        --to_come;
    }
    if (!any()) return;
    draws_.runs.resize(parts_.size());
    if (culled_parts_.empty()) {
        runOnHost(device, slot);
        return;
    }
    const ComputeCulling::Sizes sizes{
        static_cast<std::uint32_t>(culled_items_.size()), static_cast<std::uint32_t>(culled_parts_.size()),
        static_cast<std::uint32_t>(order_.size()), slot, static_cast<std::uint32_t>(parts_.size())};
    compute_.emplace(device, pipelines, layouts.culling, geometry, grid, sizes);
    std::ranges::copy(culled_items_, compute_->items().begin());
    runOnGpu();
}

void Culling::addParts(const Item& item) {
    for (std::uint32_t first = 0; first < item.meshlets; first += maxPartMeshlets)
        parts_.push_back({static_cast<std::uint32_t>(items_.size()), item.first + first,
                          std::min(maxPartMeshlets, item.meshlets - first)});
    order_.resize(order_.size() + item.meshlets);
}

void Culling::addCulled(const Item& item, const gpu::CulledItem& culled) {
    const auto index = static_cast<gpu::uint>(culled_items_.size());
    culled_items_.push_back(culled);
    for (std::uint32_t p = item.first_part; p < item.first_part + item.parts; ++p)
        culled_parts_.push_back({index, parts_[p].first, parts_[p].meshlets, 0, p});
}

void Culling::runOnHost(Device& device, std::uint32_t indices) {
    indices_ =
        GpuBuffer(device, "chosen indices", std::uint64_t{std::max(indices, 1u)} * sizeof(std::uint32_t),
                  VK_BUFFER_USAGE_INDEX_BUFFER_BIT, MemoryUse::upload);
    run();
}

void Culling::runOnGpu() {
    run();
    compute_->runOnce(name);
    // Culling of a view is deterministic, so these counts stay valid.
    const std::vector<gpu::IndirectDraw> commands = compute_->readDraws();
    for (const gpu::CulledPart& part : culled_parts_)
        draws_.runs[part.command] = {commands[part.command].first_index, commands[part.command].index_count};
}

// Sorts near to far by the centres of the meshlets' boxes, so that hidden fragments fail the depth test
// before shading.
void Culling::order(const Item& item) {
    struct Deep {
        double depth;
        std::uint32_t meshlet;
        bool operator<(const Deep& other) const {
            return depth < other.depth || (depth == other.depth && meshlet < other.meshlet);
        }
    };
    std::vector<Deep> sorted(item.meshlets);
    for (std::uint32_t k = 0; k < item.meshlets; ++k) {
        const std::uint32_t meshlet = item.first_meshlet + k;
        sorted[k] = {glm::dot(item.depth, glm::dvec4(middleOf(geometry_.meshlet(meshlet)), 1)), meshlet};
    }
    std::sort(sorted.begin(), sorted.end());
    std::uint32_t slot = item.first_index;
    for (std::uint32_t p = item.first_part; p < item.first_part + item.parts; ++p) {
        Part& part = parts_[p];
        part.first_index = slot;
        for (std::uint32_t k = part.first; k < part.first + part.meshlets; ++k) {
            order_[k] = sorted[k - item.first].meshlet;
            slot += geometry_.meshlet(order_[k]).index_count;
        }
    }
}

void Culling::selectVisible(std::size_t part, std::uint32_t* indices) {
    const Part& of = parts_[part];
    const VisibleMeshlets& shown = items_[of.item].shown;
    const MeshletTriangles& triangles = geometry_.meshletTriangles();
    std::uint32_t* next = indices + of.first_index;
    for (std::uint32_t k = of.first; k < of.first + of.meshlets; ++k) {
        const Meshlet& meshlet = geometry_.meshlet(order_[k]);
        const MeshletTriangles::Entry& entry = triangles[order_[k]];
        const TriangleSet set = on_ ? shown.of(meshlet, triangles, entry) : entry.all();
        if (items_[of.item].whole) {
            draws_.runs[part] = {meshlet.first_index, set != 0 ? meshlet.index_count : 0};
            return;
        }
        const std::span<const std::uint32_t> all = geometry_.indicesOf(meshlet);
        if (set == entry.all()) {
            std::memcpy(next, all.data(), all.size_bytes());
            next += all.size();
            continue;
        }
        for (TriangleSet left = set; left != 0; left &= left - 1, next += 3)
            std::memcpy(next, all.data() + 3 * std::countr_zero(left), 3 * sizeof(std::uint32_t));
    }
    draws_.runs[part] = {of.first_index, static_cast<std::uint32_t>(next - (indices + of.first_index))};
}

void Culling::fillGaps(const Instances& instances) {
    const std::span<IndexRange> runs = std::span(draws_.runs).subspan(instances.first_part, instances.count);
    std::size_t after = runs.size();  // end of the last visible range; initially none
    for (std::size_t i = 0; i < runs.size(); ++i) {
        if (runs[i].count == 0) continue;
        if (after < i && static_cast<double>(i - after) <= instances.gap)
            for (std::size_t k = after; k < i; ++k) runs[k] = runs[i];
        after = i + 1;
    }
}

double Culling::run() {
    if (!any()) return 0;
    const auto start = std::chrono::steady_clock::now();
    auto* const indices = static_cast<std::uint32_t*>(indices_.mapped());
    tbb::parallel_for(std::size_t{0}, items_.size(), [&](std::size_t i) { order(items_[i]); });
    tbb::parallel_for(std::size_t{0}, parts_.size(), [&](std::size_t i) {
        if (!compute_ || items_[parts_[i].item].whole) selectVisible(i, indices);
    });
    if (compute_) {
        for (gpu::CulledPart& part : culled_parts_) part.first_index = parts_[part.command].first_index;
        std::ranges::copy(culled_parts_, compute_->parts().begin());
        std::ranges::copy(order_, compute_->order().begin());
    }
    if (on_)
        tbb::parallel_for(std::size_t{0}, instances_.size(), [&](std::size_t i) { fillGaps(instances_[i]); });
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

void Culling::addPasses(PassList& passes) const {
    if (compute_) compute_->addPass(passes, name);
}

void Culling::read(PassList& passes, Pass& pass) const {
    if (compute_) compute_->read(passes, pass);
}

std::vector<std::uint32_t> Culling::visibleIndices() const {
    if (compute_) return compute_->readIndices();
    const auto* const first = static_cast<const std::uint32_t*>(indices_.mapped());
    return {first, first + indices_.size() / sizeof(std::uint32_t)};
}

DrawnCounts drawnCounts(const DrawList& draws, const Geometry& geometry, const Culling& culling) {
    DrawnCounts counts;
    const std::vector<std::uint32_t> visible = culling.visibleIndices();
    std::vector<std::uint32_t> used;
    const DrawItem* last = nullptr;
    for (const DrawItem& item : draws.items) {
        counts.in_view += item.range.index_count / 3;
        const auto runs = std::span(draws.runs).subspan(item.first_run, item.runs);
        const auto drawn = static_cast<std::uint64_t>(
            std::ranges::count_if(runs, [](const IndexRange& run) { return run.count > 0; }));
        if (item.runs > 0 && drawn == 0) {
            last = nullptr;
            continue;
        }
        ++counts.instances;
        const bool together = last != nullptr && !item.uses_visible_indices && !item.blended &&
                              isNextInstance(*last, item) && last->variant == item.variant;
        if (!together) counts.draws += std::max<std::uint64_t>(drawn, 1);
        last = &item;
        used.clear();
        if (item.uses_visible_indices)
            for (const IndexRange& run : runs) {
                const auto of = std::span(visible).subspan(run.first, run.count);
                used.insert(used.end(), of.begin(), of.end());
            }
        else
            for (const Meshlet& meshlet : geometry.meshlets(item.range)) {
                const std::span<const std::uint32_t> of = geometry.indicesOf(meshlet);
                used.insert(used.end(), of.begin(), of.end());
            }
        counts.drawn += used.size() / 3;
        std::ranges::sort(used);
        counts.vertices += static_cast<std::uint64_t>(std::ranges::unique(used).begin() - used.begin());
    }
    return counts;
}

}  // namespace diptych
