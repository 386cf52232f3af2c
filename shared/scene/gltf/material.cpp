// SPDX-License-Identifier: MIT
#include "shared/scene/gltf/material.h"

#include "shared/scene/gltf/note_list.h"
#include "shared/scene/gltf/texture.h"
#include "shared/scene/gltf/transmission_notes.h"
#include "shared/scene/gltf/value.h"
#include "shared/scene/model/animated.h"
#include "shared/scene/model/material_slots.h"
#include "shared/text/fail.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <set>
#include <stdexcept>
#include <string_view>

namespace diptych::gltf {

namespace {

// ---- materials ---------------------------------------------------------------------------------------

class MaterialReader {
public:
    // `faults`: by texture; empty if it is valid.
    MaterialReader(const tinygltf::Model& model, const MaterialExtras& extras, Scene& scene,
                   const std::vector<std::string>& faults, std::size_t index)
        : model_(model),
          file_(model.materials[index]),
          scene_(scene),
          faults_(faults),
          lightmap_(extras.lightmaps.contains(index) ? &extras.lightmaps.at(index) : nullptr),
          who_(fmt::format("material {}", index)) {}

    Material read() {
        const bool isUnlit = extension(file_.extensions, "KHR_materials_unlit");
        const tinygltf::Value* glossy =
            isUnlit ? nullptr : extension(file_.extensions, "KHR_materials_pbrSpecularGlossiness");
        Material m;
        m.name = file_.name;
        if (glossy)
            readSpecularGlossiness(m, *glossy);
        else
            readMetallicRoughness(m, isUnlit);
        m.normal_scale = within("normalTexture.scale", file_.normalTexture.scale, -maxFactor, maxFactor);
        m.occlusion_strength = within("occlusionTexture.strength", file_.occlusionTexture.strength, 0, 1);
        // Above 1, everything is cut out.
        m.alpha_cutoff = within("alphaCutoff", file_.alphaCutoff, 0, maxFactor);
        m.alpha_mode = alphaMode();
        m.double_sided = file_.doubleSided;
        if (isUnlit) return unlit(m);
        m.normal_texture = slot("normalTexture", file_.normalTexture);
        m.occlusion_texture = slot("occlusionTexture", file_.occlusionTexture);
        m.emissive_texture = slot("emissiveTexture", file_.emissiveTexture);
        readEmission(m);
        if (!glossy) {
            readSpecular(m);
            readTransmission(m);
            readClearcoat(m);
            readAnisotropy(m);
            readSheen(m);
            readIridescence(m);
            readVolume(m);
            readDiffuseTransmission(m);
        }
        readLightmap(m);
        return m;
    }

    // Valid after read(): the parts of combined values.
    const MaterialParts& parts() const { return parts_; }

private:
    const tinygltf::Model& model_;
    const tinygltf::Material& file_;
    Scene& scene_;
    const std::vector<std::string>& faults_;
    const MaterialExtras::Lightmap* lightmap_;  // nullptr: the material has none
    std::string who_;
    MaterialParts parts_;

    static constexpr const char* lightmapName = "extras: diptych: lightmap";

    // SLOT_* of a texture's name.
    static std::size_t slotNumber(std::string_view name) {
        if (name == "diffuseTexture") return gpu::SLOT_base_color;
        if (name == "specularGlossinessTexture") return gpu::SLOT_specular_color;
        constexpr std::string_view names[gpu::SLOT_COUNT] = {"baseColorTexture",
                                                             "metallicRoughnessTexture",
                                                             "normalTexture",
                                                             "occlusionTexture",
                                                             "emissiveTexture",
                                                             "specularTexture",
                                                             "specularColorTexture",
                                                             lightmapName,
                                                             "clearcoatTexture",
                                                             "clearcoatRoughnessTexture",
                                                             "clearcoatNormalTexture",
                                                             "anisotropyTexture",
                                                             "sheenColorTexture",
                                                             "sheenRoughnessTexture",
                                                             "iridescenceTexture",
                                                             "iridescenceThicknessTexture",
                                                             "transmissionTexture",
                                                             "thicknessTexture",
                                                             "diffuseTransmissionTexture",
                                                             "diffuseTransmissionColorTexture"};
        return static_cast<std::size_t>(std::ranges::find(names, name) - std::begin(names));
    }

