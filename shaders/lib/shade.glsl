// SPDX-License-Identifier: MIT
// One surface, one sum over lights, for every path.
#ifndef SHADE_GLSL
#define SHADE_GLSL

// AREA_LIGHTS: 1 in the modules for scenes that have area lights. A pipeline that switches them off would
// have their code pruned, but only after a compiler has read three times as much.
#ifndef AREA_LIGHTS
#define AREA_LIGHTS 0
#endif

#include "shaders/lib/ambient.glsl"
#if AREA_LIGHTS
#include "shaders/lib/area.glsl"
#endif
#include "shaders/lib/brdf.glsl"
#include "shaders/lib/encoded_surface.glsl"
#include "shaders/lib/partial_sums.glsl"
#include "shaders/lib/light_lists.glsl"
#include "shaders/lib/lights.glsl"
#include "shaders/lib/loop.glsl"
#include "shaders/lib/object_lights.glsl"
#include "shaders/lib/position.glsl"
#include "shaders/lib/radiance.glsl"
#include "shaders/lib/surface.glsl"

// What every light meets at a pixel.
struct Shading {
    Surface surface;
    vec3 v;
    Brdf brdf;
};

void addIncident(Shading shading, Incident light, inout Radiance radiance) {
    addLight(shading.brdf, shading.surface.normal, shading.v, light.direction, light.irradiance,
             radiance.diffuse, radiance.specular);
}

void addPoint(Shading shading, uint i, inout Radiance radiance) {
    addIncident(shading, fromPointLight(withShare(lightAt(i)), shading.surface.position), radiance);
}

void addSpot(Shading shading, uint i, inout Radiance radiance) {
    addIncident(shading, fromSpotLight(withShare(lightAt(i)), spotConeAt(i), shading.surface.position),
                radiance);
}

// Adds the packets [x, y) of one kind of light.
#define ADD_PACKETS(add, packets)                  \
    {                                             \
        uvec2 range = packets;                    \
        EACH(range) {                             \
            uvec4 i = lightsOfPacket(range.x);     \
            add(shading, i.x, radiance);          \
            if (feature_list_width == 4) {        \
                add(shading, i.y, radiance);      \
                add(shading, i.z, radiance);      \
                add(shading, i.w, radiance);      \
            }                                     \
            NEXT(range);                          \
        }                                         \
    }

// Continues with the area lights of one shape, those with numbers below `end`. One loop for each shape,
// because a loop body costs all the code in it, executed or not.
#define ADD_AREA(add, end)                                                                              \
    while (walk.more && walk.number < end) {                                                            \
        add(area, withShare(lightAt(walk.light)), areaLightAt(walk.number), s.position, radiance.diffuse, \
            radiance.specular);                                                                         \
        step(walk);                                                                                     \
    }

// The sum over the pixel's lights, in the buffer's order. Occlusion dims ambient light alone.
Radiance shade(Surface s, PixelLights lights) {
    vec3 v = viewVector(s.position);
    Shading shading = Shading(s, v, shadedBrdf(s, v));
    Radiance radiance = Radiance(vec3(0.0), vec3(0.0), vec3(0.0), s.emission);
    if (feature_light_batch == BATCH_LATER) {
        radiance.diffuse = partialDiffuse();
        radiance.specular = partialSpecular();
    }
    if (feature_object_lights > OBJECT_LIGHTS_LISTS && feature_light_batch != BATCH_LATER) {
        // The base's reflection of the draw's lights that are not shaded per pixel.
        vec3 reflected = shading.brdf.diffuse * baseShare(shading.brdf) * s.object_irradiance;
        radiance.diffuse = reflected;
    }
    if (on(feature_directional_lights) && feature_light_batch != BATCH_LATER) {
        uvec2 range = directionalPackets();
        EACH(range) {
            addIncident(shading, fromDirectionalLight(directionalAt(range.x)), radiance);
            NEXT(range);
        }
    }
    if (on(feature_point_lights))
        ADD_PACKETS(addPoint, walked(lights, lights.packets.begin, lights.packets.point_end))
    if (on(feature_spot_lights))
        ADD_PACKETS(addSpot, walked(lights, lights.packets.point_end, lights.packets.spot_end))
#if AREA_LIGHTS
    if (on(feature_area_lights)) {
        AreaView area = areaView(shading.brdf, s, v);
        AreaWalk walk = areaWalk(walked(lights, lights.packets.spot_end, lights.packets.end));
        if (on(feature_area_lights & AREA_RECTS)) ADD_AREA(addRect, firstDisc())
        if (on(feature_area_lights & AREA_DISCS)) ADD_AREA(addDisc, firstTube())
        if (on(feature_area_lights & AREA_TUBES)) ADD_AREA(addTube, areaCount())
    }
#endif
    if (on(feature_ambient) || on(feature_lightmap))
        radiance.ambient = s.occlusion * reflectedAmbient(shading.brdf, view.ambient, s.lightmap);
    return radiance;
}

#endif
