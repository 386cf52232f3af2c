// SPDX-License-Identifier: MIT
// What may be wrong in both paths alike, and what is seen where it is right.
#pragma once

#include "shared/scene/model/scene.h"
#include "shared/scene/motion/pose.h"

#include <cstddef>
#include <cstdint>
#include <iterator>
#include <map>
#include <string>

namespace diptych {

//  name              heading of the report
#define CHECK_FEATURES(X)                      \
    X(texture_transform, "texture transforms") \
    X(second_texcoord, "second UV set")        \
    X(sampler, "samplers")                     \
    X(normal_map, "normal maps")               \
    X(vertex_colors, "vertex colours")         \
    X(alpha_mask, "alpha masks")               \
    X(blend, "blending")                       \
    X(double_sided, "double-sided surfaces")   \
    X(mirrored, "mirrored instances")          \
    X(unlit, "unlit materials")                \
    X(deep_image, "images of over 8 bits")     \
    X(skin, "skins")                           \
    X(morph, "morph targets")                  \
    X(flat, "flat normals")                    \
    X(orientation, "orientation")

enum class CheckFeature {
#define DIPTYCH_CHECK_FEATURE(name, heading) name,
    CHECK_FEATURES(DIPTYCH_CHECK_FEATURE)
#undef DIPTYCH_CHECK_FEATURE
};
inline constexpr const char* checkHeadings[] = {
#define DIPTYCH_CHECK_FEATURE(name, heading) heading,
    CHECK_FEATURES(DIPTYCH_CHECK_FEATURE)
#undef DIPTYCH_CHECK_FEATURE
};
inline constexpr std::size_t checkFeatureCount = std::size(checkHeadings);

// Bit f: CheckFeature f.
using CheckFeatures = std::uint32_t;
constexpr CheckFeatures bitOf(CheckFeature feature) {
    return CheckFeatures{1} << static_cast<unsigned>(feature);
}

// What a primitive shows wherever it stands; reads each of its vertices once. A feature that cannot change a
// pixel (white vertex colours, an edge mode where no coordinate passes the edge) is none.
CheckFeatures featuresOf(const Scene& scene, const Primitive& primitive);

// With what depends on the place.
CheckFeatures featuresOf(const Scene& scene, const Instance& instance, CheckFeatures ofPrimitive);

// What is seen where it is right, for people.
class CheckSentences {
public:
    explicit CheckSentences(const Scene& scene) : scene_(scene) {}

    // "Base colour: offset 0.5 0. What is pictured there (arrows, frames, seams) falls into place."
    std::string of(const Instance& instance, CheckFeature feature);

private:
    float leastAlpha(const Primitive& primitive);
    std::string ofMask(const Primitive& primitive);

    const Scene& scene_;
    std::map<int, float> least_alpha_;  // of the texels of an image; looked up once
};

}  // namespace diptych
