// SPDX-License-Identifier: MIT
// A scene as the CPU sees it: no Vulkan, no shaders. World space is glTF's: right-handed, +Y up, metres,
// candela and lux, linear Rec.709.
#pragma once

#include "shared/contract/constants.h"
#include "shared/image/image.h"
#include "shared/scene/model/motion.h"

#include <glm/mat4x4.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace diptych {

enum class Wrap { repeat, mirrored_repeat, clamp_to_edge };

struct Sampler {
    Wrap wrap_s = Wrap::repeat, wrap_t = Wrap::repeat;
    bool magnify_linear = true;
    bool minify_linear = true;
    bool mipmaps = true;
    bool mipmaps_linear = true;  // between two levels
    bool operator==(const Sampler&) const = default;
};

// Level 0, RGBA, row 0 on top: 8 or 16 bits a component, which the slot that reads it takes for sRGB or
// linear, or linear floats, finite and at least 0.
struct TextureImage {
    std::string name;
    int width = 0, height = 0;
    std::vector<std::uint8_t> rgba;  // one of the three is filled
    std::vector<std::uint16_t> rgba16{};
    std::vector<float> rgba32{};
    float largest = 1;  // colour component that there may be; of floats that there is

    bool deep() const { return !rgba16.empty() || !rgba32.empty(); }
    std::size_t components() const { return rgba.size() + rgba16.size() + rgba32.size(); }
};

struct Texture {
    int image = -1;  // into Scene::images
    Sampler sampler;
};

// A material's slot: which texture, which UV set, and KHR_texture_transform as a 2x3 matrix:
// uv' = (dot(u.xy, uv) + u.z, dot(v.xy, uv) + v.z).
struct TextureSlot {
    int texture = -1;  // into Scene::textures; -1: none
    int texcoord = 0;  // 0 or 1
    glm::dvec3 u{1, 0, 0}, v{0, 1, 0};
};

enum class AlphaMode { opaque, mask, blend };

struct Material {
    std::string name;
    glm::vec4 base_color{1, 1, 1, 1};  // linear Rec.709
    float metallic = 1, roughness = 1;
    glm::vec3 emissive{0, 0, 0};  // W/(sr m^2): factor x KHR_materials_emissive_strength
    float normal_scale = 1, occlusion_strength = 1;
    float ior = 1.5f;    // KHR_materials_ior; 0: reflects everything
    float specular = 1;  // KHR_materials_specular
    glm::vec3 specular_color{1, 1, 1};
    float lightmap_intensity = 1;  // what the lightmap is multiplied by; see contract/material.h
    AlphaMode alpha_mode = AlphaMode::opaque;
    float alpha_cutoff = 0.5f;
    bool double_sided = false;
    bool unlit = false;  // KHR_materials_unlit: base colour, alpha and double_sided count, nothing else
    // In the order of SLOT_* of contract/material.h.
    TextureSlot base_color_texture, metallic_roughness_texture, normal_texture, occlusion_texture,
        emissive_texture, specular_texture, specular_color_texture, lightmap_texture;
};

// Triangles, front faces counter-clockwise. Every attribute array is empty or as long as positions, but
// normals and tangents: they are always there when a scene has been loaded.
struct Primitive {
    std::vector<glm::vec3> positions;  // object, m
    std::vector<glm::vec3> normals;    // unit
    std::vector<glm::vec4> tangents;   // w: the bitangent's sign, bitangent = w * cross(normal, tangent)
    std::vector<glm::vec2> texcoords[2];
    std::vector<glm::vec4> colors;       // linear Rec.709, alpha
    std::vector<JointSet> joint_sets;    // none where no skin moves it
    std::vector<MorphTarget> targets;    // as many in every primitive of a mesh
    std::vector<std::uint32_t> indices;  // three a triangle
    int material = 0;                    // into Scene::materials, always valid
    bool flat = false;  // the normals are the triangles' own: they follow from the positions, posed or not
    bool tangents_made = false;  // by makeTangents: the file has none to use
};

struct Mesh {
    std::string name;
    std::vector<Primitive> primitives;
    std::vector<float> weights = {};  // of its morph targets, one each, at rest
};

