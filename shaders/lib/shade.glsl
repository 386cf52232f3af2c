// SPDX-License-Identifier: MIT
// One surface, one sum over lights, for every path.
#ifndef SHADE_GLSL
#define SHADE_GLSL

#include "shaders/lib/area.glsl"
#include "shaders/lib/brdf.glsl"
#include "shaders/lib/carry.glsl"
#include "shaders/lib/light_lists.glsl"
#include "shaders/lib/lights.glsl"
#include "shaders/lib/position.glsl"
#include "shaders/lib/surface.glsl"

// W/(sr m^2), towards the viewer.
struct Radiance {
    vec3 diffuse;
    vec3 specular;
    vec3 emission;
};

vec3 lit(Radiance radiance) {
    precise vec3 sum = (radiance.diffuse + radiance.specular) + radiance.emission;
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
    addIncident(shading, fromPointLight(lightAt(i), shading.surface.position), radiance);
}

void addSpot(Shading shading, uint i, inout Radiance radiance) {
    addIncident(shading, fromSpotLight(lightAt(i), spotConeAt(i), shading.surface.position), radiance);
}

// By its place among the area lights: rectangles, discs, tubes. On lavapipe a light costs what all the shapes that
// the scene has cost together.
void addArea(AreaView area, uint i, vec3 position, inout Radiance radiance) {
    Light light = lightAt(i);
    uint number = areaNumber(i);
    AreaLight shape = areaLightAt(number);
    uint discs = view.rect_light_count, tubes = discs + view.disc_light_count;
    if (on(feature_area_lights & AREA_RECTS) && number < discs)
        addRect(area, light, shape, position, radiance.diffuse, radiance.specular);
    if (on(feature_area_lights & AREA_DISCS) && number >= discs && number < tubes)
        addDisc(area, light, shape, position, radiance.diffuse, radiance.specular);
    if (on(feature_area_lights & AREA_TUBES) && number >= tubes)
        addTube(area, light, shape, position, radiance.diffuse, radiance.specular);
}

// The groups [x, y) of one kind, one at least with lists: on lavapipe a loop that tests last runs a body less than one
// that tests first.
#define ADD_GROUPS(add, groups)                                \
    {                                                          \
        uvec2 range = groups;                                  \
        uint group = range.x;                                  \
        bool more = group < range.y;                           \
        while (more) {                                         \
            uvec4 i = lightsOfGroup(group);                    \
            add(shading, i.x, radiance);                       \
            if (feature_list_width == 4) {                     \
                add(shading, i.y, radiance);                   \
                add(shading, i.z, radiance);                   \
                add(shading, i.w, radiance);                   \
            }                                                  \
            more = ++group < range.y;                          \
        }                                                      \
    }

// The sum over the pixel's lights, in the buffer's order. Occlusion is for ambient light alone and dims nothing here.
Radiance shade(Surface s, PixelLights lights) {
    vec3 v = viewVector(s.position);
    Shading shading = Shading(s, v, makeBrdf(s, v));
    precise Radiance radiance = Radiance(vec3(0.0), vec3(0.0), s.emission);
    if (feature_light_chunk == CHUNK_LATER) {
        radiance.diffuse = carriedDiffuse();
        radiance.specular = carriedSpecular();
    }
    if (on(feature_directional_lights) && feature_light_chunk != CHUNK_LATER)
        for (uint i = 0; i < view.directional_light_count; ++i)
            addIncident(shading, fromDirectionalLight(lightAt(i)), radiance);
    if (on(feature_point_lights)) ADD_GROUPS(addPoint, walked(lights, lights.groups.begin, lights.groups.point_end))
    if (on(feature_spot_lights)) ADD_GROUPS(addSpot, walked(lights, lights.groups.point_end, lights.groups.spot_end))
    if (on(feature_area_lights)) {
        AreaView area = areaView(shading.brdf, s, v);
        uvec2 range = walked(lights, lights.groups.spot_end, lights.groups.end) * feature_list_width;
        uint next = range.x, i = lightOfPlace(next);
        bool more = next < range.y;
        while (more) {
            addArea(area, i, s.position, radiance);
            i = lightOfPlace(++next);
            // What fills the last group up is dear here.
            more = next < range.y && !isNullLight(i);
        }
    }
    return radiance;
}

#endif
