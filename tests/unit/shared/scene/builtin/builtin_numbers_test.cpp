// SPDX-License-Identifier: MIT
// Every built-in scene has the numbers that kept baselines and documented measurements were made of.
#include "shared/scene/model/material_slots.h"
#include "tests/unit/shared/scene/builtin/builtin_scenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <type_traits>

namespace diptych {
namespace {

// FNV-1a over words. Hashes ten bits of each real number: the last bits depend on the machine's sine. Numbers
// below 1e-6 count as 0.
class Fingerprint {
public:
    std::uint32_t hash = 2166136261u;

    template <class... T>
    void add(const T&... values) {
        (one(values), ...);
    }

private:
    template <class T>
    void one(const T& value) {
        if constexpr (std::is_integral_v<T> || std::is_enum_v<T>) {
            hash = (hash ^ static_cast<std::uint32_t>(value)) * 16777619u;
        } else if constexpr (std::is_floating_point_v<T>) {
            int exponent = 0;
            const double mantissa = std::frexp(std::abs(value) < T(1e-6) ? 0.0 : double{value}, &exponent);
            // Codes do not end at numbers such as 0.5 and 0.75.
            one(std::isfinite(mantissa) ? static_cast<int>(std::floor(mantissa * 1024 + 0.37)) : -1);
            one(std::isfinite(mantissa) ? exponent : 0);
        } else if constexpr (requires { value.size(); }) {
            one(value.size());
            for (const auto& each : value) one(each);
        } else {
            for (int i = 0; i < T::length(); ++i) one(value[i]);
        }
    }
};

void add(Fingerprint& f, const Material& m) {
    f.add(m.base_color, m.metallic, m.roughness, m.emissive, m.normal_scale, m.occlusion_strength, m.ior,
          m.specular, m.specular_color, m.lightmap_intensity, m.transmission, m.thickness,
          m.attenuation_distance, m.attenuation_color, m.dispersion, m.diffuse_transmission,
          m.diffuse_transmission_color, m.clearcoat, m.clearcoat_roughness, m.clearcoat_normal_scale,
          m.anisotropy, m.anisotropy_rotation, m.sheen_color, m.sheen_roughness, m.iridescence,
          m.iridescence_ior, m.iridescence_thickness_min, m.iridescence_thickness_max, m.alpha_mode,
          m.alpha_cutoff, m.double_sided, m.unlit, m.specular_glossiness);
    for (const MaterialSlot& slot : materialSlots) {
        const TextureSlot& s = m.*slot.texture;
        f.add(s.texture, s.texcoord, s.u, s.v);
    }
}

void add(Fingerprint& f, const Primitive& p) {
    f.add(p.positions, p.normals, p.tangents, p.texcoords[0], p.texcoords[1], p.colors, p.indices, p.material,
          p.flat);
    for (const JointSet& set : p.joint_sets) f.add(set.joints, set.weights);
    for (const MorphTarget& target : p.targets)
        f.add(target.positions, target.normals, target.tangents, target.texcoords[0], target.texcoords[1],
              target.colors);
}

void add(Fingerprint& f, const Animation& animation) {
    for (const Keyframes& k : animation.keyframes) f.add(k.interpolation, k.times, k.values, k.width);
    for (const AnimationChannel& c : animation.channels)
        f.add(c.node, c.keyframes, c.part, c.object, c.element);
}

std::uint32_t fingerprint(const Scene& scene) {
    Fingerprint f;
    for (const Node& n : scene.nodes)
        f.add(n.parent, n.parent_from_node, n.mesh, n.skin, n.transform, n.weights, n.copies);
    for (const Mesh& mesh : scene.meshes) {
        f.add(mesh.weights);
        for (const Primitive& p : mesh.primitives) add(f, p);
    }
    for (const Material& m : scene.materials) add(f, m);
    for (const Texture& t : scene.textures)
        f.add(t.image, t.sampler.wrap_s, t.sampler.wrap_t, t.sampler.magnify_linear, t.sampler.minify_linear,
              t.sampler.mipmaps, t.sampler.mipmaps_linear);
    for (const TextureImage& i : scene.images) f.add(i.width, i.height, i.rgba, i.rgba16, i.rgba32);
    for (const Light& l : scene.lights)
        f.add(l.kind, l.color, l.intensity, l.range, l.inner_cone, l.outer_cone, l.angle, l.width, l.height,
              l.radius, l.length, l.two_sided, l.importance, l.shadow, l.node, l.position, l.direction,
              l.axis);
    for (const Camera& c : scene.cameras)
        f.add(c.orthographic, c.yfov, c.ymag, c.aspect, c.xmag, c.near, c.far, c.node, c.world_from_camera);
    for (const Transform& t : scene.transforms) f.add(t.translation, t.rotation, t.scale);
    for (const Skin& s : scene.skins) f.add(s.joints, s.joint_from_mesh);
    for (const Animation& a : scene.animations) add(f, a);
    if (scene.environment) f.add(scene.environment->radiance.data);
    for (const auto& [material, parts] : scene.material_parts) {
        f.add(material, parts.emissive, parts.emissive_strength);
        for (const TextureTransform& t : parts.transforms) f.add(t.offset, t.scale, t.rotation);
    }
    f.add(scene.weights, scene.copies, scene.background);
    return f.hash;
}

TEST(Builtin, NumbersAreThoseThatBaselinesWereMadeOf) {
    const std::map<std::string, std::uint32_t> known{
        {"gallery", 3476659538u},       {"spheres", 2977517524u},       {"furnace", 518684939u},
        {"normals", 2902298630u},       {"emission", 681557638u},       {"dark_albedo", 309866446u},
        {"dielectrics", 2187645428u},   {"layers", 650620092u},         {"transmission", 1658584684u},
        {"cutout", 2971036713u},        {"occlusion", 1329570324u},     {"many_materials", 46351210u},
        {"vertex_colors", 3882840003u}, {"unlit_materials", 25655298u}, {"sixteen_bits", 1361613135u},
        {"lightmaps", 3799991359u},     {"coplanar", 3738793445u},      {"deep", 1726884360u},
        {"glass", 4293212597u},         {"crossed", 685708461u},        {"mirrored", 1144660547u},
        {"stretched", 1582553920u},     {"far_away", 1438407943u},      {"ortho", 2446590939u},
        {"triangle", 1737515066u},      {"empty", 1309757157u},         {"background", 662143898u},
        {"range_edge", 315821471u},     {"calibration", 3381496432u},   {"suns", 1757800087u},
        {"points", 1569577319u},        {"spots", 2244738307u},         {"areas", 674039729u},
        {"tangents", 3687582923u},      {"motion", 976141544u},         {"unlit", 1758236040u},
        {"array", 829286550u},          {"covered", 690928902u}};
    for (const BuiltinName& builtin : builtinNames()) {
        const auto found = known.find(builtin.name);
        EXPECT_EQ(fingerprint(builtinScene(builtin.name)), found == known.end() ? 0 : found->second)
            << "builtin:" << builtin.name
            << " is new or has changed: its baselines are worthless, and figures in the documentation may be "
               "wrong";
    }
    EXPECT_EQ(known.size(), builtinNames().size());
}

}  // namespace
}  // namespace diptych