struct Node {
    std::string name;
    int parent = -1;  // into Scene::nodes; parents need not come first
    glm::dmat4 parent_from_node{1.0};
    int mesh = -1;
    int skin = -1;       // into Scene::skins; moves those primitives of the mesh that have joint sets
    int transform = -1;  // into Scene::transforms: parent_from_node in parts, where an animation moves it
    int weights = -1;    // into Scene::weights: in place of its mesh's
};

enum class LightKind { directional, point, spot, rect, disc, tube };

// A mark that overrides how bright --assign per_object finds a light; other assignments know no difference.
enum class Importance { automatic, important, not_important };

constexpr bool isArea(LightKind kind) {
    return kind == LightKind::rect || kind == LightKind::disc || kind == LightKind::tube;
}

// KHR_lights_punctual, and surfaces that shine: a rectangle and a disc, from one side or both, and a closed
// cylinder, the tube. Every point of these sends the same radiance into every direction (Lambert); they throw
// no shadow and are not seen themselves. Shines along -Z of its node, +X of the node is its axis; without a
// node everything is world.
struct Light {
    std::string name;
    LightKind kind = LightKind::point;
    glm::vec3 color{1, 1, 1};  // linear Rec.709
    float intensity = 1;       // directional: lux; point, spot: candela; area: nits
    float range = std::numeric_limits<float>::infinity();  // m; of an area light from its centre
    float inner_cone = 0;                                  // rad, from the axis
    float outer_cone = gpu::PI / 4;                        // rad
    float angle = 0;                                       // directional: the diameter of its disc, rad
    float width = 1, height = 1;                           // rect: along the axis, and across it; m
    float radius = 0.5f;                                   // disc, tube; m
    float length = 1;                                      // tube: along the axis; m
    bool two_sided = false;                                // rect, disc
    Importance importance = Importance::automatic;
    int node = -1;
    glm::dvec3 position{0, 0, 0};    // area: of its centre
    glm::dvec3 direction{0, 0, -1};  // unit, in which it shines; a tube's counts for nothing
    glm::dvec3 axis{1, 0, 0};        // unit; rect: at right angles to the direction
};

// What shines from everywhere, as a picture of all directions: column x + 0.5 of `width` looks to the azimuth
// 2 pi (x + 0.5) / width - pi, which is 0 at -Z, positive towards +X; row y + 0.5 of `height` to pi (y + 0.5)
// / height from +Y. Between the pixels' centres it is bilinear, across the seam too.
struct Environment {
    std::string name;  // the file
    Image radiance;    // width x height x 3, linear Rec.709, W/(sr m^2), >= 0 and finite
};

// Looks along -Z of its node, +Y up.
struct Camera {
    std::string name;
    bool orthographic = false;
    double yfov = glm::radians(60.0);  // vertical
    double ymag = 1;                   // orthographic: half the height, m
    double near = 0.1;                 // m
    double far = std::numeric_limits<double>::infinity();
    int node = -1;
    glm::dmat4 world_from_camera{1.0};  // without a node
};

struct Scene {
    std::string name;  // as the user wrote it
    std::vector<Node> nodes;
    std::vector<Mesh> meshes;
    std::vector<Material> materials;
    std::vector<Texture> textures;
    std::vector<TextureImage> images;
    std::vector<Light> lights;
    std::optional<Environment> environment;
    std::vector<Camera> cameras;
    std::vector<Transform> transforms;        // of the nodes that an animation moves
    std::vector<std::vector<float>> weights;  // of morph targets, of the nodes that have their own
    std::vector<Skin> skins;                  // those that something is drawn with
    std::vector<Animation> animations;        // what of them moves a node of this scene
    glm::vec3 background{0, 0, 0};            // what pictures show where nothing is; channels hold 0 there
    std::vector<std::string> notes;           // what was read otherwise than the file says
};

// What lies further out, in an object or in the world, is not drawn: shaders square coordinates and add the
// squares in float32, which ends at 3.4e38.
inline constexpr double maxCoordinate = 1e18;  // m

}  // namespace diptych
