// SPDX-License-Identifier: MIT
// Shades one surface by one sum over lights, for every path.
#ifndef SHADE_GLSL
#define SHADE_GLSL

#include "shaders/lib/shading/ambient.glsl"
#include "shaders/lib/lights/area.glsl"
#include "shaders/lib/shading/brdf.glsl"
#include "shaders/lib/shading/clearcoat.glsl"
#include "shaders/lib/shading/diffuse_transmission.glsl"
#include "shaders/lib/environment/environment.glsl"
#include "shaders/lib/shading/multiscatter.glsl"
#include "shaders/lib/lights/partial_sums.glsl"
#include "shaders/lib/lights/light_lists.glsl"
#include "shaders/lib/environment/haze.glsl"
#include "shaders/lib/lights/lights.glsl"
#include "shaders/lib/shadows/local_shadow.glsl"
#include "shaders/lib/math/loop.glsl"
#include "shaders/lib/lights/object_lights.glsl"
#include "shaders/lib/geometry/position.glsl"
#include "shaders/lib/shading/radiance.glsl"
#include "shaders/lib/shading/sheen.glsl"
#include "shaders/lib/shadows/shadow.glsl"
#include "shaders/lib/surface/surface.glsl"

// Values of a pixel that every light uses.
struct Shading {
    Surface surface;
    vec3 v;
    Brdf brdf;
    Clearcoat coat;  // only with LAYER_CLEARCOAT
    Sheen sheen;     // only with LAYER_SHEEN
    Behind behind;   // only with LAYER_DIFFUSE_TRANSMISSION
};

void addFromCoat(const vec3 reflected, inout Radiance radiance) {
    radiance.specular += reflected;
    radiance.clearcoat += reflected;
}

void addFromSheen(const vec3 reflected, inout Radiance radiance) {
    radiance.specular += reflected;
    radiance.sheen += reflected;
}

void addFromBehind(const vec3 transmitted, inout Radiance radiance) {
    radiance.diffuse += transmitted;
    radiance.transmission += transmitted;
}

// `layered`: false leaves out the code of sheens, films and light from behind.
void addIncident(const Shading shading, const Incident light, const bool layered, inout Radiance radiance) {
    Lobes sums = Lobes(radiance.diffuse, radiance.specular);
    addLight(shading.brdf, shading.surface.normal, shading.v, light, layered, sums);
    radiance.diffuse = sums.diffuse, radiance.specular = sums.specular;
    if (layered && hasLayer(LAYER_SHEEN))
        addFromSheen(sheenReflected(shading.sheen, shading.surface.normal, shading.v, light.direction,
                                    light.irradiance),
                     radiance);
    if (layered && hasLayer(LAYER_DIFFUSE_TRANSMISSION))
        addFromBehind(throughSurface(shading.behind, light.direction, light.irradiance), radiance);
    if (!hasLayer(LAYER_CLEARCOAT)) return;
    Lobes of_coat = Lobes(vec3(0.0), vec3(0.0));
    addLight(shading.coat.brdf, shading.coat.surface.normal, shading.v, light, false, of_coat);
    addFromCoat(of_coat.specular, radiance);
}

void addPoint(const Shading shading, const uint i, const bool layered, inout Radiance radiance) {
    addIncident(shading, fromPointLight(withShare(lightAt(i)), shading.surface.position), layered, radiance);
}

void addSpot(const Shading shading, const uint i, const bool layered, inout Radiance radiance) {
    addIncident(shading, fromSpotLight(withShare(lightAt(i)), spotConeAt(i), shading.surface.position),
                layered, radiance);
}

void addCasting(Shading shading, Incident light, uint place, vec3 position, inout Radiance radiance) {
    float seen = visibilityOf(shading.surface, place, position);
    float light_here = dot(light.irradiance, vec3(0.2126, 0.7152, 0.0722));
    radiance.local_light += light_here;
    radiance.local_seen += light_here * seen;
    light.irradiance *= seen;
    addIncident(shading, light, true, radiance);
}

void addCastingPoint(const Shading shading, const uint i, const LocalCasters casters,
                     inout Radiance radiance) {
    Light light = withShare(lightAt(i));
    Incident incident = fromPointLight(light, shading.surface.position);
    addCasting(shading, incident, i - view.directional_light_count, light.position, radiance);
}

