// SPDX-License-Identifier: MIT
#include "compare/verdict/selection.h"

#include "shared/image/image_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <stdexcept>

namespace diptych {
namespace {

// Neighbours whose depths differ by more than this fraction of the nearer one belong to two objects. A
// floor seen at 5 degrees changes less between pixels at any usual size.
constexpr float depthStep = 0.05f;

std::size_t countOf(const std::vector<std::uint8_t>& covered) {
    return static_cast<std::size_t>(std::ranges::count_if(covered, [](std::uint8_t c) { return c != 0; }));
}

void applyMask(Coverage& coverage, int width, int height, const std::string& file) {
    const ImageFile mask = readImage(file);
    if (mask.width != width || mask.height != height)
        throw std::runtime_error(fmt::format("--mask {}: is {}x{}, but the images are {}x{}", file,
                                             mask.width, mask.height, width, height));
    const Image& image = mask.layers.front().image;
    // Alpha does not count as brightness.
    const int components = image.components == 4 ? 3 : image.components == 2 ? 1 : image.components;
    for (std::size_t i = 0; i < image.pixels(); ++i) {
        const float* p = image.pixel(i);
        if (!(*std::max_element(p, p + components) >= 0.5f)) coverage.covered[i] = 0;
    }
}

void applyIds(Coverage& coverage, const std::vector<int>& ids, const Image* plane) {
    if (!plane)
        throw std::runtime_error("--ids: the reference has no material_id; render one with --channels");
    for (std::size_t i = 0; i < plane->pixels(); ++i)
        if (std::ranges::none_of(ids, [&](int id) { return plane->data[i] == static_cast<float>(id); }))
            coverage.covered[i] = 0;
}

void applyCrop(Coverage& coverage, int width, int height, const Crop& crop) {
    if (crop.x + crop.width > width || crop.y + crop.height > height)
        throw std::runtime_error(fmt::format("--crop {},{},{}x{}: is not inside the image of {}x{}", crop.x,
                                             crop.y, crop.width, crop.height, width, height));
    std::size_t i = 0;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x, ++i)
            if (x < crop.x || x >= crop.x + crop.width || y < crop.y || y >= crop.y + crop.height)
                coverage.covered[i] = 0;
}

// Sets 1 at both pixels of every horizontal or vertical neighbour pair that belongs to two objects. `ids`:
// whether the plane has ids, else depths.
void markEdges(const Image& plane, bool ids, std::vector<std::uint8_t>& edges) {
    const auto mark = [&](int x, int y, int nx, int ny) {
        const float a = plane.at(x, y), b = plane.at(nx, ny);
        if (ids ? a == b : !(std::abs(a - b) > depthStep * std::min(std::abs(a), std::abs(b)))) return;
        edges[plane.offset(x, y)] = 1;
        edges[plane.offset(nx, ny)] = 1;
    };
    for (int y = 0; y < plane.height; ++y)
        for (int x = 0; x < plane.width; ++x) {
            if (x + 1 < plane.width) mark(x, y, x + 1, y);
            if (y + 1 < plane.height) mark(x, y, x, y + 1);
        }
}

// Dilates the marked pixels by `radius` rows and columns: two passes of running counts.
std::vector<std::uint8_t> grown(const std::vector<std::uint8_t>& marked, int width, int height, int radius) {
    const auto pass = [radius](const std::vector<std::uint8_t>& in, std::size_t lines, std::size_t count,
                               std::size_t line, std::size_t step) {
        std::vector<std::uint8_t> out(in.size(), 0);
        const auto reach = static_cast<std::size_t>(radius);
        for (std::size_t l = 0; l < lines; ++l) {
            const auto at = [&](std::size_t i) { return l * line + i * step; };
            std::size_t inside = 0;
            for (std::size_t i = 0; i < std::min(reach, count); ++i) inside += in[at(i)];
            for (std::size_t i = 0; i < count; ++i) {
                if (i + reach < count) inside += in[at(i + reach)];
                if (i > reach) inside -= in[at(i - reach - 1)];
                out[at(i)] = inside > 0;
            }
        }
        return out;
    };
    const auto w = static_cast<std::size_t>(width), h = static_cast<std::size_t>(height);
    return pass(pass(marked, h, w, w, 1), w, h, 1, w);
}

void applyEdges(Coverage& coverage, int width, int height, int radius, const ObjectPlanes& objects,
                std::vector<std::string>& notes) {
    // Prefers planes of both images, because an object may move between them; else uses the one that
    // exists.
    const bool both_ids = objects.ids[0] && objects.ids[1];
    const bool both_depths = objects.depth[0] && objects.depth[1];
    const bool ids = both_ids || (!both_depths && (objects.ids[0] || objects.ids[1]));
    const Image* const* const planes = ids ? objects.ids : objects.depth;
    if (!planes[0] && !planes[1])
        throw std::runtime_error(
            "--ignore-edges: needs material_id or Z to find edges, and neither image has one");
    std::vector<std::uint8_t> edges(coverage.covered.size(), 0);
    for (const int side : {0, 1})
        if (planes[side]) markEdges(*planes[side], ids, edges);
    edges = grown(edges, width, height, radius - 1);
    for (std::size_t i = 0; i < edges.size(); ++i)
        if (edges[i]) coverage.covered[i] = 0;
    const char* const whose = planes[0] && planes[1] ? "" : planes[0] ? " in the reference" : " in the test";
    notes.push_back(fmt::format("edges are where {}{}",
                                ids ? "material_id changes" : "depth changes by over 5 % between neighbours",
                                whose));
}

}  // namespace

Crop cropOf(const std::string& text) {
    Crop crop;
    int* const parts[] = {&crop.x, &crop.y, &crop.width, &crop.height};
    const char* const separators = ",,x";
    const char *at = text.data(), *end = at + text.size();
    bool sound = true;
    for (int i = 0; i < 4 && sound; ++i) {
        const auto [next, error] = std::from_chars(at, end, *parts[i]);
        sound = error == std::errc() && *parts[i] >= (i < 2 ? 0 : 1) && *parts[i] <= 1 << 24;
        sound = sound && (i == 3 ? next == end : next != end && *next == separators[i]);
        at = next + 1;
    }
    if (!sound) throw std::runtime_error(fmt::format("--crop {}: give X,Y,WxH in pixels", text));
    return crop;
}

void applySelection(Coverage& coverage, int width, int height, const SelectionOptions& options,
                    const ObjectPlanes& objects, std::vector<std::string>& notes) {
    if (!options.any()) return;
    const std::size_t before = countOf(coverage.covered);
    if (!options.mask.empty()) applyMask(coverage, width, height, options.mask);
    if (!options.ids.empty()) applyIds(coverage, options.ids, objects.ids[0]);
    if (options.crop) applyCrop(coverage, width, height, *options.crop);
    if (options.ignore_edges > 0) applyEdges(coverage, width, height, options.ignore_edges, objects, notes);
    coverage.count = countOf(coverage.covered);
    notes.push_back(
        fmt::format("{} of {} pixels are compared; options exclude the others", coverage.count, before));
    if (coverage.count == 0)
        throw std::runtime_error("--mask, --ids, --crop and --ignore-edges leave no pixel to compare");
}

}  // namespace diptych
