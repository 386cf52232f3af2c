// SPDX-License-Identifier: MIT
// Cascades of the sun's shadow map: the view depths and the area of light space that each covers. In
// double and metres.
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

// User settings.
struct CascadeRequest {
    int size = 2048;                    // texels along a side
    int count = 4;                      // 1 to MAX_CASCADES
    int kernel = 3;                     // side of the filter, texels
    double distance = 0;                // view depth at which shadows end, m; 0: extent of the scene
    double bias = 0.5;                  // texels, along the geometric normal
    std::optional<DepthRange> shown{};  // visible depths; cascades cover no others
};

// Texels on each side of a receiver that may be sampled: the filter's radius, the receiver's offset, and
// snapping to whole texels.
double marginOf(const CascadeRequest& request);

// Light space: unit axes in world space; z points to the light.
struct LightSpace {
    glm::dvec3 x, y, z;
    glm::dvec3 from(const glm::dvec3& world) const;  // world axes, any origin
    bool operator==(const LightSpace&) const = default;
};
// `to_light`: unit.
LightSpace lightSpace(const glm::dvec3& to_light);

struct CascadeArea {
    double begin = 0, end = 0;  // view depths that it covers, m; neighbours overlap where they blend
    glm::dvec2 corner{0};       // lower corner in light space relative to the world's origin, m
    double texel = 0;           // m
};

struct Cascades {
    LightSpace space;
    double near = 0, far = 0;  // z of light space relative to the world's origin, m, at depths 1 and 0
    std::vector<CascadeArea> areas{};

    // Transform from world axes relative to `eye` to clip space of a cascade: x and y in -1..1, depth as
    // in shared/contract/shadow.h.
    glm::dmat4 clipFromWorld(const CascadeArea& area, int size, const glm::dvec3& eye) const;
};

// View depths at which `count` cascades end, m: a mean of logarithmic and uniform splits, the "practical
// split scheme" of Zhang et al. 2006, "Parallel-Split Shadow Maps for Large-scale Virtual Environments".
std::vector<double> splitDepths(double near, double far, int count);

// Fraction of a cascade's depth range, at its far end, over which it blends into the next.
inline constexpr double cascadeBlend = 0.1;

// `bounds`: of all casters and receivers. A cascade covers the bounding sphere of its part of the view, or
// the whole scene if that is smaller. The sphere's size does not depend on the view direction, and it
// moves by whole texels. So a texel covers the same part of the world while the camera moves (Valient
// 2007, "Stable Rendering of Cascaded Shadow Maps"). A border of the filter's size surrounds the area.
Cascades fitCascades(const View& view, const Bounds& bounds, const glm::dvec3& to_light,
                     const CascadeRequest& request);

// For shaders. `light`: index among the directional lights.
gpu::ShadowLight gpuShadowLight(const Cascades& cascades, const View& view, gpu::uint light);
std::vector<gpu::Cascade> gpuCascades(const Cascades& cascades, const glm::dvec3& eye, double bias);

}  // namespace diptych