void addCastingSpot(const Shading shading, const uint i, const LocalCasters casters,
                    inout Radiance radiance) {
    Light light = withShare(lightAt(i));
    Incident incident = fromSpotLight(light, spotConeAt(i), shading.surface.position);
    addCasting(shading, incident, i - casters.spot_shift, light.position, radiance);
}

// Adds the shadow-casting lights of one type in packets [x, y): the first ones, with indices below `end`.
// Leaves the packets that contain others.
#define ADD_CASTERS(add, packets, end)                       \
    {                                                       \
        CasterWalk walk = casterWalk(packets, end);         \
        while (walk.more) {                                 \
            add(shading, walk.light, casters, radiance);    \
            step(walk);                                     \
            if (!walk.more) break;                          \
        }                                                   \
        packets.x = walk.place / feature_list_width;        \
    }

// Adds the lights of one type in packets [x, y). If this type casts shadows, skips shadow-casting lights:
// those with indices below `end`. The code of these layers is long, so that it stands in a loop over
// single lights, once for each type.
#define ADD_PACKETS(add, packets, casting, end)                                                             \
    {                                                                                                       \
        uvec2 range = packets;                                                                              \
        if (hasLayer(LAYER_SHEEN | LAYER_IRIDESCENCE | LAYER_DIFFUSE_TRANSMISSION)) {                       \
            range *= feature_list_width;                                                                    \
            EACH(range) {                                                                                   \
                uvec4 i = lightsOfPacket(range.x / feature_list_width);                                     \
                if (on(feature_local_shadows & casting)) i = withoutCasters(i, end, casters.null_light);    \
                add(shading, i[range.x % feature_list_width], true, radiance);                              \
                NEXT(range);                                                                                \
            }                                                                                               \
        } else {                                                                                            \
            EACH(range) {                                                                                   \
                uvec4 i = lightsOfPacket(range.x);                                                          \
                if (on(feature_local_shadows & casting)) i = withoutCasters(i, end, casters.null_light);    \
                add(shading, i.x, false, radiance);                                                         \
                if (feature_list_width == 4) {                                                              \
                    add(shading, i.y, false, radiance);                                                     \
                    add(shading, i.z, false, radiance);                                                     \
                    add(shading, i.w, false, radiance);                                                     \
                }                                                                                           \
                NEXT(range);                                                                                \
            }                                                                                               \
        }                                                                                                   \
    }

// Continues with the area lights of one shape, with indices below `end`. One loop per shape, because a
// loop body costs all the code in it, executed or not.
#define ADD_AREA(add, end)                                                                              \
    while (walk.more && walk.number < end) {                                                            \
        AreaSums sums = AreaSums(radiance.diffuse, radiance.specular, radiance.sheen);                  \
        add(area, withShare(lightAt(walk.light)), areaLightAt(walk.number), position, sums);            \
        radiance.diffuse = sums.diffuse, radiance.specular = sums.specular;                             \
        radiance.sheen = sums.sheen;                                                                    \
        if (hasLayer(LAYER_CLEARCOAT)) {                                                                \
            AreaSums of_coat = AreaSums(vec3(0.0), vec3(0.0), vec3(0.0));                               \
            add(coat_area, withShare(lightAt(walk.light)), areaLightAt(walk.number), position, of_coat); \
            addFromCoat(of_coat.specular, radiance);                                                   \
        }                                                                                               \
        if (hasLayer(LAYER_DIFFUSE_TRANSMISSION)) {                                                     \
            AreaSums through = AreaSums(vec3(0.0), vec3(0.0), vec3(0.0));                               \
            add(area_behind, withShare(lightAt(walk.light)), areaLightAt(walk.number), position, through); \
            addFromBehind(through.diffuse, radiance);                                                   \
        }                                                                                               \
        step(walk);                                                                                     \
    }

