// SPDX-License-Identifier: MIT
// Numbers that rows of experiments can have. A new one is a line here, and code that measures it:
// rows.csv and JSON follow.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

namespace diptych::experiment {

// How the row of several cameras follows from theirs: the mean (none if one is missing), the largest, the
// sum, or not at all (errors are over all cameras' pixels).
enum class OverCameras { mean, largest, sum, separate };

struct NamedMeasure {
    std::string_view group, name;  // keys in JSON
    std::string_view unit;         // "ms", "bytes", "count" (both whole numbers), "texels"; else a ratio
    OverCameras over;
    std::string_view title, means;  // in tables

    constexpr bool isWhole() const { return unit == "bytes" || unit == "count"; }
};

// Errors are of lit over pixels with a surface in the reference: the same pixels for every row.
// Shadow: fractions are of pixels with a surface in the reference. Pixels within the filter radius plus one
// texel of a traced shadow boundary do not count as false: any value is valid there. V: sun visibility in
// the path; R: in the reference, 0 or 1; E: irradiance of the unshadowed sun.
// Samples: fractions are of pixels with a surface. Exact: the same Settings with --msaa-edges exact.
#define DIPTYCH_MEASURES(X)                                                                                  \
    X(magnitude, "variation", "magnitude", "", largest, "magnitude", "value of what is varied in the scene") \
    X(ms, "ms", "median", "ms", mean, "ms", "median time of a whole frame")                                  \
    X(ms_min, "ms", "min", "ms", mean, "min", "least time of a frame")                                       \
    X(ms_max, "ms", "max", "ms", mean, "max", "greatest time of a frame")                                    \
    X(frames, "ms", "runs", "count", sum, "frames", "timed frames")                                          \
    X(record_ms, "host_ms", "record", "ms", mean, "record", "host time to record commands, not in ms")       \
    X(lists_ms, "host_ms", "object_lists", "ms", mean, "object lists",                                       \
      "host time to choose each object's lights, not in ms")                                                 \
    X(memory, "bytes", "total", "bytes", largest, "memory", "images and buffers of a frame")                 \
    X(image_bytes, "bytes", "images", "bytes", largest, "images", "device memory of images")                 \
    X(buffer_bytes, "bytes", "buffers", "bytes", largest, "buffers", "device memory of buffers")             \
    X(gbuffer_bytes, "bytes", "gbuffer_per_pixel", "bytes", largest, "per pixel",                            \
      "attachments and depth, all samples")                                                                  \
    X(full_size_bytes, "bytes", "picture_images", "bytes", largest, "full-size images",                      \
      "part of the images that has the frame's size")                                                        \
    X(lights, "counters", "lights", "count", largest, "lights", "all lights, the sun too")                   \
    X(nonfinite_pixels, "counters", "nonfinite_pixels", "count", sum, "not finite",                          \
      "pixels of lit with NaN or infinity")                                                                  \
    X(overflowed_lists, "counters", "overflowed_lists", "count", sum, "overflowed",                          \
      "light lists in which every light was evaluated")                                                      \
    X(unsorted_fragments, "counters", "unsorted_fragments", "count", sum, "unsorted",                        \
      "blended fragments that overflowed their list")                                                        \
    X(unsorted_pixels, "counters", "unsorted_pixels", "count", sum, "unsorted pixels", "of these fragments") \
    X(material_mismatch_pixels, "counters", "misplaced_pixels", "count", sum, "misplaced",                   \
      "pixels with another material than traced rays, or none")                                              \
    X(registers, "registers", "most", "count", largest, "registers",                                         \
      "vector registers of the largest shading pipeline")                                                    \
    X(flip, "errors", "flip", "", separate, "FLIP", "mean HDR-FLIP, 0 to 1")                                 \
    X(relative_rmse, "errors", "relative_rmse", "", separate, "relative RMSE",                               \
      "root mean square of the relative error")                                                              \
    X(relative_p99, "errors", "relative_p99", "", separate, "relative p99",                                  \
      "99th percentile of the relative error, nearest rank")                                                 \
    X(light_p99, "errors", "light_p99", "", separate, "light",                                               \
      "99th percentile of lit's relative error where a surface shows; of 8-bit images, fraction of white")   \
    X(light_p999, "errors", "light_p999", "", separate, "light p99.9", "the same at 99.9 % of the pixels")   \
    X(depth_p99, "errors", "depth_p99", "", separate, "depth",                                               \
      "99th percentile of the relative error of view depth")                                                 \
    X(reference_moved, "errors", "reference_moved", "", separate, "reference",                               \
      "error of the reference itself against its image of the unvaried scene")                               \
    X(shadow_error, "shadow", "error", "", mean, "error",                                                    \
      "sum of |V - R| E divided by the sum of R E; ranks the paths")                                         \
    X(false_lit, "shadow", "false_lit", "", mean, "false lit",                                               \
      "fraction of pixels away from edges that see too much of the sun")                                     \
    X(false_dark, "shadow", "false_dark", "", mean, "false dark",                                            \
      "fraction of pixels away from edges that see too little of the sun")                                   \
    X(leak, "shadow", "leak", "", mean, "leak",                                                              \
      "sum of max(0, V - R) E divided by the sum of R E: false light relative to correct light")             \
    X(gap, "shadow", "gap", "texels", mean, "gap",                                                           \
      "99th percentile of the distance from the traced edge, across the light, of dark pixels shown more "   \
      "than half lit, in texels: the peter-panning gap between caster and shadow")                           \
    X(shaded, "samples", "shaded", "", mean, "shaded",                                                       \
      "mean number of shaded sample groups per pixel: at most 1 + 3 f with 4 samples")                       \
    X(edges, "samples", "edges", "", mean, "edges", "f: fraction of pixels with more than one shaded group") \
    X(differing, "samples", "differing", "", mean, "differ",                                                 \
      "fraction of pixels whose lit differs from exact's in any bit")                                        \
    X(elsewhere, "samples", "elsewhere", "", mean, "elsewhere",                                              \
      "fraction of pixels that differ although no fewer groups are shaded than with exact: 0 unless "        \
      "something is wrong")                                                                                  \
    X(compared_pixels, "pixels", "compared", "count", sum, "pixels", "compared with the reference")

enum class Measure : std::size_t {
#define DIPTYCH_MEASURE(id, ...) id,
    DIPTYCH_MEASURES(DIPTYCH_MEASURE)
#undef DIPTYCH_MEASURE
};

inline constexpr std::array measures{
#define DIPTYCH_MEASURE(id, group, name, unit, over, ...) \
    NamedMeasure{group, name, unit, OverCameras::over, __VA_ARGS__},
    DIPTYCH_MEASURES(DIPTYCH_MEASURE)
#undef DIPTYCH_MEASURE
};

constexpr const NamedMeasure& named(Measure measure) {
    return measures[static_cast<std::size_t>(measure)];
}
constexpr Measure operator+(Measure first, std::size_t more) {
    return static_cast<Measure>(static_cast<std::size_t>(first) + more);
}
constexpr std::size_t operator-(Measure a, Measure b) {
    return static_cast<std::size_t>(a) - static_cast<std::size_t>(b);
}

// A group's measures, in order, and one value of each.
template <Measure first, Measure last>
constexpr auto groupOf() {
    std::array<NamedMeasure, static_cast<std::size_t>(last) - static_cast<std::size_t>(first) + 1> group{};
    for (std::size_t i = 0; i < group.size(); ++i) group[i] = named(first + i);
    return group;
}
inline constexpr std::array errorMetrics = groupOf<Measure::flip, Measure::relative_p99>();
inline constexpr std::array shadowMetrics = groupOf<Measure::shadow_error, Measure::gap>();
inline constexpr std::array sampleMetrics = groupOf<Measure::shaded, Measure::elsewhere>();
using Errors = std::array<double, errorMetrics.size()>;
using ShadowErrors = std::array<double, shadowMetrics.size()>;
using SampleFractions = std::array<double, sampleMetrics.size()>;

}  // namespace diptych::experiment
