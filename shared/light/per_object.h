// SPDX-License-Identifier: MIT
// Light selection per object, as in engines before tiles and froxels; after Unity's built-in pipeline
// ("Forward rendering path details"). Lights are ranked by brightness at the object. The first few are
// shaded per pixel, the next four per vertex, the rest as spherical harmonics. No Vulkan.
#pragma once

#include "shared/contract/object_lights.h"
#include "shared/light/lights.h"

#include <cstdint>
#include <span>
#include <vector>

namespace diptych {

// Bounding box of an object, axis-aligned, in world axes from the camera, m.
struct ObjectPosition {
    glm::dvec3 centre{0}, half{0};
    bool harmonics = true;  // false: its harmonics are dropped (an object with a lightmap)
};

// Brightness of light `i` at an object: luminance (Rec.709) of its irradiance, W/m^2, with window and cone
// (GpuLights::falloff) at the nearest point of the box: upper bounds over it. Distances are softened by half
// the box's radius, so that a light inside the box does not outrank all others. 0 only if no point of the box
// receives light.
double brightnessAt(const GpuLights& lights, std::size_t i, const ObjectPosition& object);

// Fraction of a light in the better of two groups. 0 at the brightness `threshold` of the brightest light
// beyond the group's capacity, 1 from fadeRange times that on, smooth in between: so nothing pops when two
// lights swap ranks. 1 if there is no such light (`threshold` 0).
double fade(double brightness, double threshold);
inline constexpr double fadeRange = 4;

// How a light at an object is split; the sum is 1 if the light reaches the object. Area lights have no
// vertex fraction: the harmonics include it, as a patch at the light's centre.
struct LightFractions {
    double pixel = 0, vertex = 0, harmonics = 0;
};

// `pixels`: lights per pixel. Marks (Light::importance): important lights are shaded per pixel in their
// range, in addition to `pixels` others; unimportant ones never are. GpuLights::base is always shaded per
// pixel. Lights of exactly the threshold's brightness fill the remaining capacity in scene order.
std::vector<LightFractions> lightFractions(const GpuLights& lights, const ObjectPosition& object,
                                           std::uint32_t pixels);

// Adds a light of irradiance `e` from the unit direction `to_light`. The bands of the clamped cosine are
// 1/4, n.l / 2 and 5/32 (3 (n.l)^2 - 1). `directed` in [0, 1], 0 for uniform light: its powers scale the
// bands.
void addHarmonics(gpu::ObjectIrradiance& sum, const glm::dvec3& e, const glm::dvec3& to_light,
                  double directed = 1);

// Adds the irradiance of light `i` at an object's centre, softened by the box's radius: inside it the
// light becomes more uniform.
void addHarmonics(gpu::ObjectIrradiance& sum, const GpuLights& lights, std::size_t i,
                  const ObjectPosition& object, double fraction);

struct ObjectLightLists {
    std::vector<gpu::ObjectLights> objects;  // same order as the input
    std::vector<gpu::ObjectLight> entries;
    std::uint32_t longest = 0;   // largest number of local lights per pixel of one object
    std::uint32_t features = 0;  // OBJECT_LIGHTS_* of possible groups, wherever lights and objects are
};

// Uses all cores. Lights that reach no point of an object are in none of its lists: their contribution is
// exactly zero.
ObjectLightLists objectLightLists(const GpuLights& lights, std::span<const ObjectPosition> objects,
                                  std::uint32_t pixels);

}  // namespace diptych
