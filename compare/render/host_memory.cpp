// SPDX-License-Identifier: MIT
#include "compare/render/host_memory.h"

#include "compare/frames/frame_properties.h"
#include "shared/scene/lights/shadow_casters.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

namespace diptych {
namespace {

// Bytes per sample of a frame's images: depth, lit and the G-buffer.
double sampleBytes(const Settings& settings) {
    const double depth = settings.depth_format == DepthFormat::d16 ? 2 : 4;
    const double lit = settings.lit_format == LitFormat::fp32   ? 16
                       : settings.lit_format == LitFormat::fp16 ? 8
                                                                : 4;
    const double surface = !hasGBuffer(settings.path)                      ? 0
                           : settings.gbuffer == GBufferEncoding::compact  ? 12
                           : settings.gbuffer == GBufferEncoding::standard ? 20
                                                                           : 48;
    return depth + lit + surface;
}

double pixelsOf(const Settings& settings) {
    return double(settings.size.width) * double(settings.size.height);
}

double imageBytes(const Settings& settings, bool sun) {
    return pixelsOf(settings) * settings.msaa * sampleBytes(settings) + (sun ? shadowBytes(settings) : 0);
}

// Bytes per pixel beyond the frame's images: images read back and kept until they are in a file; a
// capture's images, multisampled like the frame's; pages of files.
double captureBytes(const Settings& settings, const RenderOptions& options, bool software) {
    constexpr double one_image = 60, channel = 4, once_more = 20, channel_once_more = 2, target = 16;
    const auto channels = static_cast<double>(options.channels.size());
    const double others = std::max(channels - 2, 0.0);
    double bytes = one_image + channel * others;
    const bool again = options.twice == Twice::all || options.through_gbuffer;
    if (again || options.twice == Twice::lit) bytes += once_more;
    if (again) bytes += channel_once_more * others;
    if (software && settings.msaa > 1) bytes += target * settings.msaa * std::clamp(channels / 2, 1.0, 3.0);
    return bytes;
}

// Bytes per pixel of the reference's double-precision sums and other outputs; `retainedReference` of them
// stay in memory.
constexpr double retainedReference = 60;
double referenceBytes(const Settings& settings, const RenderOptions& options) {
    constexpr double lit = 190, surfaces = 110, evaluated = 190;
    return lit + (settings.reference_mode == ReferenceMode::surface ? surfaces : 0) +
           (options.environment_errors ? evaluated : 0);
}

// Code of one path on a CPU device: a constant, and more for each channel and for materials, which share
// pipelines.
double pipelineBytes(const RenderOptions& options, std::size_t materials) {
    return 40e6 + 0.8e6 * static_cast<double>(options.channels.size()) +
           2e6 * static_cast<double>(std::min(materials, std::size_t{64}));
}

}  // namespace

// 32-bit texels; moment maps take four times that.
double shadowBytes(const Settings& settings) {
    constexpr double texel = 4;
    const auto squared = [](double side) { return side * side; };
    switch (settings.shadows) {
        case Shadows::off:
            return 0;
        case Shadows::clipmap:
            return texel * settings.clipmap_pages * squared(settings.clipmap_page_size);
        case Shadows::pcf:
        case Shadows::pcss:
            return texel * settings.shadow_cascades * squared(settings.shadow_size);
        default:
            return 4 * texel * settings.shadow_cascades * squared(settings.shadow_size);
    }
}

std::uint64_t hostMemory(std::span<const Settings> settings, const RenderOptions& options, bool software,
                         bool sun, std::size_t materials) {
    double timed = 0, largest = 0, held = 0;
    std::set<Path> paths;
    for (const Settings& of : settings) {
        paths.insert(of.path);
        if (isReference(of.path)) {
            largest = std::max(largest, pixelsOf(of) * referenceBytes(of, options));
            held += pixelsOf(of) * retainedReference;
            continue;
        }
        const double images = software ? imageBytes(of, sun) : 0;
        if (options.runs > 0) timed += images;  // of all frames at once
        if (options.channels.empty()) continue;
        largest = std::max(largest, images + pixelsOf(of) * captureBytes(of, options, software));
    }
    const double code = software ? static_cast<double>(paths.size()) * pipelineBytes(options, materials) : 0;
    return static_cast<std::uint64_t>(code + held + std::max(timed, largest));
}

std::uint64_t checkHostMemory(SceneViews& views, std::span<const Settings> settings,
                              const RenderOptions& options, bool software, std::uint64_t approved,
                              const std::function<FreeMemory()>& free) {
    bool sun = false, samples = false, several = false;
    gpu::uint layers = 0;
    for (const Settings& of : settings) {
        samples = samples || of.msaa > 1;
        layers |= views.at(viewRequest(of)).needs.layers;
        several = several || of.camera != settings.front().camera || of.time != settings.front().time;
        sun = sun || (of.shadows != Shadows::off && brightestSun(views.at(viewRequest(of)).lights));
    }
    const std::uint64_t needed = hostMemory(settings, withoutAbsentLayers(options, layers), software, sun,
                                            views.scene().materials.size());
    if (needed <= approved) return needed;
    std::vector<std::string> remedies{"a smaller --size"};
    if (options.channels.size() > 8) remedies.emplace_back("fewer --channels");
    if (samples) remedies.emplace_back("--msaa 1");
    if (several) remedies.emplace_back("fewer cameras and times");
    const Size& size = settings.front().size;
    checkMemory(fmt::format("{} at {}x{}", views.scene().name, size.width, size.height), needed,
                fmt::format("{} needs less", fmt::join(remedies, " or ")), free());
    return needed;
}

}  // namespace diptych
