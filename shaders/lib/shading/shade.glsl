// SPDX-License-Identifier: MIT
// Shades one surface by one sum over lights, for every path.
#ifndef SHADE_GLSL
#define SHADE_GLSL

#extension GL_EXT_control_flow_attributes : require

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
#include "shaders/lib/lights/punctual_lights.glsl"
#include "shaders/lib/shadows/local_shadow.glsl"
#include "shaders/lib/math/loop.glsl"
#include "shaders/lib/lights/object_lights.glsl"
#include "shaders/lib/geometry/position.glsl"
#include "shaders/lib/shading/radiance.glsl"
#include "shaders/lib/shading/sheen.glsl"
#include "shaders/lib/shadows/sun_shadow.glsl"
#include "shaders/lib/surface/surface.glsl"

// Values of a pixel that every light uses.
struct Shading {
    Surface surface;
    vec3 v;
    Reflector base;
    Reflector coat;    // only with LAYER_CLEARCOAT
    Reflector behind;  // only with LAYER_DIFFUSE_TRANSMISSION
    Sheen sheen;       // only with LAYER_SHEEN
};

// Lights run over the reflectors of a material, so that a module holds their code once: the base, then the
// coat and what lies behind, where there are such layers. specialized() dissolves the loop over a base.
uint reflectorCount() {
    return 1u + (hasLayer(LAYER_CLEARCOAT) ? 1u : 0u) + (hasLayer(LAYER_DIFFUSE_TRANSMISSION) ? 1u : 0u);
}
bool isBase(const uint reflector) { return reflector == 0u; }
bool isCoat(const uint reflector) { return hasLayer(LAYER_CLEARCOAT) && reflector == 1u; }
bool isBehind(const uint reflector) {
    return hasLayer(LAYER_DIFFUSE_TRANSMISSION) && reflector == reflectorCount() - 1u;
}

Reflector reflectorOf(const Shading shading, const uint reflector) {
    Reflector r = shading.base;
    if (isCoat(reflector)) r = shading.coat;
    if (isBehind(reflector)) r = shading.behind;
    return r;
}

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

// `sheen`: above the base.
void addFrom(const uint reflector, const Lobes lobes, const vec3 sheen, inout Radiance radiance) {
    if (isBase(reflector)) {
        radiance.diffuse += lobes.diffuse;
        radiance.specular += lobes.specular;
        if (hasLayer(LAYER_SHEEN)) addFromSheen(sheen, radiance);
    }
    if (isCoat(reflector)) addFromCoat(lobes.specular, radiance);
    if (isBehind(reflector)) addFromBehind(lobes.diffuse, radiance);
}

void addIncident(const Shading shading, const Incident light, inout Radiance radiance) {
    uint i = 0u;
    [[unroll]] do {
        Reflector r = reflectorOf(shading, i);
        vec3 from_sheen = vec3(0.0);
        if (hasLayer(LAYER_SHEEN) && isBase(i))
            from_sheen = sheenReflected(shading.sheen, r.n, r.v, light.direction, light.irradiance);
        addFrom(i, lobesUnder(r.brdf, r.n, r.v, light), from_sheen, radiance);
    } while (++i < reflectorCount());
}

void addPoint(const Shading shading, const uint i, inout Radiance radiance) {
    addIncident(shading, fromPointLight(withEntryWeight(lightAt(i)), shading.surface.position), radiance);
}

void addSpot(const Shading shading, const uint i, inout Radiance radiance) {
    addIncident(shading, fromSpotLight(withEntryWeight(lightAt(i)), spotConeAt(i), shading.surface.position),
                radiance);
}

void addCasting(const Shading shading, Incident light, const uint index, const vec3 position,
                inout Radiance radiance) {
    float seen = visibilityOf(shading.surface, index, position);
    float light_here = dot(light.irradiance, vec3(0.2126, 0.7152, 0.0722));
    radiance.local_light += light_here;
    radiance.local_seen += light_here * seen;
    light.irradiance *= seen;
    addIncident(shading, light, radiance);
}

void addCastingPoint(const Shading shading, const uint i, const LocalCasters casters,
                     inout Radiance radiance) {
    Light light = withEntryWeight(lightAt(i));
    Incident incident = fromPointLight(light, shading.surface.position);
    addCasting(shading, incident, i - view.directional_light_count, light.position, radiance);
}

void addCastingSpot(const Shading shading, const uint i, const LocalCasters casters,
                    inout Radiance radiance) {
    Light light = withEntryWeight(lightAt(i));
    Incident incident = fromSpotLight(light, spotConeAt(i), shading.surface.position);
    addCasting(shading, incident, i - casters.spot_shift, light.position, radiance);
}

