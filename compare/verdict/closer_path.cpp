// SPDX-License-Identifier: MIT
#include "compare/verdict/closer_path.h"

#include "compare/verdict/measurement.h"
#include "shared/contract/debug_mode.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace diptych {
namespace {

PathError pathErrorOf(const DebugMode& mode, const Image& reference, const Image& test,
                      const Coverage& covered) {
    PathError error;
    error.stats = channelStats(mode.error_kind, mode.kind, reference, test, covered);
    error.relative_rmse = mode.error_kind == ErrorKind::relative
                              ? error.stats.rmse
                              : channelStats(ErrorKind::relative, mode.kind, reference, test, covered).rmse;
    const Measurement measurement(
        {mode.error_kind, mode.kind, false, reference, test, &covered, &error.stats});
    error.flip = measurement({"flip", 0});
    return error;
}

std::vector<MaterialError> materialsOf(const Image& ids, const std::array<Image, 2>& errors,
                                       const Coverage& covered, const std::vector<std::string>& names) {
    constexpr std::size_t max = 8;
    std::map<int, MaterialError> found;
    for (std::size_t i = 0; i < ids.pixels(); ++i) {
        if (!covered.covered[i]) continue;
        const int id = static_cast<int>(ids.pixel(i)[0]);
        MaterialError& material = found[id];
        ++material.pixels;
        for (std::size_t k = 0; k < 2; ++k) material.mean[k] += double{errors[k].data[i]};
    }
    std::vector<MaterialError> materials;
    for (auto& [id, material] : found) {
        material.id = id;
        if (id >= 0 && static_cast<std::size_t>(id) < names.size())
            material.name = names[static_cast<std::size_t>(id)];
        for (double& mean : material.mean) mean /= static_cast<double>(material.pixels);
        materials.push_back(material);
    }
    // Sorted by contribution to the difference of the two means.
    std::ranges::stable_sort(materials, std::greater{}, [](const MaterialError& m) {
        const double weight = std::abs(m.mean[0] - m.mean[1]) * static_cast<double>(m.pixels);
        return std::isnan(weight) ? std::numeric_limits<double>::infinity() : weight;
    });
    if (materials.size() > max) materials.resize(max);
    return materials;
}

// The uncertainty of the reference's mean over the covered pixels, relative to its values.
double meanUncertainty(const Frame& referenceFrame, const Image& reference, const Coverage& covered) {
    if (referenceFrame.uncertainty.empty() || covered.count == 0) return 0;
    const PixelError error(ErrorKind::relative, ChannelKind::color, reference, covered);
    double sum = 0;
    for (std::size_t i = 0; i < reference.pixels(); ++i) {
        if (!covered.covered[i]) continue;
        const float* p = reference.pixel(i);
        const double largest = std::max({std::abs(p[0]), std::abs(p[1]), std::abs(p[2])});
        sum += double{referenceFrame.uncertainty.pixel(i)[0]} / std::max(largest, error.floor());
    }
    // Errors of pixels are independent, so the mean of N pixels is sqrt(N) times as accurate as one pixel.
    return sum / static_cast<double>(covered.count) / std::sqrt(static_cast<double>(covered.count));
}

CloserPathChannel channelOf(const DebugMode& mode, const Frame& referenceFrame,
                            const std::array<const Frame*, 2>& paths, const Coverage& covered,
                            const std::vector<std::string>& names) {
    const Image& reference = referenceFrame.channels.at(mode.channel);
    CloserPathChannel channel;
    channel.mode = &mode;
    std::array<Image, 2> errors;
    for (std::size_t k = 0; k < 2; ++k) {
        const Image& image = paths[k]->channels.at(mode.channel);
        channel.paths[k] = pathErrorOf(mode, reference, image, covered);
        errors[k] = errorImage(mode.error_kind, mode.kind, reference, image, covered);
    }
    channel.between =
        pathErrorOf(mode, paths[0]->channels.at(mode.channel), paths[1]->channels.at(mode.channel), covered);
    channel.error_difference = Image(reference.width, reference.height, 1);
    for (std::size_t i = 0; i < reference.pixels(); ++i) {
        if (!covered.covered[i]) continue;
        const float first = errors[0].data[i], second = errors[1].data[i];
        channel.closer_pixels[0] += first < second;
        channel.closer_pixels[1] += second < first;
        channel.even_pixels += first == second;
        if (first != second) channel.error_difference.data[i] = first - second;
    }
    const double first = channel.paths[0].stats.mean, second = channel.paths[1].stats.mean;
    // Two means are distinguished only if they differ by more than the reference's own uncertainty.
    const double known =
        std::max(1e-3 * std::min(first, second), meanUncertainty(referenceFrame, reference, covered));
    if (std::abs(first - second) > known || std::isinf(first) != std::isinf(second)) {
        channel.closer = first < second ? 0 : 1;
        const double min = std::min(first, second);
        channel.by = min > 0 ? std::max(first, second) / min : std::numeric_limits<double>::infinity();
    }
    if (const Image* const ids = findChannel(referenceFrame, Channel::material_id))
        channel.materials = materialsOf(*ids, errors, covered, names);
    return channel;
}

// Three digits, but never as a power of ten: "2.15", "21500".
std::string timesText(double times) {
    const double unit = times < 1000 ? 0 : std::pow(10.0, std::floor(std::log10(times)) - 2);
    return unit > 0 ? fmt::format("{:.0f}", std::round(times / unit) * unit) : fmt::format("{:.3g}", times);
}

}  // namespace

