// SPDX-License-Identifier: MIT
// Every built-in scene has the numbers that kept baselines and documented figures were made of.
#include "shared/scene/builtin/builtin.h"
#include "shared/scene/model/material_slots.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <type_traits>

namespace diptych {
namespace {

// FNV-1a over words. Of real numbers it takes 16 bits, because the last ones depend on the machine's sines;
// less than 1e-6 is rounding.
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
            // Not in the middle between two codes, where numbers such as 1/3 + 1/6 are.
            one(std::isfinite(mantissa) ? static_cast<int>(std::floor(mantissa * 65536 + 0.37)) : 1);
            one(exponent);
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
          m.iridescence_ior, m.iridescence_thickness_least, m.iridescence_thickness_most, m.alpha_mode,
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
    for (const MorphTarget& target : p.targets) f.add(target.positions, target.normals, target.tangents);
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
        f.add(c.orthographic, c.yfov, c.ymag, c.near, c.far, c.node, c.world_from_camera);
    for (const Transform& t : scene.transforms) f.add(t.translation, t.rotation, t.scale);
    for (const Skin& s : scene.skins) f.add(s.joints, s.joint_from_mesh);
    for (const Animation& a : scene.animations) add(f, a);
    f.add(scene.weights, scene.copies, scene.background);
    return f.hash;
}

TEST(BuiltinNumbers, AreThoseThatBaselinesWereMadeOf) {
    const std::map<std::string, std::uint32_t> known{
        {"gallery", 3594262501u},       {"spheres", 951705438u},         {"furnace", 1690843250u},
        {"normals", 1984775326u},       {"emission", 862485063u},        {"dark_albedo", 1871208728u},
        {"dielectrics", 920120306u},    {"layers", 4118111470u},         {"transmission", 1561193450u},
        {"cutout", 2607619592u},        {"occlusion", 3944142522u},      {"many_materials", 3408503640u},
        {"vertex_colors", 3014156583u}, {"unlit_materials", 551628459u}, {"sixteen_bits", 3690276638u},
        {"lightmaps", 3139713543u},     {"coplanar", 3004123844u},       {"deep", 1386864426u},
        {"glass", 128725558u},          {"crossed", 517973138u},         {"mirrored", 3284003504u},
        {"stretched", 4221914109u},     {"far_away", 2932235147u},       {"ortho", 4135905230u},
        {"triangle", 1058540007u},      {"empty", 107508211u},           {"background", 3423412168u},
        {"range_edge", 1445282587u},    {"calibration", 1604315748u},    {"suns", 2587272001u},
        {"points", 333294928u},         {"spots", 1708197251u},          {"areas", 633379791u},
        {"tangents", 3267448886u},      {"motion", 2781838969u},         {"unlit", 4144755951u},
        {"array", 990976726u},          {"covered", 1236952465u}};
    for (const BuiltinName& builtin : builtinNames()) {
        const auto found = known.find(builtin.name);
        EXPECT_EQ(fingerprint(makeBuiltin(builtin.name)), found == known.end() ? 0 : found->second)
            << "builtin:" << builtin.name
            << " has changed: baselines of it are worthless, and figures in the documentation may be wrong";
    }
}

}  // namespace
}  // namespace diptych