// Adds the shadow-casting lights of one type in entries [x, y): the first ones, with indices below `end`.
// Leaves the entries that contain others.
#define ADD_CASTERS(add, entries, end)                          \
    {                                                           \
        CasterIterator iterator = casterIterator(entries, end); \
        while (iterator.more) {                                 \
            add(shading, iterator.light, casters, radiance);    \
            advance(iterator);                                  \
            if (!iterator.more) break;                          \
        }                                                       \
        entries.x = iterator.position / feature_list_width;     \
    }

// Adds the lights of one type in entries [x, y). If this type casts shadows, skips shadow-casting lights:
// those with indices below `end`. Drivers unroll the loop over an entry, unless layers make its body long.
#define ADD_ENTRIES(add, entries, casting, end)                                       \
    {                                                                                 \
        uvec2 range = entries;                                                        \
        EACH(range) {                                                                 \
            uvec4 entry_lights = lightsOfEntry(range.x);                              \
            if (on(feature_local_shadows & casting))                                  \
                entry_lights = withoutCasters(entry_lights, end, casters.null_light); \
            uint k = 0u;                                                              \
            do {                                                                      \
                add(shading, entry_lights[k], radiance);                              \
            } while (++k < feature_list_width);                                       \
            NEXT(range);                                                              \
        }                                                                             \
    }

