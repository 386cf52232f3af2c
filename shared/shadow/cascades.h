// SPDX-License-Identifier: MIT
// Where the cascades of the sun's shadow map lie: which view depths each serves, and which part of light
// space it covers. Everything is in double and in metres.
#pragma once

#include "shared/contract/shadow.h"
#include "shared/scene/motion/bounds.h"
#include "shared/scene/view.h"

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>

#include <optional>
#include <vector>

namespace diptych {

// View depths, m.
struct DepthRange {
    double near = 0, far = 0;
};

// What the user chooses.
struct CascadeRequest {
    int size = 2048;                    // texels of a side
    int count = 4;                      // 1 to MAX_CASCADES
    int kernel = 3;                     // side of the filter, texels
    double distance = 0;                // m of view depth that get shadows; 0: as far as the scene reaches
    double bias = 0.5;                  // texels, along the geometric normal
    std::optional<DepthRange> shown{};  // what the picture shows: cascades serve nothing else
};

// Texels on each side of a receiver that are read for it, with the step to whole texels: what the filter
// reads, and how far a surface is moved before it reads.
double marginOf(const CascadeRequest& request);

// Light space: unit axes in world directions; z points to the light.
struct LightSpace {
    glm::dvec3 x, y, z;
    glm::dvec3 from(const glm::dvec3& world) const;  // world axes, any origin
    bool operator==(const LightSpace&) const = default;
};
// `to_light`: unit.
LightSpace lightSpace(const glm::dvec3& to_light);

struct CascadeArea {
    double begin = 0, end = 0;  // view depths that it serves, m; neighbours overlap where they blend
    glm::dvec2 corner{0};       // lower corner in light space with the world's origin, m
    double texel = 0;           // m
};

struct Cascades {
    LightSpace space;
    double near = 0, far = 0;  // z of light space with the world's origin, m: of the depths 1 and 0
    std::vector<CascadeArea> areas{};

    // Clip space of a cascade from world axes with `eye` as the origin: x and y in -1..1, depth as in
    // shared/contract/shadow.h.
    glm::dmat4 clipFromWorld(const CascadeArea& area, int size, const glm::dvec3& eye) const;
};

// View depths at which `count` cascades end, m: a mean of equal ratios and equal differences, the "practical
// split scheme" of Zhang et al. 2006, "Parallel-Split Shadow Maps for Large-scale Virtual Environments".
std::vector<double> splitDepths(double near, double far, int count);

// The share of a cascade's view depths at its far end over which it blends into the next.
inline constexpr double cascadeBlend = 0.1;

// `bounds`: of everything that casts or receives. A cascade covers the bounding sphere of its part of the
// view, whose size does not depend on where the camera looks, and moves by whole texels, so that a texel
// covers the same part of the world while the camera moves (Valient 2007, "Stable Rendering of Cascaded
// Shadow Maps"); where the whole scene is smaller, it covers that. Around what it covers lie as many texels
// as the filter reads.
Cascades fitCascades(const View& view, const Bounds& bounds, const glm::dvec3& to_light,
                     const CascadeRequest& request);

// For the shaders. `light`: its number among the directional lights.
gpu::ShadowLight gpuShadowLight(const Cascades& cascades, const View& view, gpu::uint light);
std::vector<gpu::Cascade> gpuCascades(const Cascades& cascades, const glm::dvec3& eye, double bias);

}  // namespace diptych
