// SPDX-License-Identifier: MIT
// The supported properties of glTF 2.0 and its extensions as tables: type, range and, for an index, the
// collection it refers to; for what animations may move, and for textures, their part of the scene. Source:
// Khronos, glTF 2.0 Specification, 2021, section 5, and the extensions' specifications.
#pragma once

#include "shared/contract/material.h"
#include "shared/scene/model/animated.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <string_view>

namespace diptych::gltf::schema {

using Part = AnimatedPart;

// ---- what a property may be --------------------------------------------------------------------------

enum class Kind {
    whole,           // from min to max
    number,          // from min to max
    flag,            // true or false
    text,            // one of `choices`; any text if empty
    name,            // any text; used only in messages and lists
    numbers,         // `min_count` to `max_count` numbers, each from min to max
    index,           // into collection `of`
    indices,         // array of indices into collection `of`
    names,           // array of strings
    attributes,      // an object whose values are indices into `of`
    attribute_sets,  // array of `attributes`
    object,          // an object with `properties`
    objects,         // array of `object`
    extensions,      // object with the members `properties`; others are removed but remembered
    extras,          // anything; only the member "diptych" of an object is kept, unchecked
};

struct Property {
    std::string_view key;
    Kind kind;
    bool required = false;
    double min = 0, max = 0;
    std::size_t min_count = 0, max_count = 0;
    // The collection that an index refers to; for objects, the word for one of them in messages.
    std::string_view of = {};
    std::string_view choices = {};  // separated by spaces
    std::span<const Property> properties = {};
    std::optional<AnimatedPart> part = {};  // what it sets; all may be animated
    std::size_t slot = gpu::SLOT_COUNT;     // SLOT_* of a material's texture
};

constexpr double any = std::numeric_limits<float>::max();  // all numbers become float
constexpr double maxInt = std::numeric_limits<int>::max();
constexpr double maxSize = 9007199254740992.0;  // 2^53: smaller integers are exact in double
constexpr std::size_t anyLength = std::numeric_limits<std::size_t>::max();

constexpr Property whole(std::string_view key, double min = 0, double max = maxInt) {
    return {.key = key, .kind = Kind::whole, .min = min, .max = max};
}
constexpr Property number(std::string_view key, double min = -any, double max = any) {
    return {.key = key, .kind = Kind::number, .min = min, .max = max};
}
constexpr Property numbers(std::string_view key, std::size_t min_count, std::size_t max_count) {
    return {.key = key,
            .kind = Kind::numbers,
            .min = -any,
            .max = any,
            .min_count = min_count,
            .max_count = max_count};
}
constexpr Property numbers(std::string_view key, std::size_t count) {
    return numbers(key, count, count);
}
constexpr Property flag(std::string_view key) {
    return {.key = key, .kind = Kind::flag};
}
constexpr Property text(std::string_view key, std::string_view choices = {}) {
    return {.key = key, .kind = Kind::text, .choices = choices};
}
constexpr Property name() {
    return {.key = "name", .kind = Kind::name};
}
constexpr Property index(std::string_view key, std::string_view of) {
    return {.key = key, .kind = Kind::index, .of = of};
}
constexpr Property indices(std::string_view key, std::string_view of) {
    return {.key = key, .kind = Kind::indices, .of = of};
}
constexpr Property names(std::string_view key) {
    return {.key = key, .kind = Kind::names};
}
constexpr Property attributes(std::string_view key, std::string_view of) {
    return {.key = key, .kind = Kind::attributes, .of = of};
}
constexpr Property object(std::string_view key, std::span<const Property> properties) {
    return {.key = key, .kind = Kind::object, .properties = properties};
}
constexpr Property objects(std::string_view key, std::string_view one, std::span<const Property> properties) {
    return {.key = key, .kind = Kind::objects, .of = one, .properties = properties};
}
constexpr Property extensions(std::span<const Property> properties) {
    return {.key = "extensions", .kind = Kind::extensions, .properties = properties};
}
constexpr Property extras() {
    return {.key = "extras", .kind = Kind::extras};
}
constexpr Property required(Property property) {
    property.required = true;
    return property;
}
constexpr Property animated(Property property, AnimatedPart part) {
    property.part = part;
    return property;
}
constexpr Property animated(std::string_view key, AnimatedPart part) {
    const std::size_t width = propertiesOf(part).width;
    return animated(width == 1 ? number(key) : numbers(key, width), part);
}
// ---- the schema: what is read of glTF 2.0 ------------------------------------------------------------

constexpr Property sparseIndices[] = {required(index("bufferView", "bufferViews")), whole("byteOffset"),
                                      required(whole("componentType"))};
constexpr Property sparseValues[] = {required(index("bufferView", "bufferViews")), whole("byteOffset")};
constexpr Property sparse[] = {required(whole("count")), required(object("indices", sparseIndices)),
                               required(object("values", sparseValues))};
constexpr Property accessor[] = {index("bufferView", "bufferViews"),
                                 whole("byteOffset", 0, maxSize),
                                 required(whole("componentType")),
                                 flag("normalized"),
                                 required(whole("count", 0, maxSize)),
                                 required(text("type", "SCALAR VEC2 VEC3 VEC4 MAT2 MAT3 MAT4")),
                                 object("sparse", sparse),
                                 name()};

constexpr Property meshopt[] = {required(index("buffer", "buffers")),
                                whole("byteOffset", 0, maxSize),
                                required(whole("byteLength", 0, maxSize)),
                                required(whole("byteStride", 1, 256)),
                                required(whole("count", 0, maxInt)),
                                required(text("mode", "ATTRIBUTES TRIANGLES INDICES")),
                                text("filter", "NONE OCTAHEDRAL QUATERNION EXPONENTIAL")};
constexpr Property meshoptFallback[] = {flag("fallback")};
constexpr Property viewExtensions[] = {object("EXT_meshopt_compression", meshopt)};
constexpr Property bufferExtensions[] = {object("EXT_meshopt_compression", meshoptFallback)};
constexpr Property bufferView[] = {required(index("buffer", "buffers")),
                                   whole("byteOffset", 0, maxSize),
                                   required(whole("byteLength", 0, maxSize)),
                                   whole("byteStride", 0, 252),
                                   name(),
                                   extensions(viewExtensions)};
constexpr Property buffer[] = {text("uri"), required(whole("byteLength", 0, maxSize)), name(),
                               extensions(bufferExtensions)};

constexpr Property image[] = {text("uri"), index("bufferView", "bufferViews"), text("mimeType"), name()};
constexpr Property sampler[] = {whole("magFilter"), whole("minFilter"), whole("wrapS"), whole("wrapT"),
                                name()};
constexpr Property webp[] = {index("source", "images")};
// Only the presence of unsupported image formats is kept.
constexpr Property textureExtensions[] = {object("KHR_texture_basisu", {}), object("EXT_texture_webp", webp),
                                          object("EXT_texture_avif", {})};
constexpr Property texture[] = {index("sampler", "samplers"), index("source", "images"), name(),
                                extensions(textureExtensions)};

constexpr Property textureTransform[] = {animated("offset", Part::texture_offset),
                                         animated("scale", Part::texture_scale),
                                         animated("rotation", Part::texture_rotation), whole("texCoord")};
constexpr Property infoExtensions[] = {object("KHR_texture_transform", textureTransform)};
constexpr Property textureInfo[] = {required(index("index", "textures")), whole("texCoord"),
                                    extensions(infoExtensions)};
constexpr Property map(std::string_view key, std::size_t slot,
                       std::span<const Property> properties = textureInfo) {
    Property property = object(key, properties);
    property.slot = slot;
    return property;
}
constexpr std::array<Property, 4> scaledInfo(std::string_view key, Part part) {
    return {textureInfo[0], textureInfo[1], animated(key, part), textureInfo[2]};
}
constexpr auto normalInfo = scaledInfo("scale", Part::normal_scale),
               occlusionInfo = scaledInfo("strength", Part::occlusion_strength),
               coatNormalInfo = scaledInfo("scale", Part::clearcoat_normal_scale);

// Materials are read in the order of these tables (material.cpp). A layer's first property is its weight: 0
// removes the layer.
constexpr Property metallicRoughness[] = {
    animated("baseColorFactor", Part::base_color), animated("metallicFactor", Part::metallic),
    animated("roughnessFactor", Part::roughness), map("baseColorTexture", gpu::SLOT_base_color),
    map("metallicRoughnessTexture", gpu::SLOT_metallic_roughness)};
constexpr Property specularGlossiness[] = {
    animated("diffuseFactor", Part::base_color), animated("specularFactor", Part::specular_f0),
    animated("glossinessFactor", Part::glossiness), map("diffuseTexture", gpu::SLOT_base_color),
    map("specularGlossinessTexture", gpu::SLOT_specular_color)};
constexpr Property emissiveStrength[] = {animated("emissiveStrength", Part::emissive_strength)};
constexpr Property ior[] = {animated("ior", Part::ior)};
constexpr Property specular[] = {
    animated("specularFactor", Part::specular), animated("specularColorFactor", Part::specular_color),
    map("specularTexture", gpu::SLOT_specular), map("specularColorTexture", gpu::SLOT_specular_color)};
constexpr Property transmission[] = {animated("transmissionFactor", Part::transmission),
                                     map("transmissionTexture", gpu::SLOT_transmission)};
constexpr Property clearcoat[] = {animated("clearcoatFactor", Part::clearcoat),
                                  animated("clearcoatRoughnessFactor", Part::clearcoat_roughness),
                                  map("clearcoatTexture", gpu::SLOT_clearcoat),
                                  map("clearcoatRoughnessTexture", gpu::SLOT_clearcoat_roughness),
                                  map("clearcoatNormalTexture", gpu::SLOT_clearcoat_normal, coatNormalInfo)};
constexpr Property anisotropy[] = {animated("anisotropyStrength", Part::anisotropy),
                                   animated("anisotropyRotation", Part::anisotropy_rotation),
                                   map("anisotropyTexture", gpu::SLOT_anisotropy)};
constexpr Property sheen[] = {
    animated("sheenColorFactor", Part::sheen_color), animated("sheenRoughnessFactor", Part::sheen_roughness),
    map("sheenColorTexture", gpu::SLOT_sheen_color), map("sheenRoughnessTexture", gpu::SLOT_sheen_roughness)};
constexpr Property iridescence[] = {animated("iridescenceFactor", Part::iridescence),
                                    animated("iridescenceIor", Part::iridescence_ior),
                                    animated("iridescenceThicknessMinimum", Part::iridescence_thickness_min),
                                    animated("iridescenceThicknessMaximum", Part::iridescence_thickness_max),
                                    map("iridescenceTexture", gpu::SLOT_iridescence),
                                    map("iridescenceThicknessTexture", gpu::SLOT_iridescence_thickness)};
constexpr Property volume[] = {animated("thicknessFactor", Part::thickness),
                               map("thicknessTexture", gpu::SLOT_thickness),
                               animated("attenuationColor", Part::attenuation_color),
                               animated("attenuationDistance", Part::attenuation_distance)};
constexpr Property dispersion[] = {animated("dispersion", Part::dispersion)};
constexpr Property diffuseTransmission[] = {
    animated("diffuseTransmissionFactor", Part::diffuse_transmission),
    animated("diffuseTransmissionColorFactor", Part::diffuse_transmission_color),
    map("diffuseTransmissionTexture", gpu::SLOT_diffuse_transmission),
    map("diffuseTransmissionColorTexture", gpu::SLOT_diffuse_transmission_color)};
constexpr Property materialExtensions[] = {object("KHR_materials_ior", ior),
                                           object("KHR_materials_specular", specular),
                                           object("KHR_materials_pbrSpecularGlossiness", specularGlossiness),
                                           object("KHR_materials_emissive_strength", emissiveStrength),
                                           object("KHR_materials_unlit", {}),
                                           object("KHR_materials_transmission", transmission),
                                           object("KHR_materials_clearcoat", clearcoat),
                                           object("KHR_materials_anisotropy", anisotropy),
                                           object("KHR_materials_sheen", sheen),
                                           object("KHR_materials_iridescence", iridescence),
                                           object("KHR_materials_volume", volume),
                                           object("KHR_materials_dispersion", dispersion),
                                           object("KHR_materials_diffuse_transmission", diffuseTransmission)};
static_assert(std::ranges::all_of(materialExtensions, [](const Property& extension) {
    return extension.properties.empty() || extension.properties.front().part;
}));
constexpr Property material[] = {name(),
                                 object("pbrMetallicRoughness", metallicRoughness),
                                 animated("alphaCutoff", Part::alpha_cutoff),
                                 map("normalTexture", gpu::SLOT_normal, normalInfo),
                                 map("occlusionTexture", gpu::SLOT_occlusion, occlusionInfo),
                                 map("emissiveTexture", gpu::SLOT_emissive),
                                 animated("emissiveFactor", Part::emissive),
                                 text("alphaMode", "OPAQUE MASK BLEND"),
                                 flag("doubleSided"),
                                 extensions(materialExtensions),
                                 extras()};

// Attribute values are attribute ids in the compressed stream.
constexpr Property draco[] = {required(index("bufferView", "bufferViews")),
                              required(attributes("attributes", {}))};
constexpr Property primitiveExtensions[] = {object("KHR_draco_mesh_compression", draco)};
constexpr Property primitive[] = {required(attributes("attributes", "accessors")),
                                  index("indices", "accessors"),
                                  index("material", "materials"),
                                  whole("mode", 0, 6),
                                  {.key = "targets", .kind = Kind::attribute_sets, .of = "accessors"},
                                  extensions(primitiveExtensions)};
constexpr Property mesh[] = {required(objects("primitives", "primitive", primitive)),
                             animated(numbers("weights", 0, anyLength), Part::mesh_weights), name()};

constexpr Property nodeLight[] = {index("light", "KHR_lights_punctual")};
constexpr Property instancing[] = {required(attributes("attributes", "accessors"))};
constexpr Property nodeExtensions[] = {object("EXT_mesh_gpu_instancing", instancing),
                                       object("KHR_lights_punctual", nodeLight)};
constexpr Property node[] = {index("camera", "cameras"),
                             indices("children", "nodes"),
                             index("skin", "skins"),
                             numbers("matrix", 16),
                             index("mesh", "meshes"),
                             animated("rotation", Part::rotation),
                             animated("scale", Part::scale),
                             animated("translation", Part::translation),
                             animated(numbers("weights", 0, anyLength), Part::weights),
                             name(),
                             extensions(nodeExtensions)};
constexpr Property scene[] = {indices("nodes", "nodes"), name(), extras()};
constexpr Property skin[] = {index("inverseBindMatrices", "accessors"), index("skeleton", "nodes"),
                             required(indices("joints", "nodes")), name()};

constexpr Property perspective[] = {
    animated("aspectRatio", Part::camera_aspect), required(animated("yfov", Part::camera_yfov)),
    animated("zfar", Part::camera_far), required(animated("znear", Part::camera_near))};
constexpr Property orthographic[] = {
    required(animated("xmag", Part::camera_xmag)), required(animated("ymag", Part::camera_ymag)),
    required(animated("zfar", Part::camera_far)), required(animated("znear", Part::camera_near))};
constexpr Property camera[] = {required(text("type", "perspective orthographic")),
                               object("perspective", perspective), object("orthographic", orthographic),
                               name()};

constexpr Property animationPointer[] = {required(text("pointer"))};
constexpr Property targetExtensions[] = {object("KHR_animation_pointer", animationPointer)};
constexpr Property channelTarget[] = {index("node", "nodes"),
                                      required(Property{.key = "path", .kind = Kind::name}),
                                      extensions(targetExtensions)};
constexpr Property channel[] = {required(whole("sampler")), required(object("target", channelTarget))};
constexpr Property animationSampler[] = {required(index("input", "accessors")),
                                         text("interpolation", "LINEAR STEP CUBICSPLINE"),
                                         required(index("output", "accessors"))};
constexpr Property animation[] = {required(objects("channels", "channel", channel)),
                                  required(objects("samplers", "sampler", animationSampler)), name()};

constexpr Property spot[] = {animated("innerConeAngle", Part::light_inner_cone),
                             animated("outerConeAngle", Part::light_outer_cone)};
constexpr Property light[] = {animated("color", Part::light_color),
                              animated("intensity", Part::light_intensity),
                              animated("range", Part::light_range),
                              required(text("type", "directional point spot")),
                              object("spot", spot),
                              name(),
                              extras()};
constexpr Property lights[] = {objects("lights", "light", light)};
constexpr Property documentExtensions[] = {object("KHR_lights_punctual", lights)};
constexpr Property asset[] = {text("version"), text("minVersion")};
constexpr Property document[] = {required(object("asset", asset)),
                                 names("extensionsUsed"),
                                 names("extensionsRequired"),
                                 index("scene", "scenes"),
                                 objects("accessors", "accessor", accessor),
                                 objects("animations", "animation", animation),
                                 objects("buffers", "buffer", buffer),
                                 objects("bufferViews", "bufferView", bufferView),
                                 objects("cameras", "camera", camera),
                                 objects("images", "image", image),
                                 objects("materials", "material", material),
                                 objects("meshes", "mesh", mesh),
                                 objects("nodes", "node", node),
                                 objects("samplers", "sampler", sampler),
                                 objects("scenes", "scene", scene),
                                 objects("skins", "skin", skin),
                                 objects("textures", "texture", texture),
                                 extensions(documentExtensions)};

// The word for an item of a collection in messages.
constexpr std::string_view itemOf(std::string_view collection) {
    for (const Property& p : document)
        if (p.key == collection) return p.of;
    return {};
}

}  // namespace diptych::gltf::schema