// Continues with the area lights of one kind. One loop per kind, because a loop body costs all the code in
// it, executed or not.
#define ADD_AREA(kind, name, cost)                                                         \
    if (on(feature_area_lights & AREA_##name))                                             \
        while (iterator.more && iterator.area_index < view.area_ends[kind]) {              \
            Light light = withEntryWeight(lightAt(iterator.light));                        \
            AreaLight shape = areaLightAt(iterator.area_index);                            \
            uint i = 0u;                                                                   \
            do {                                                                           \
                AreaLobes reflected =                                                      \
                    name##Lobes(viewOf(views, i), light, shape, shading.surface.position); \
                addFrom(i, reflected.lobes, reflected.sheen, radiance);                    \
            } while (++i < reflectorCount());                                              \
            advance(iterator);                                                             \
        }

// `emission`: dimmed by a clear coat.
Shading makeShading(const Surface s, inout vec3 emission) {
    vec3 v = viewVector(s.position);
    Brdf brdf = makeBrdf(s, v);
    if (on(feature_multiscatter)) brdf = compensated(brdf, s, specularAlbedo(brdf.alpha, brdf.n_dot_v));
    if (hasLayer(LAYER_IRIDESCENCE)) addFilm(brdf, s);
    Reflector coat;
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
    Reflector base = makeReflector(brdf, s.normal, v), behind = base;
    if (!hasLayer(LAYER_CLEARCOAT)) coat = base;
    if (hasLayer(LAYER_DIFFUSE_TRANSMISSION)) behind = makeBehind(brdf, s.normal, v);
    return Shading(s, v, base, coat, behind, sheen);
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
    float factor = environmentFactor() * s.occlusion;
    vec3 irradiance = environmentIrradiance(s.normal), received = irradiance * factor;
    vec3 from_base = fromBase(shading.base) * received, from_lobe, from_coat = vec3(0.0);
    // A lightmapped base takes its light from the lightmap instead.
    if (on(feature_lightmap)) from_base = s.lightmapped ? vec3(0.0) : from_base;
    uint i = 0u;
    do {
        vec3 reflected = lobeEnvironment(reflectorOf(shading, i), s.anisotropy, factor);
        if (isBase(i)) from_lobe = reflected;
        if (isCoat(i)) from_coat = reflected;
    } while (isCoat(++i));
    // Multiple scattering leaves the surface like Lambertian reflection.
    if (feature_multiscatter == MULTISCATTER_FDEZ) from_lobe += shading.base.brdf.between * PI * received;
    radiance.environment = from_base + from_lobe;
    vec3 from_sheen = vec3(0.0), from_behind = vec3(0.0);
    if (hasLayer(LAYER_SHEEN)) {
        from_sheen = shading.sheen.color * (shading.sheen.albedo * environmentFactor() * s.occlusion) *
                     irradiance;
        radiance.environment += from_sheen;
    }
    if (hasLayer(LAYER_CLEARCOAT)) radiance.environment += from_coat;
    if (hasLayer(LAYER_DIFFUSE_TRANSMISSION)) {
        from_behind = fromBase(shading.behind) * factor * environmentIrradiance(shading.behind.n);
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
    uvec2 range = directionalEntries();
    EACH(range) {
        Incident light = fromDirectionalLight(directionalAt(range.x));
        if (on(feature_shadows) && directionalOf(range.x) == castingLight())
            light.irradiance *= radiance.sun_visibility;
        addIncident(shading, light, radiance);
        NEXT(range);
    }
}

void addPunctualLights(const Shading shading, const PixelLights lights, inout Radiance radiance) {
    LocalCasters casters = LocalCasters(0u, 0u, 0u, 0u);
    if (on(feature_local_shadows)) casters = localCasters();
    if (on(feature_point_lights)) {
        uvec2 entries = batchEntries(lights, lights.entries.begin, lights.entries.point_end);
        if (on(feature_local_shadows & LOCAL_SHADOWS_POINTS))
            ADD_CASTERS(addCastingPoint, entries, casters.point_end)
        ADD_ENTRIES(addPoint, entries, LOCAL_SHADOWS_POINTS, casters.point_end)
    }
    if (on(feature_spot_lights)) {
        uvec2 entries = batchEntries(lights, lights.entries.point_end, lights.entries.spot_end);
        if (on(feature_local_shadows & LOCAL_SHADOWS_SPOTS))
            ADD_CASTERS(addCastingSpot, entries, casters.spot_end)
        ADD_ENTRIES(addSpot, entries, LOCAL_SHADOWS_SPOTS, casters.spot_end)
    }
}

// How area lights see each reflector of a material.
struct AreaViews {
    AreaView base, coat, behind;
};

AreaView viewOf(const AreaViews views, const uint reflector) {
    AreaView a = views.base;
    if (isCoat(reflector)) a = views.coat;
    if (isBehind(reflector)) a = views.behind;
    return a;
}

void addAreaLights(const Shading shading, const PixelLights lights, inout Radiance radiance) {
    AreaViews views;
    views.base = views.coat = views.behind = areaView(shading.base);
    if (hasLayer(LAYER_SHEEN)) views.base.woven = true, views.base.sheen = shading.sheen;
    if (hasLayer(LAYER_CLEARCOAT)) views.coat = areaView(shading.coat);
    if (hasLayer(LAYER_DIFFUSE_TRANSMISSION)) views.behind = areaView(shading.behind);
    AreaLightIterator iterator =
        areaLightIterator(batchEntries(lights, lights.entries.spot_end, lights.entries.end));
    AREA_KINDS(ADD_AREA)
}

void addAmbient(const Shading shading, inout Radiance radiance) {
    Surface s = shading.surface;
    if (on(feature_ambient) || on(feature_lightmap))
        radiance.ambient = s.occlusion * reflectedAmbient(shading.base, view.ambient, s.lightmap);
    // Batches hand on the parts of layers, but not the sum.
    bool once = feature_light_batch != BATCH_LATER;
    if (on(feature_ambient) && hasLayer(LAYER_SHEEN)) {
        vec3 reflected = shading.sheen.color * (shading.sheen.albedo * s.occlusion) * view.ambient;
        radiance.ambient += reflected;
        if (once) radiance.sheen += reflected;
    }
    if (on(feature_ambient) && hasLayer(LAYER_CLEARCOAT)) {
        vec3 reflected = s.occlusion * (shading.coat.lobe_fraction * view.ambient);
        radiance.ambient += reflected;
        if (once) radiance.clearcoat += reflected;
    }
    if (on(feature_ambient) && hasLayer(LAYER_DIFFUSE_TRANSMISSION)) {
        vec3 passed = s.occlusion * (fromBase(shading.behind) * view.ambient);
        radiance.ambient += passed;
        if (once) radiance.transmission += passed;
    }
}

bool shadesSuns() { return on(feature_directional_lights) && feature_light_batch != BATCH_LATER; }

// Sums over the pixel's lights, in the buffer's order. Occlusion dims ambient light and environments. Haze
// lies in front of the sum and only lit() applies it.
Radiance shade(const Surface s, const PixelLights lights, const float sun_visibility) {
    Radiance radiance = noRadiance();
    radiance.sun_visibility = sun_visibility;
    radiance.emission = s.emission;
    Shading shading = makeShading(s, radiance.emission);
    if (feature_light_batch == BATCH_LATER) readPartialSums(radiance);
    if (feature_object_lights > OBJECT_LIGHTS_LISTS && feature_light_batch != BATCH_LATER) {
        // The base reflects the draw's lights that are not shaded per pixel.
        vec3 reflected = shading.base.brdf.diffuse * shading.base.base_fraction * s.object_irradiance;
        radiance.diffuse = reflected;
    }
    if (on(feature_environment)) addEnvironment(shading, radiance);
    if (shadesSuns()) addDirectionalLights(shading, radiance);
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

// The sun's visibility comes first, while few values are live: a shadow map's filter needs more registers
// than anything after it. On RDNA 2 this order takes 80 instead of 128 (compare/bench/MEASURED.md).
Radiance shade(const Surface s, const PixelLights lights) {
    return shade(s, lights, shadesSuns() ? sunVisibility(s) : 1.0);
}

#endif