// `emission`: dimmed by a clear coat.
Shading makeShading(const Surface s, inout vec3 emission) {
    vec3 v = viewVector(s.position);
    Brdf brdf = makeBrdf(s, v);
    if (on(feature_multiscatter)) brdf = compensated(brdf, s, specularAlbedo(brdf.alpha, brdf.n_dot_v));
    if (hasLayer(LAYER_IRIDESCENCE)) addFilm(brdf, s);
    Clearcoat coat = Clearcoat(s, brdf);
    Sheen sheen;
    sheen.color = vec3(0.0);
    if (hasLayer(LAYER_SHEEN)) {
        sheen = makeSheen(s, v);
        dim(brdf, belowSheen(sheen));
    }
    if (hasLayer(LAYER_CLEARCOAT)) {
        float weight = clearcoatWeight(s, v);
        coat = makeClearcoat(s, v, weight);
        dim(brdf, 1.0 - weight);
        emission *= 1.0 - weight;
        sheen.color *= 1.0 - weight;
    }
    Behind behind = Behind(brdf, s.normal, v);
    if (hasLayer(LAYER_DIFFUSE_TRANSMISSION)) behind = makeBehind(brdf, s.normal, v);
    return Shading(s, v, brdf, coat, sheen, behind);
}

// The sums of the batches before.
void readPartialSums(inout Radiance radiance) {
    vec4 diffuse = partialDiffuse(), specular = partialSpecular();
    radiance.diffuse = diffuse.rgb;
    radiance.specular = specular.rgb;
    if (hasLayer(LAYER_CLEARCOAT)) radiance.clearcoat = partialClearcoat().rgb;
    if (hasLayer(LAYER_SHEEN)) radiance.sheen = partialSheen().rgb;
    if (hasLayer(LAYER_DIFFUSE_TRANSMISSION)) radiance.transmission = partialTransmission().rgb;
    radiance.local_seen = diffuse.a;
    radiance.local_light = specular.a;
}

void addEnvironment(const Shading shading, inout Radiance radiance) {
    Surface s = shading.surface;
    vec3 from_base, from_lobe;
    reflectEnvironment(s, shading.brdf, shading.v, from_base, from_lobe);
    radiance.environment = from_base + from_lobe;
    vec3 from_coat = vec3(0.0), from_sheen = vec3(0.0), from_behind = vec3(0.0);
    if (hasLayer(LAYER_SHEEN)) {
        from_sheen = shading.sheen.color * (shading.sheen.albedo * environmentFactor() * s.occlusion) *
                     environmentIrradiance(s.normal);
        radiance.environment += from_sheen;
    }
    if (hasLayer(LAYER_CLEARCOAT)) {
        vec3 n = shading.coat.surface.normal;
        from_coat = lobeEnvironment(shading.coat.brdf, n, n, shading.v, environmentFactor() * s.occlusion);
        radiance.environment += from_coat;
    }
    if (hasLayer(LAYER_DIFFUSE_TRANSMISSION)) {
        from_behind = uniformThroughSurface(shading.behind) * (environmentFactor() * s.occlusion) *
                      environmentIrradiance(shading.behind.n);
        radiance.environment += from_behind;
    }
    if (feature_light_batch != BATCH_LATER) {
        radiance.diffuse += from_base;
        radiance.specular += from_lobe;
        if (hasLayer(LAYER_SHEEN)) addFromSheen(from_sheen, radiance);
        if (hasLayer(LAYER_CLEARCOAT)) addFromCoat(from_coat, radiance);
        if (hasLayer(LAYER_DIFFUSE_TRANSMISSION)) addFromBehind(from_behind, radiance);
    }
}

void addDirectionalLights(const Shading shading, inout Radiance radiance) {
    uvec2 range = directionalPackets();
    EACH(range) {
        Incident light = fromDirectionalLight(directionalAt(range.x));
        if (on(feature_shadows) && directionalOf(range.x) == castingLight())
            light.irradiance *= radiance.sun_visibility;
        addIncident(shading, light, true, radiance);
        NEXT(range);
    }
}

void addPunctualLights(const Shading shading, const PixelLights lights, inout Radiance radiance) {
    LocalCasters casters = LocalCasters(0u, 0u, 0u, 0u);
    if (on(feature_local_shadows)) casters = localCasters();
    if (on(feature_point_lights)) {
        uvec2 packets = walked(lights, lights.packets.begin, lights.packets.point_end);
        if (on(feature_local_shadows & LOCAL_SHADOWS_POINTS))
            ADD_CASTERS(addCastingPoint, packets, casters.point_end)
        ADD_PACKETS(addPoint, packets, LOCAL_SHADOWS_POINTS, casters.point_end)
    }
    if (on(feature_spot_lights)) {
        uvec2 packets = walked(lights, lights.packets.point_end, lights.packets.spot_end);
        if (on(feature_local_shadows & LOCAL_SHADOWS_SPOTS))
            ADD_CASTERS(addCastingSpot, packets, casters.spot_end)
        ADD_PACKETS(addSpot, packets, LOCAL_SHADOWS_SPOTS, casters.spot_end)
    }
}

