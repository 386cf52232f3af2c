// SPDX-License-Identifier: MIT
// A scene on the CPU: no Vulkan, no shaders. World space is glTF's: right-handed, +Y up, metres, candela and
// lux, linear Rec.709.
#pragma once

#include "shared/contract/area_light.h"
#include "shared/contract/constants.h"
#include "shared/contract/material.h"
#include "shared/image/image.h"
#include "shared/scene/model/motion.h"

#include <glm/mat4x4.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <array>
#include <cstdint>
#include <limits>
#include <map>
#include <numbers>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

namespace diptych {

enum class Wrap { repeat, mirrored_repeat, clamp_to_edge };

struct Sampler {
    Wrap wrap_s = Wrap::repeat, wrap_t = Wrap::repeat;
    bool magnify_linear = true;
    bool minify_linear = true;
    bool mipmaps = true;
    bool mipmaps_linear = true;  // interpolates between two levels
    bool operator==(const Sampler&) const = default;
};

// Level 0, RGBA, row 0 on top: 8 or 16 bits per component, sRGB or linear depending on the slot, or linear
// floats, finite and at least 0.
struct TextureImage {
    std::string name;
    int width = 0, height = 0;
    std::vector<std::uint8_t> rgba;  // exactly one of the three arrays is filled
    std::vector<std::uint16_t> rgba16{};
    std::vector<float> rgba32{};
    float largest = 1;  // upper bound of the colour components; exact for floats

    bool deep() const { return !rgba16.empty() || !rgba32.empty(); }
    std::size_t components() const { return rgba.size() + rgba16.size() + rgba32.size(); }
};

struct Texture {
    int image = -1;  // into Scene::images
    Sampler sampler;
};

// A texture slot of a material: texture, UV set, and KHR_texture_transform as a 2x3 matrix:
// uv' = (dot(u.xy, uv) + u.z, dot(v.xy, uv) + v.z).
struct TextureSlot {
    int texture = -1;  // into Scene::textures; -1: none
    int texcoord = 0;  // 0 or 1
    glm::dvec3 u{1, 0, 0}, v{0, 1, 0};
    bool operator==(const TextureSlot&) const = default;
};

// KHR_texture_transform of a slot, split into the parts that animations replace: see setTransform() in
// animated.h.
struct TextureTransform {
    glm::dvec2 offset{0, 0}, scale{1, 1};
    double rotation = 0;  // rad
};

enum class AlphaMode { opaque, mask, blend };

struct Material {
    using vec3 = glm::vec3;
    using vec4 = glm::vec4;

