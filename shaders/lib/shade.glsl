// SPDX-License-Identifier: MIT
// One surface, one sum over lights, for every path.
#ifndef SHADE_GLSL
#define SHADE_GLSL

// AREA_LIGHTS: 1 in the modules for scenes that have some. They would be pruned from a pipeline that switches them off,
// but only after a compiler has read three times as much.
#ifndef AREA_LIGHTS
#define AREA_LIGHTS 0
#endif

#include "shaders/lib/ambient.glsl"
#if AREA_LIGHTS
#include "shaders/lib/area.glsl"
#endif
#include "shaders/lib/brdf.glsl"
#include "shaders/lib/carry.glsl"
#include "shaders/lib/light_lists.glsl"
#include "shaders/lib/lights.glsl"
#include "shaders/lib/object_lights.glsl"
#include "shaders/lib/position.glsl"
#include "shaders/lib/surface.glsl"

// W/(sr m^2), towards the viewer.
struct Radiance {
    vec3 diffuse;
    vec3 specular;
    vec3 ambient;
    vec3 emission;
};

vec3 lit(Radiance radiance) {
    precise vec3 sum = ((radiance.diffuse + radiance.specular) + radiance.ambient) + radiance.emission;
    return sum;
}

// What every light meets at a pixel.
struct Shading {
    Surface surface;
    vec3 v;
    Brdf brdf;
};

void addIncident(Shading shading, Incident light, inout Radiance radiance) {
    addLight(shading.brdf, shading.surface.normal, shading.v, light.direction, light.irradiance, radiance.diffuse,
             radiance.specular);
}

void addPoint(Shading shading, uint i, inout Radiance radiance) {
    addIncident(shading, fromPointLight(withShare(lightAt(i)), shading.surface.position), radiance);
}

void addSpot(Shading shading, uint i, inout Radiance radiance) {
    addIncident(shading, fromSpotLight(withShare(lightAt(i)), spotConeAt(i), shading.surface.position), radiance);
}

// The groups [x, y) of one kind. On lavapipe a loop that ends at its test first runs a body too many, for nothing; one that
// tests last alone goes on adding to pixels that are done, where others are not: what it computes is not masked unless
// another way out makes it a merge of two values.
#define ADD_GROUPS(add, groups)                   \
    {                                             \
        uvec2 range = groups;                     \
        while (range.x < range.y) {               \
            uvec4 i = lightsOfGroup(range.x);     \
            add(shading, i.x, radiance);          \
            if (feature_list_width == 4) {        \
                add(shading, i.y, radiance);      \
                add(shading, i.z, radiance);      \
                add(shading, i.w, radiance);      \
            }                                     \
            if (++range.x >= range.y) break;      \
        }                                         \
    }

// Goes on with the area lights of one shape, numbers below `end`: a loop a shape, for a body costs what is in it.
#define ADD_AREA(add, end)                                                                              \
    while (walk.more && walk.number < end) {                                                            \
        add(area, withShare(lightAt(walk.light)), areaLightAt(walk.number), s.position, radiance.diffuse, radiance.specular); \
        step(walk);                                                                                     \
    }

// The sum over the pixel's lights, in the buffer's order. Occlusion dims ambient light alone.
Radiance shade(Surface s, PixelLights lights) {
    vec3 v = viewVector(s.position);
    Shading shading = Shading(s, v, makeBrdf(s, v));
    precise Radiance radiance = Radiance(vec3(0.0), vec3(0.0), vec3(0.0), s.emission);
    if (feature_light_chunk == CHUNK_LATER) {
        radiance.diffuse = carriedDiffuse();
        radiance.specular = carriedSpecular();
    }
    if (feature_object_lights > OBJECT_LIGHTS_LISTS && feature_light_chunk != CHUNK_LATER) {
        // What of the draw's other lights the base reflects.
        precise vec3 reflected = shading.brdf.diffuse * baseShare(shading.brdf) * s.object_irradiance;
        radiance.diffuse = reflected;
    }
    if (on(feature_directional_lights) && feature_light_chunk != CHUNK_LATER) {
        uvec2 range = directionalGroups();
        while (range.x < range.y) {
            addIncident(shading, fromDirectionalLight(directionalAt(range.x)), radiance);
            if (++range.x >= range.y) break;
        }
    }
    if (on(feature_point_lights)) ADD_GROUPS(addPoint, walked(lights, lights.groups.begin, lights.groups.point_end))
    if (on(feature_spot_lights)) ADD_GROUPS(addSpot, walked(lights, lights.groups.point_end, lights.groups.spot_end))
#if AREA_LIGHTS
    if (on(feature_area_lights)) {
        AreaView area = areaView(shading.brdf, s, v);
        AreaWalk walk = areaWalk(walked(lights, lights.groups.spot_end, lights.groups.end));
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
