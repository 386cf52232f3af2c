// SPDX-License-Identifier: MIT
// Lights chosen by object, as engines did before tiles and froxels; after Unity's built-in pipeline ("Forward
// rendering path details"): ranked by their brightness at the object, the first few are shaded per pixel,
// four more per vertex, the rest as spherical harmonics. No Vulkan.
#pragma once

#include "shared/contract/object_lights.h"
#include "shared/light/lights.h"

#include <cstdint>
#include <span>
#include <vector>

namespace diptych {

// Where an object is: an axis-aligned box, from the camera, world axes, m.
struct ObjectPlace {
    glm::dvec3 centre{0}, half{0};
    bool harmonics = true;  // false: what would be in them is dropped (an object with a lightmap)
};

// How bright light `i` is at an object: the luminance (Rec.709) of its irradiance, W/m^2, window and cone as
// they are where the box is nearest to it. Distances are softened by half the box's radius, so that a light
// inside the box does not outrank all others whatever its strength. 0 only where no point of the box gets any
// light.
double brightnessAt(const GpuLights& lights, std::size_t i, const ObjectPlace& object);

// The share of a light in the better of two groups: 0 where it is as bright as `threshold`, the brightest
// light that the group has no room for, 1 from fadeRange times that on, smooth between, so that nothing pops
// where two lights change places. 1 where there is no such light.
double fade(double brightness, double threshold);
inline constexpr double fadeRange = 4;

// What becomes of each light at an object; the three shares of a light that reaches it sum to 1. An area
// light has none per vertex: the harmonics have it, as a patch in its centre.
struct LightShares {
    double pixel = 0, vertex = 0, harmonics = 0;
};

// `pixels`: lights per pixel. By marks (Light::importance) an important light is shaded per pixel wherever it
// reaches, beside those that `pixels` has room for; one that is not important never. GpuLights::base is
// shaded per pixel even if there is no room. Lights that are exactly as bright as the first one without room
// fill what is left of it, in the scene's order.
std::vector<LightShares> lightShares(const GpuLights& lights, const ObjectPlace& object,
                                     std::uint32_t pixels);

// Adds a light of irradiance `e` from the unit direction `to_light`: the clamped cosine's bands are 1/4, n.l
// / 2 and 5/32 (3 (n.l)^2 - 1). `directed` in [0, 1]: 0 comes from all sides alike, and its powers dim the
// bands.
void addHarmonics(gpu::ObjectIrradiance& sum, const glm::dvec3& e, const glm::dvec3& to_light,
                  double directed = 1);

// The irradiance at an object's centre of light `i`: softened by the box's radius, inside which the light
// comes from ever more sides.
void addHarmonics(gpu::ObjectIrradiance& sum, const GpuLights& lights, std::size_t i,
                  const ObjectPlace& object, double share);

struct ObjectLightLists {
    std::vector<gpu::ObjectLights> objects;  // as the places given
    std::vector<gpu::ObjectLight> entries;
    std::uint32_t longest = 0;   // local lights per pixel of one object
    std::uint32_t features = 0;  // OBJECT_LIGHTS_*, by what there may be, wherever lights and objects are
};

// On all cores. A light that reaches no point of an object is in none of its lists: the shaders' exact zeros.
ObjectLightLists objectLightLists(const GpuLights& lights, std::span<const ObjectPlace> objects,
                                  std::uint32_t pixels);

}  // namespace diptych