    double bounded(const std::string& what, double x, double least, double most) {
        const double inside = std::clamp(x, least, most);
        if (inside != x)
            // All digits, because 1.0000001 is outside as well.
            scene_.notes.push_back(fmt::format("{}: {} {} is outside {:g} to {:g}: {:g} is used", who_, what,
                                               x, least, most, inside));
        return inside;
    }
    float within(const std::string& what, double x, double least, double most) {
        return static_cast<float>(bounded(what, x, least, most));
    }

    AlphaMode alphaMode() const {
        if (file_.alphaMode == "OPAQUE") return AlphaMode::opaque;
        if (file_.alphaMode == "MASK") return AlphaMode::mask;
        if (file_.alphaMode == "BLEND") return AlphaMode::blend;
        fail(who_, fmt::format("alphaMode \"{}\" is not one of OPAQUE, MASK, BLEND", file_.alphaMode));
    }

    template <class Info>
    TextureSlot slot(const char* name, const Info& info) {
        return slot(name, info.index, info.texCoord, extension(info.extensions, "KHR_texture_transform"));
    }

    TextureSlot slot(const char* name, int texture, int texcoord, const tinygltf::Value* transform) {
        TextureSlot result;
        const std::string who = fmt::format("{}: {}", who_, name);
        if (checkedIndex(texture, scene_.textures.size(), who, "texture") < 0) return result;
        if (const std::string& fault = faults_[static_cast<std::size_t>(texture)]; !fault.empty())
            throw std::runtime_error(fault);
        const char* other = otherImageOf(model_.textures[static_cast<std::size_t>(texture)]);
        if (other && scene_.textures[static_cast<std::size_t>(texture)].image < 0)
            fail(who,
                 fmt::format("texture {} has only an image of {}, which is not supported", texture, other));
        if (transform) texcoord = readTransform(*transform, name, result, texcoord);
        if (texcoord < 0 || texcoord > 1)
            scene_.notes.push_back(
                fmt::format("{} reads TEXCOORD_{}: left out, only two UV sets are supported", who, texcoord));
        else if (scene_.textures[static_cast<std::size_t>(texture)].image < 0)
            scene_.notes.push_back(
                fmt::format("{}: texture {} has no PNG, JPEG or WebP image: left out", who, texture));
        else
            result.texture = texture;
        result.texcoord = texcoord == 1 ? 1 : 0;
        return result;
    }

    // KHR_texture_transform: scale, then rotation (counter-clockwise with v growing downwards), then
    // offset. Returns the UV set: the transform's if given, otherwise the texture's.
    int readTransform(const tinygltf::Value& transform, const std::string& slot, TextureSlot& result,
                      int texcoord) {
        const std::string who = fmt::format("{}: {}", who_, slot);
        std::vector<double> offset = numbersIn(transform, "offset", {0, 0}, who);
        std::vector<double> scale = numbersIn(transform, "scale", {1, 1}, who);
        for (double& x : offset) x = bounded(slot + " offset", x, -maxFactor, maxFactor);
        for (double& x : scale) x = bounded(slot + " scale", x, -maxFactor, maxFactor);
        TextureTransform& parts = parts_.transforms[slotNumber(slot)];
        parts = {{offset[0], offset[1]}, {scale[0], scale[1]}, numberIn(transform, "rotation", 0, who)};
        setTransform(result, parts);
        return indexIn(transform, "texCoord", texcoord, who);
    }

    // A texture in an extension, which tinygltf does not parse.
    TextureSlot slotIn(const tinygltf::Value& object, const char* name) {
        if (!object.Has(name)) return {};
        const std::string who = fmt::format("{}: {}", who_, name);
        const tinygltf::Value& info = object.Get(name);
        if (!info.IsObject() || !info.Has("index")) fail(who, "names no texture");
        const tinygltf::Value* transform = nullptr;
        if (info.Get("extensions").IsObject() &&
            info.Get("extensions").Get("KHR_texture_transform").IsObject())
            transform = &info.Get("extensions").Get("KHR_texture_transform");
        return slot(name, indexIn(info, "index", -1, who), indexIn(info, "texCoord", 0, who), transform);
    }

    void readMetallicRoughness(Material& m, bool isUnlit) {
        const tinygltf::PbrMetallicRoughness& pbr = file_.pbrMetallicRoughness;
        for (int c = 0; c < 4; ++c)
            m.base_color[c] =
                within("baseColorFactor", pbr.baseColorFactor[static_cast<std::size_t>(c)], 0, 1);
        m.metallic = within("metallicFactor", pbr.metallicFactor, 0, 1);
        m.roughness = within("roughnessFactor", pbr.roughnessFactor, 0, 1);
        m.base_color_texture = slot("baseColorTexture", pbr.baseColorTexture);
        if (!isUnlit)
            m.metallic_roughness_texture = slot("metallicRoughnessTexture", pbr.metallicRoughnessTexture);
    }