CloserPath closerPathOf(const std::vector<Frame>& frames, std::size_t reference,
                        std::array<std::size_t, 2> paths, const Coverage& coverage,
                        const std::vector<std::string>& names) {
    CloserPath closer{reference, paths, {}};
    const std::array<const Frame*, 3> all{&frames[reference], &frames[paths[0]], &frames[paths[1]]};
    const bool sampled = all[1]->settings.msaa > 1;  // other channels are of one sample, not of the pixel
    for (const Channel mode : litModes) {
        if (sampled && mode != Channel::lit) continue;
        if (std::ranges::all_of(
                all, [&](const Frame* f) { return f->channels.contains(mode) && f->isRequested(mode); }))
            closer.channels.push_back(channelOf(debugMode(mode), *all[0], {all[1], all[2]}, coverage, names));
    }
    return closer;
}

std::string closerPathLine(const CloserPath& closer, const CloserPathChannel& channel,
                           const std::vector<Frame>& frames) {
    const std::string& reference = frames[closer.reference].name;
    if (channel.closer < 0)
        return fmt::format("{}: both paths are equally close to the {}, mean errors {:.4g} and {:.4g}",
                           channel.mode->name, reference, channel.paths[0].stats.mean,
                           channel.paths[1].stats.mean);
    const auto near = static_cast<std::size_t>(channel.closer), far = 1 - near;
    const auto pixels =
        static_cast<double>(channel.closer_pixels[0] + channel.closer_pixels[1] + channel.even_pixels);
    const auto percent = [&](std::uint64_t count) {
        return pixels > 0 ? 100 * static_cast<double>(count) / pixels : 0;
    };
    const std::string times = std::isfinite(channel.by)             ? timesText(channel.by) + " times less"
                              : channel.paths[near].stats.mean == 0 ? "no error"
                                                                    : "infinite";
    return fmt::format(
        "{}: {} is closer to the {}: mean error {:.4g} against {:.4g} for {} ({}); it is closer at {:.1f} % "
        "of the pixels ({} at {:.1f} %, equal at {:.1f} %)",
        channel.mode->name, frames[closer.paths[near]].name, reference, channel.paths[near].stats.mean,
        channel.paths[far].stats.mean, frames[closer.paths[far]].name, times,
        percent(channel.closer_pixels[near]), frames[closer.paths[far]].name,
        percent(channel.closer_pixels[far]), percent(channel.even_pixels));
}

double closerPathTop(const Image& error_difference) {
    std::vector<float> sizes;
    for (const float v : error_difference.data)
        if (v != 0 && std::isfinite(v)) sizes.push_back(std::abs(v));
    if (sizes.empty()) return 1;
    const auto at = static_cast<std::ptrdiff_t>(0.99 * static_cast<double>(sizes.size() - 1));
    std::ranges::nth_element(sizes, sizes.begin() + at);
    return double{sizes[static_cast<std::size_t>(at)]};
}

// The report's two path colours (page.css, --first and --second) over black, by the square root of the
// difference.
Image8 closerPathImage(const Image& error_difference, double top) {
    constexpr std::array<std::array<double, 3>, 2> color{{{111, 155, 232}, {224, 165, 82}}};
    Image8 image{error_difference.width, error_difference.height, 3, {}};
    image.data.reserve(3 * error_difference.pixels());
    for (const float v : error_difference.data) {
        const double fraction = std::isnan(v) ? 0 : std::sqrt(std::min(std::abs(double{v}) / top, 1.0));
        for (const double c : color[v < 0 ? 0 : 1])
            image.data.push_back(static_cast<std::uint8_t>(std::lround(c * fraction)));
    }
    return image;
}

}  // namespace diptych