void addAreaLights(const Shading shading, const PixelLights lights, inout Radiance radiance) {
    vec3 position = shading.surface.position;
    AreaView area = areaView(shading.brdf, shading.surface, shading.v), coat_area = area, area_behind = area;
    if (hasLayer(LAYER_DIFFUSE_TRANSMISSION)) {
        Surface turned = shading.surface;
        turned.normal = shading.behind.n;
        area_behind = areaView(shading.behind.brdf, turned, shading.behind.v);
    }
    if (hasLayer(LAYER_SHEEN)) area.woven = true, area.sheen = shading.sheen;
    if (hasLayer(LAYER_CLEARCOAT)) coat_area = areaView(shading.coat.brdf, shading.coat.surface, shading.v);
    AreaWalk walk = areaWalk(walked(lights, lights.packets.spot_end, lights.packets.end));
    if (on(feature_area_lights & AREA_RECTS)) ADD_AREA(addRect, firstDisc())
    if (on(feature_area_lights & AREA_DISCS)) ADD_AREA(addDisc, firstTube())
    if (on(feature_area_lights & AREA_TUBES)) ADD_AREA(addTube, areaCount())
}

void addAmbient(const Shading shading, inout Radiance radiance) {
    Surface s = shading.surface;
    if (on(feature_ambient) || on(feature_lightmap))
        radiance.ambient = s.occlusion * reflectedAmbient(shading.brdf, view.ambient, s.lightmap);
    // Batches hand on the parts of layers, but not the sum.
    bool once = feature_light_batch != BATCH_LATER;
    if (on(feature_ambient) && hasLayer(LAYER_SHEEN)) {
        vec3 reflected = shading.sheen.color * (shading.sheen.albedo * s.occlusion) * view.ambient;
        radiance.ambient += reflected;
        if (once) radiance.sheen += reflected;
    }
    if (on(feature_ambient) && hasLayer(LAYER_CLEARCOAT)) {
        vec3 reflected = s.occlusion * (lobeShare(shading.coat.brdf) * view.ambient);
        radiance.ambient += reflected;
        if (once) radiance.clearcoat += reflected;
    }
    if (on(feature_ambient) && hasLayer(LAYER_DIFFUSE_TRANSMISSION)) {
        vec3 passed = s.occlusion * (uniformThroughSurface(shading.behind) * view.ambient);
        radiance.ambient += passed;
        if (once) radiance.transmission += passed;
    }
}

// Sums over the pixel's lights, in the buffer's order. Occlusion dims ambient light and environments. Haze
// lies in front of the sum and only lit() applies it.
Radiance shade(const Surface s, const PixelLights lights) {
    Radiance radiance = noRadiance();
    bool has_suns = on(feature_directional_lights) && feature_light_batch != BATCH_LATER;
    // First, while few values are live: a shadow map's filter needs more registers than anything after it.
    // On RDNA 2 this order takes 80 instead of 128 (compare/bench/MEASURED.md).
    if (has_suns) radiance.sun_visibility = sunVisibility(s);
    radiance.emission = s.emission;
    Shading shading = makeShading(s, radiance.emission);
    if (feature_light_batch == BATCH_LATER) readPartialSums(radiance);
    if (feature_object_lights > OBJECT_LIGHTS_LISTS && feature_light_batch != BATCH_LATER) {
        // The base reflects the draw's lights that are not shaded per pixel.
        vec3 reflected = shading.brdf.diffuse * baseShare(shading.brdf) * s.object_irradiance;
        radiance.diffuse = reflected;
    }
    if (on(feature_environment)) addEnvironment(shading, radiance);
    if (has_suns) addDirectionalLights(shading, radiance);
    if (on(feature_point_lights) || on(feature_spot_lights)) addPunctualLights(shading, lights, radiance);
    if (on(feature_area_lights)) addAreaLights(shading, lights, radiance);
    addAmbient(shading, radiance);
    if (on(feature_haze)) {
        Hazed hazed = hazeTo(s.position);
        radiance.transmittance = hazed.transmittance;
        radiance.haze = hazed.scattered;
    }
    return radiance;
}

#endif