    // Replaces pbrMetallicRoughness. An infinite index of refraction makes the specular colour F0, and F90 1.
    void readSpecularGlossiness(Material& m, const tinygltf::Value& e) {
        m.specular_glossiness = true;
        const std::vector<double> diffuse = numbersIn(e, "diffuseFactor", {1, 1, 1, 1}, who_),
                                  f0 = numbersIn(e, "specularFactor", {1, 1, 1}, who_);
        for (int c = 0; c < 4; ++c)
            m.base_color[c] = within("diffuseFactor", diffuse[static_cast<std::size_t>(c)], 0, 1);
        for (int c = 0; c < 3; ++c)
            m.specular_color[c] = within("specularFactor", f0[static_cast<std::size_t>(c)], 0, 1);
        const double glossiness = numberIn(e, "glossinessFactor", 1, who_);
        m.roughness = static_cast<float>(1 - bounded("glossinessFactor", glossiness, 0, 1));
        m.metallic = m.ior = 0;
        m.base_color_texture = slotIn(e, "diffuseTexture");
        m.specular_color_texture = slotIn(e, "specularGlossinessTexture");
        for (const auto& [name, value] : file_.extensions)
            if (name.starts_with("KHR_materials_") && name != "KHR_materials_pbrSpecularGlossiness" &&
                name != "KHR_materials_emissive_strength")
                scene_.notes.push_back(
                    fmt::format("{}: {} beside KHR_materials_pbrSpecularGlossiness: ignored", who_, name));
    }

    // KHR_materials_unlit: keeps only base colour, alpha and double_sided.
    static Material unlit(const Material& lit) {
        Material m;
        m.unlit = true;
        m.name = lit.name;
        m.base_color = lit.base_color;
        m.base_color_texture = lit.base_color_texture;
        m.alpha_mode = lit.alpha_mode;
        m.alpha_cutoff = lit.alpha_cutoff;
        m.double_sided = lit.double_sided;
        return m;
    }

    void readEmission(Material& m) {
        double strength = 1;
        if (const auto* e = extension(file_.extensions, "KHR_materials_emissive_strength"))
            strength = bounded("emissiveStrength", numberIn(*e, "emissiveStrength", 1, who_), 0,
                               std::numeric_limits<float>::max());
        for (int c = 0; c < 3; ++c) {
            const double emitted = file_.emissiveFactor[static_cast<std::size_t>(c)] * strength;
            if (!(emitted <= static_cast<double>(std::numeric_limits<float>::max())))
                fail(who_, fmt::format("emits {:g}, more than a float can store", emitted));
            m.emissive[c] = within("emissiveFactor", emitted, 0, std::numeric_limits<float>::max());
            parts_.emissive[c] = std::max(file_.emissiveFactor[static_cast<std::size_t>(c)], 0.0);
        }
        parts_.emissive_strength = strength;
    }

    void readLightmap(Material& m) {
        if (!lightmap_) return;
        scene_.notes.insert(scene_.notes.end(), lightmap_->notes.begin(), lightmap_->notes.end());
        m.lightmap_texture = slot(lightmapName, lightmap_->texture, lightmap_->texcoord, nullptr);
        m.lightmap_intensity = static_cast<float>(lightmap_->intensity);
    }

    void readTransmission(Material& m) {
        const auto* e = extension(file_.extensions, "KHR_materials_transmission");
        if (!e) return;
        m.transmission = within("transmissionFactor", numberIn(*e, "transmissionFactor", 0, who_), 0, 1);
        m.transmission_texture = slotIn(*e, "transmissionTexture");
    }

    void readVolume(Material& m) {
        if (const auto* e = extension(file_.extensions, "KHR_materials_volume")) {
            m.thickness = within("thicknessFactor", numberIn(*e, "thicknessFactor", 0, who_), 0, maxFactor);
            m.thickness_texture = slotIn(*e, "thicknessTexture");
            m.attenuation_color = color(*e, "attenuationColor");
            if (e->Has("attenuationDistance"))
                m.attenuation_distance =
                    within("attenuationDistance", numberIn(*e, "attenuationDistance", 0, who_),
                           minAttenuationDistance, maxFactor);
        }
        if (const auto* e = extension(file_.extensions, "KHR_materials_dispersion"))
            m.dispersion = within("dispersion", numberIn(*e, "dispersion", 0, who_), 0, maxFactor);
    }