    std::string name;
#define DIPTYCH_FACTOR(type, name, initially, ...) type name{initially};
    MATERIAL_FACTORS(DIPTYCH_FACTOR)
#undef DIPTYCH_FACTOR
    vec3 emissive{0};               // W/(sr m^2), includes KHR_materials_emissive_strength
    vec3 specular_color{1};         // KHR_materials_specular
    float anisotropy_rotation = 0;  // rad, tangent to bitangent
    AlphaMode alpha_mode = AlphaMode::opaque;
    bool double_sided = false;
    bool unlit = false;  // KHR_materials_unlit: uses only base colour, alpha and double_sided
    // KHR_materials_pbrSpecularGlossiness: base_color is diffuse, specular_color F0 (ior is 0, metallic 0),
    // roughness 1 - glossiness; see contract/material.h.
    bool specular_glossiness = false;
#define DIPTYCH_TEXTURE(number, name, ...) TextureSlot name##_texture;
    MATERIAL_SLOTS(DIPTYCH_TEXTURE)
#undef DIPTYCH_TEXTURE
};

// Values that Material stores combined, split into the parts that animations replace.
struct MaterialParts {
    glm::dvec3 emissive{0, 0, 0};
    double emissive_strength = 1;
    std::array<TextureTransform, gpu::SLOT_COUNT> transforms;  // by SLOT_*
};

// Whether it transmits light without diffusion: KHR_materials_transmission.
inline bool transmits(const Material& m) {
    return m.transmission > 0 && !m.unlit;
}

// Whether the surface behind it remains visible.
inline bool blends(const Material& m) {
    return m.alpha_mode == AlphaMode::blend || transmits(m);
}

// Whether a factor is not 0.
template <auto factor>
bool hasFactor(const Material& m) {
    return m.*factor != std::remove_cvref_t<decltype(m.*factor)>(0);
}

// A sum of LAYER_* of contract/material.h.
inline std::uint32_t layersOf(const Material& m) {
    std::uint32_t layers = gpu::LAYER_BASE;
#define DIPTYCH_LAYER(name, bit, factor) \
    if (!m.unlit && hasFactor<&Material::factor>(m)) layers |= gpu::LAYER_##name;
    MATERIAL_LAYERS(DIPTYCH_LAYER)
#undef DIPTYCH_LAYER
    return layers;
}

// Triangles, front faces counter-clockwise. Every attribute array is empty or as long as positions. After
// loading, normals and tangents are never empty.
struct Primitive {
    std::vector<glm::vec3> positions;  // object, m
    std::vector<glm::vec3> normals;    // unit
    std::vector<glm::vec4> tangents;   // w: sign of bitangent = w * cross(normal, tangent)
    std::vector<glm::vec2> texcoords[2];
    std::vector<glm::vec4> colors;       // linear Rec.709, alpha
    std::vector<JointSet> joint_sets;    // empty if not skinned
    std::vector<MorphTarget> targets;    // the same count in every primitive of a mesh
    std::vector<std::uint32_t> indices;  // three per triangle
    int material = 0;                    // into Scene::materials, always valid
    bool flat = false;                   // face normals, recomputed from posed positions
    bool tangents_made = false;          // by makeTangents, because the file has no usable ones
    // Computed once the vertices are final. If empty, it is recomputed for each pose, which costs as much
    // as posing.
    DeformationBounds deformation_bounds{};
    TangentGroups tangent_groups{};  // empty unless animation changes tangents that makeTangents computed
};

struct Mesh {
    std::string name;
    std::vector<Primitive> primitives;
    std::vector<float> weights = {};  // default weights, one per morph target
};

struct Node {
    std::string name;
    int parent = -1;  // into Scene::nodes; parents may come later
    glm::dmat4 parent_from_node{1.0};
    int mesh = -1;
    int skin = -1;       // into Scene::skins; applies to the primitives with joint sets
    int transform = -1;  // into Scene::transforms, the parts of parent_from_node; -1 if not animated
    int weights = -1;    // into Scene::weights, which replace the mesh's; -1: uses the mesh's
    int copies = -1;     // into Scene::copies, the mesh's instances; -1: one, at the node
};

// The kinds of KHR_lights_punctual, then the area lights.
#define DIPTYCH_KIND(number, name, cost) name,
enum class LightKind { directional, point, spot, AREA_KINDS(DIPTYCH_KIND) };
#undef DIPTYCH_KIND
#define DIPTYCH_KIND(number, name, cost) LightKind::name,
inline constexpr std::array areaKinds{AREA_KINDS(DIPTYCH_KIND)};
#undef DIPTYCH_KIND

constexpr std::size_t indexOf(LightKind kind) {
    return static_cast<std::size_t>(kind);
}
constexpr bool isArea(LightKind kind) {
    return indexOf(kind) >= indexOf(areaKinds.front());
}
// Emits outwards, and its axis is free. Other area lights are flat and emit along their direction.
constexpr bool isClosed(LightKind kind) {
    return kind == LightKind::tube;
}

// Overrides the rank of a light in --assign per_object; other assignments ignore it.
enum class Importance { automatic, important, not_important };

// A light of KHR_lights_punctual or an area light: a rectangle or disc, one-sided or two-sided, or a tube
// (a closed cylinder). All points of an area light emit the same radiance in all directions (Lambert).
// Area lights cast no shadows and are invisible. A light shines along -Z of its node, and its axis is the
// node's +X. A light without a node is given in world space.
struct Light {
    std::string name;
    LightKind kind = LightKind::point;
    glm::vec3 color{1, 1, 1};  // linear Rec.709
    float intensity = 1;       // directional: lux; point, spot: candela; area: nits
    // m, no light beyond; measured from the centre of an area light
    float range = std::numeric_limits<float>::infinity();
    float inner_cone = 0;            // rad, from the axis
    float outer_cone = gpu::PI / 4;  // rad
    float angle = 0;                 // directional: angular diameter, rad
    float width = 1, height = 1;     // rect: along the axis, and perpendicular to it; m
    float radius = 0.5f;             // disc, tube; m
    float length = 1;                // tube: along the axis; m
    bool two_sided = false;          // rect, disc
    Importance importance = Importance::automatic;
    bool shadow = false;  // point, spot: wants to cast shadows
    int node = -1;
    glm::dvec3 position{0, 0, 0};    // area: the centre
    glm::dvec3 direction{0, 0, -1};  // unit, in which it shines; ignored for tubes
    glm::dvec3 axis{1, 0, 0};        // unit; rect: perpendicular to the direction
    int source = -1;                 // index in KHR_lights_punctual, which animations use
};

// `intensity` of the light's kind as the one from afar in the direction of the maximum, W/sr.
inline double intensityFromAfar(const Light& light, double intensity) {
    const double radius = double{light.radius};
    if (light.kind == LightKind::rect) return intensity * double{light.width} * double{light.height};
    if (light.kind == LightKind::disc) return intensity * std::numbers::pi * radius * radius;
    if (light.kind == LightKind::tube) return intensity * 2 * radius * double{light.length};
    return intensity;
}

// Light from all directions, as a lat-long image. The centre of column x has the azimuth 2 pi (x + 0.5) /
// width - pi, which is 0 at -Z and positive towards +X. The centre of row y lies at the angle pi (y + 0.5)
// / height from +Y. Bilinear between pixel centres, also across the seam.
struct Environment {
    std::string name;  // file name
    Image radiance;    // width x height x 3, linear Rec.709, W/(sr m^2), >= 0 and finite
};

// Looks along -Z of its node; +Y is up.
struct Camera {
    std::string name;       // the camera's; if it has none, the node's
    std::string node_name;  // as in the file
    bool orthographic = false;
    double yfov = glm::radians(60.0);  // vertical
    double ymag = 1;                   // orthographic: half the height, m
    // Perspective: width over height of the camera's frame; 0: the image's.
    double aspect = 0;
    double xmag = 0;    // orthographic: half the width, m; 0: given by the image's aspect
    double near = 0.1;  // m
    double far = std::numeric_limits<double>::infinity();
    int node = -1;
    glm::dmat4 world_from_camera{1.0};  // used if `node` is -1
    int source = -1;                    // index in the file, which animations use
};

struct Scene {
    std::string name;  // as given by the user
    std::vector<Node> nodes;
    std::vector<Mesh> meshes;
    std::vector<Material> materials;
    std::vector<std::string> variants;            // names of KHR_materials_variants; may be empty
    int variant = -1;                             // the one drawn; -1: primitives' own materials
    std::map<int, MaterialParts> material_parts;  // materials that animations change, by index
    std::vector<Texture> textures;
    std::vector<TextureImage> images;
    std::vector<Light> lights;
    std::optional<Environment> environment;
    std::vector<Camera> cameras;
    std::vector<Transform> transforms;            // of animated nodes
    std::vector<std::vector<float>> weights;      // morph target weights of nodes that have their own
    std::vector<std::vector<glm::dmat4>> copies;  // EXT_mesh_gpu_instancing: node from mesh; may be empty
    std::vector<Skin> skins;                      // only skins of drawn meshes
    std::vector<Animation> animations;            // as in the file; empty ones do not affect this scene
    glm::vec3 background{0, 0, 0};                // colour of uncovered pixels in images; channels have 0
    std::vector<std::string> notes;               // deviations from the file, one line each
};

// Geometry beyond this, in object or world space, is not drawn: shaders sum squared coordinates in
// float32, which ends at 3.4e38.
inline constexpr double maxCoordinate = 1e18;  // m

}  // namespace diptych
