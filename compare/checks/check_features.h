// SPDX-License-Identifier: MIT
// Features that both paths may render wrongly in the same way, with a description of the correct image.
#pragma once

#include "shared/scene/model/scene.h"
#include "shared/scene/motion/pose.h"

#include <cstddef>
#include <cstdint>
#include <iterator>
#include <map>
#include <string>

namespace diptych {

// name, heading in the report.
#define CHECK_FEATURES(X)                           \
    X(texture_transform, "texture transforms")      \
    X(second_texcoord, "second UV set")             \
    X(sampler, "samplers")                          \
    X(normal_map, "normal maps")                    \
    X(clearcoat, "clear coats")                     \
    X(anisotropy, "anisotropy")                     \
    X(sheen, "sheen")                               \
    X(iridescence, "iridescence")                   \
    X(transmission, "transmission")                 \
    X(diffuse_transmission, "diffuse transmission") \
    X(vertex_colors, "vertex colours")              \
    X(alpha_mask, "alpha masks")                    \
    X(blend, "blending")                            \
    X(double_sided, "double-sided surfaces")        \
    X(mirrored, "mirrored instances")               \
    X(unlit, "unlit materials")                     \
    X(deep_image, "images with more than 8 bits")   \
    X(skin, "skins")                                \
    X(morph, "morph targets")                       \
    X(flat, "flat normals")                         \
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

// Bit f is CheckFeature f.
using CheckFeatures = std::uint32_t;
constexpr CheckFeatures bitOf(CheckFeature feature) {
    return CheckFeatures{1} << static_cast<unsigned>(feature);
}

// Features of a primitive that do not depend on its instance. Reads each vertex once. Skips features
// without effect, such as white vertex colours, or a wrap mode with all coordinates in [0, 1].
// `materials`: at the pose's time (materialsOf()).
CheckFeatures featuresOf(const Scene& scene, const std::vector<Material>& materials,
                         const Primitive& primitive);

// Adds features that depend on the instance.
CheckFeatures featuresOf(const Scene& scene, const Instance& instance, CheckFeatures ofPrimitive);

// Describes the correct image of a feature, for visual inspection.
class CheckSentences {
public:
    CheckSentences(const Scene& scene, const std::vector<Material>& materials)
        : scene_(scene), materials_(materials) {}

    // "Base colour: offset 0.5 0. Arrows, frames and seams in the texture are in the right place."
    std::string of(const Instance& instance, CheckFeature feature);

private:
    float minAlpha(const Primitive& primitive);
    std::string ofMask(const Primitive& primitive);
    std::string ofBlending(const Primitive& primitive);
    std::string ofTransmission(const Primitive& primitive);
    std::string ofMorphTargets(const Instance& instance);

    const Scene& scene_;
    const std::vector<Material>& materials_;
    std::map<int, float> min_alpha_;  // key: image; cached
};

}  // namespace diptych