    void readDiffuseTransmission(Material& m) {
        const auto* e = extension(file_.extensions, "KHR_materials_diffuse_transmission");
        if (!e) return;
        m.diffuse_transmission =
            within("diffuseTransmissionFactor", numberIn(*e, "diffuseTransmissionFactor", 0, who_), 0, 1);
        m.diffuse_transmission_color = color(*e, "diffuseTransmissionColorFactor");
        m.diffuse_transmission_texture = slotIn(*e, "diffuseTransmissionTexture");
        m.diffuse_transmission_color_texture = slotIn(*e, "diffuseTransmissionColorTexture");
    }

    // 0 to 1; white by default.
    glm::vec3 color(const tinygltf::Value& object, const char* name) {
        const std::vector<double> components = numbersIn(object, name, {1, 1, 1}, who_);
        glm::vec3 result;
        for (int c = 0; c < 3; ++c) result[c] = within(name, components[static_cast<std::size_t>(c)], 0, 1);
        return result;
    }

    void readClearcoat(Material& m) {
        const auto* e = extension(file_.extensions, "KHR_materials_clearcoat");
        if (!e) return;
        m.clearcoat = within("clearcoatFactor", numberIn(*e, "clearcoatFactor", 0, who_), 0, 1);
        m.clearcoat_roughness =
            within("clearcoatRoughnessFactor", numberIn(*e, "clearcoatRoughnessFactor", 0, who_), 0, 1);
        m.clearcoat_texture = slotIn(*e, "clearcoatTexture");
        m.clearcoat_roughness_texture = slotIn(*e, "clearcoatRoughnessTexture");
        m.clearcoat_normal_texture = slotIn(*e, "clearcoatNormalTexture");
        if (e->Has("clearcoatNormalTexture"))
            m.clearcoat_normal_scale =
                within("clearcoatNormalTexture.scale",
                       numberIn(e->Get("clearcoatNormalTexture"), "scale", 1, who_), -maxFactor, maxFactor);
    }

    void readAnisotropy(Material& m) {
        const auto* e = extension(file_.extensions, "KHR_materials_anisotropy");
        if (!e) return;
        constexpr double any = std::numeric_limits<float>::max();
        m.anisotropy = within("anisotropyStrength", numberIn(*e, "anisotropyStrength", 0, who_), 0, 1);
        m.anisotropy_rotation =
            within("anisotropyRotation", numberIn(*e, "anisotropyRotation", 0, who_), -any, any);
        m.anisotropy_texture = slotIn(*e, "anisotropyTexture");
    }

    void readSheen(Material& m) {
        const auto* e = extension(file_.extensions, "KHR_materials_sheen");
        if (!e) return;
        const std::vector<double> color = numbersIn(*e, "sheenColorFactor", {0, 0, 0}, who_);
        for (int c = 0; c < 3; ++c)
            m.sheen_color[c] = within("sheenColorFactor", color[static_cast<std::size_t>(c)], 0, 1);
        m.sheen_roughness =
            within("sheenRoughnessFactor", numberIn(*e, "sheenRoughnessFactor", 0, who_), 0, 1);
        m.sheen_color_texture = slotIn(*e, "sheenColorTexture");
        m.sheen_roughness_texture = slotIn(*e, "sheenRoughnessTexture");
    }

    void readIridescence(Material& m) {
        const auto* e = extension(file_.extensions, "KHR_materials_iridescence");
        if (!e) return;
        const auto number = [&](const char* name, double otherwise, double least, double most) {
            return within(name, numberIn(*e, name, otherwise, who_), least, most);
        };
        m.iridescence = number("iridescenceFactor", 0, 0, 1);
        m.iridescence_ior = number("iridescenceIor", 1.3, 1, maxFactor);
        m.iridescence_thickness_least = number("iridescenceThicknessMinimum", 100, 0, maxFilmThickness);
        m.iridescence_thickness_most = number("iridescenceThicknessMaximum", 400, 0, maxFilmThickness);
        m.iridescence_texture = slotIn(*e, "iridescenceTexture");
        m.iridescence_thickness_texture = slotIn(*e, "iridescenceThicknessTexture");
    }

