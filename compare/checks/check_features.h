// SPDX-License-Identifier: MIT
// Features of a scene that both paths may draw wrongly in the same way, and what is seen where they are
// right.
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
#define CHECK_FEATURES(X)                         \
    X(texture_transform, "texture transforms")    \
    X(second_texcoord, "second UV set")           \
    X(sampler, "samplers")                        \
    X(normal_map, "normal maps")                  \
    X(vertex_colors, "vertex colours")            \
    X(alpha_mask, "alpha masks")                  \
    X(blend, "blending")                          \
    X(double_sided, "double-sided surfaces")      \
    X(mirrored, "mirrored instances")             \
    X(unlit, "unlit materials")                   \
    X(deep_image, "images with more than 8 bits") \
    X(skin, "skins")                              \
    X(morph, "morph targets")                     \
    X(flat, "flat normals")                       \
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

// The features of a primitive that do not depend on its instance. Reads each of its vertices once. A feature
// that cannot change a pixel (white vertex colours, a wrap mode where no coordinate passes the edge) is left
// out.
// `materials`: the scene's at the pose's time (materialsOf()).
CheckFeatures featuresOf(const Scene& scene, const std::vector<Material>& materials,
                         const Primitive& primitive);

// Adds the features that depend on the instance.
CheckFeatures featuresOf(const Scene& scene, const Instance& instance, CheckFeatures ofPrimitive);

// Sentences for people: what is seen where a feature is drawn correctly.
class CheckSentences {
public:
    CheckSentences(const Scene& scene, const std::vector<Material>& materials)
        : scene_(scene), materials_(materials) {}

    // "Base colour: offset 0.5 0. What is pictured there (arrows, frames, seams) falls into place."
    std::string of(const Instance& instance, CheckFeature feature);

private:
    float leastAlpha(const Primitive& primitive);
    std::string ofMask(const Primitive& primitive);

    const Scene& scene_;
    const std::vector<Material>& materials_;
    std::map<int, float> least_alpha_;  // least alpha of an image's texels, found once
};

}  // namespace diptych