    void readSpecular(Material& m) {
        if (const auto* e = extension(file_.extensions, "KHR_materials_ior")) {
            const double ior = numberIn(*e, "ior", 1.5, who_);
            if (ior != 0 && ior < 1)
                scene_.notes.push_back(
                    fmt::format("{}: ior {} is not 0 or at least 1: 1 is used", who_, ior));
            m.ior = ior == 0 ? 0.0f : within("ior", std::max(ior, 1.0), 1, maxFactor);
        }
        if (const auto* e = extension(file_.extensions, "KHR_materials_specular")) {
            m.specular = within("specularFactor", numberIn(*e, "specularFactor", 1, who_), 0, 1);
            const std::vector<double> color = numbersIn(*e, "specularColorFactor", {1, 1, 1}, who_);
            for (int c = 0; c < 3; ++c)
                m.specular_color[c] =
                    within("specularColorFactor", color[static_cast<std::size_t>(c)], 0, maxFactor);
            m.specular_texture = slotIn(*e, "specularTexture");
            m.specular_color_texture = slotIn(*e, "specularColorTexture");
        }
    }
};

std::vector<bool> drawnMaterials(const tinygltf::Model& model, const Scene& scene) {
    std::vector<bool> drawn(model.materials.size(), false);
    for (const Node& node : scene.nodes) {
        if (node.mesh < 0) continue;
        for (const tinygltf::Primitive& p : model.meshes[static_cast<std::size_t>(node.mesh)].primitives)
            if (checkedIndex(p.material, drawn.size(), fmt::format("mesh {}", node.mesh), "material") >= 0)
                drawn[static_cast<std::size_t>(p.material)] = true;
    }
    return drawn;
}

// Keeps only the images that materials read, in the file's order, and updates texture indices.
void keepImagesInUse(Scene& scene, std::size_t imageCount, std::vector<int>& imageOf) {
    std::vector<bool> used(imageCount, false);
    for (const Material& m : scene.materials)
        for (const MaterialSlot& slot : materialSlots)
            if (const int texture = (m.*slot.texture).texture; texture >= 0)
                used[static_cast<std::size_t>(scene.textures[static_cast<std::size_t>(texture)].image)] =
                    true;
    std::vector<int> placeOf(imageCount, -1);
    for (std::size_t i = 0; i < imageCount; ++i) {
        if (!used[i]) continue;
        placeOf[i] = static_cast<int>(imageOf.size());
        imageOf.push_back(static_cast<int>(i));
    }
    for (Texture& texture : scene.textures)
        if (texture.image >= 0) texture.image = placeOf[static_cast<std::size_t>(texture.image)];
    scene.images.resize(imageOf.size());
}

}  // namespace

void readMaterials(const tinygltf::Model& model, const MaterialExtras& extras, Scene& scene,
                   std::vector<int>& imageOf) {
    const std::size_t before = scene.notes.size();
    const std::vector<std::string> faults = readTextures(model, scene);
    const std::vector<bool> drawn = drawnMaterials(model, scene);
    const std::set<int> moving = materialsThatMove(scene);
    NoteList left("materials");
    for (std::size_t i = 0; i < model.materials.size(); ++i) {
        Material& m = scene.materials.emplace_back();
        try {
            MaterialReader reader(model, extras, scene, faults, i);
            m = reader.read();
            if (moving.contains(static_cast<int>(i)))
                scene.material_parts[static_cast<int>(i)] = reader.parts();
        } catch (const std::runtime_error& e) {
            if (drawn[i]) throw;
            left.add(std::string(e.what()) + ": left out, the scene does not use it");
            m = {};
            m.name = model.materials[i].name;
        }
        if (!drawn[i])
            for (const MaterialSlot& slot : materialSlots) m.*slot.texture = {};
    }
    limitNotes(scene.notes, before, "materials");
    left.moveTo(scene.notes);
    noteTransmission(model, drawn, scene);
    const bool needsDefault =
        std::any_of(model.meshes.begin(), model.meshes.end(), [](const tinygltf::Mesh& mesh) {
            return std::any_of(mesh.primitives.begin(), mesh.primitives.end(),
                               [](const tinygltf::Primitive& p) { return p.material == -1; });
        });
    if (needsDefault) scene.materials.emplace_back().name = "default";
    keepImagesInUse(scene, model.images.size(), imageOf);
}

std::vector<bool> lightmapsAlone(const Scene& scene) {
    std::vector<bool> alone(scene.images.size(), true);
    for (const Material& m : scene.materials)
        for (std::size_t i = 0; i < materialSlots.size(); ++i)
            if (const int texture = (m.*materialSlots[i].texture).texture;
                texture >= 0 && i != gpu::SLOT_lightmap)
                alone[static_cast<std::size_t>(scene.textures[static_cast<std::size_t>(texture)].image)] =
                    false;
    return alone;
}

}  // namespace diptych::gltf
