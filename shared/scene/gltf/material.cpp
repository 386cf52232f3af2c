// SPDX-License-Identifier: MIT
#include "shared/scene/gltf/material.h"

#include "shared/scene/gltf/extras.h"
#include "shared/scene/gltf/model.h"
#include "shared/scene/gltf/note_list.h"
#include "shared/scene/gltf/properties.h"
#include "shared/scene/gltf/texture.h"
#include "shared/scene/gltf/transmission_notes.h"
#include "shared/scene/gltf/value.h"
#include "shared/scene/model/animated.h"
#include "shared/scene/model/material_parts.h"
#include "shared/scene/model/material_slots.h"
#include "shared/text/fail.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <set>
#include <span>
#include <stdexcept>

namespace diptych::gltf {

using Json = nlohmann::json;

namespace {

// ---- materials ---------------------------------------------------------------------------------------

class MaterialReader {
public:
    // `faults`: by texture; empty if it is valid. `textures`: the document's.
    MaterialReader(const Json& file, const Json& textures, Scene& scene,
                   const std::vector<std::string>& faults, std::size_t index, NoteList& lightmap_notes)
        : file_(file),
          textures_(textures),
          scene_(scene),
          faults_(faults),
          who_(fmt::format("material {}", index)),
          lightmap_notes_(lightmap_notes) {}

    Material read() {
        m_.name = file_.value("name", std::string());
        m_.unlit = extension(file_, unlitName);
        const Json* glossy = m_.unlit ? nullptr : extension(file_, glossyName);
        if (glossy)
            readSpecularGlossiness(*glossy);
        else if (const Json* pbr = memberOf(file_, "pbrMetallicRoughness"))
            read(*pbr, schema::metallicRoughness);
        read(file_, schema::material);
        const std::string mode = file_.value("alphaMode", "OPAQUE");
        m_.alpha_mode = mode == "MASK"    ? AlphaMode::mask
                        : mode == "BLEND" ? AlphaMode::blend
                                          : AlphaMode::opaque;
        m_.double_sided = file_.value("doubleSided", false);
        if (m_.unlit) return unlit();
        readEmission();
        for (const schema::Property& layer : schema::materialExtensions)
            if (const Json* e = glossy ? nullptr : extension(file_, layer.key)) read(*e, layer.properties);
        readLightmap();
        return m_;
    }

    // Valid after read(): the parts of combined values.
    const MaterialParts& parts() const { return parts_; }

private:
    const Json &file_, &textures_;
    Scene& scene_;
    const std::vector<std::string>& faults_;
    std::string who_;
    NoteList& lightmap_notes_;
    Material m_;
    MaterialParts parts_;

    static constexpr const char *unlitName = "KHR_materials_unlit",
                                *glossyName = "KHR_materials_pbrSpecularGlossiness",
                                *strengthName = "KHR_materials_emissive_strength";

    double bounded(const std::string& what, double x, double min, double max) {
        const double inside = std::clamp(x, min, max);
        if (inside != x)
            // All digits, because 1.0000001 is outside as well.
            scene_.notes.push_back(fmt::format("{}: {} {} is outside {:g} to {:g}: {:g} is used", who_, what,
                                               x, min, max, inside));
        return inside;
    }

    // Reads the values and textures of an object, but not those of objects in it.
    void read(const Json& object, std::span<const schema::Property> properties) {
        for (const schema::Property& p : properties) {
            const Json* value = memberOf(object, p.key);
            if (!value) continue;
            if (p.part) set(p, *value, std::string(p.key));
            if (p.slot == gpu::SLOT_COUNT) continue;
            if (!m_.unlit || p.slot == gpu::SLOT_base_color) readTexture(p, *value);
            for (const schema::Property& own : p.properties)
                if (const Json* factor = own.part ? memberOf(*value, own.key) : nullptr)
                    set(own, *factor, fmt::format("{}.{}", p.key, own.key));
        }
    }

    void set(const schema::Property& p, const Json& value, const std::string& what,
             std::size_t slot = gpu::SLOT_COUNT) {
        // See readEmission().
        if (*p.part == AnimatedPart::emissive || *p.part == AnimatedPart::emissive_strength) return;
        PartProperties animated = propertiesOf(*p.part);
        std::vector<double> numbers =
            value.is_array() ? value.get<std::vector<double>>() : std::vector{value.get<double>()};
        if (*p.part == AnimatedPart::ior && numbers[0] != 0) {
            animated.min = 1;
            if (numbers[0] < 1)
                scene_.notes.push_back(
                    fmt::format("{}: ior {} is not 0 or at least 1: 1 is used", who_, numbers[0]));
            numbers[0] = std::max(numbers[0], animated.min);
        }
        for (double& x : numbers) x = bounded(what, x, animated.min, animated.max);
        setPart(m_, parts_, *p.part, slot, numbers);
    }

    void readTexture(const schema::Property& p, const Json& info) {
        const std::string name(p.key);
        int texcoord = info.value("texCoord", 0);
        if (const Json* transform = extension(info, "KHR_texture_transform")) {
            for (const schema::Property& part : schema::textureTransform)
                if (const Json* value = part.part ? memberOf(*transform, part.key) : nullptr)
                    set(part, *value, fmt::format("{} {}", name, part.key), p.slot);
            texcoord = transform->value("texCoord", texcoord);
        }
        setTexture(p.slot, name, info["index"].get<int>(), texcoord);
    }

    void setTexture(std::size_t slot, const std::string& name, int index, int texcoord) {
        const std::string who = fmt::format("{}: {}", who_, name);
        const auto i = static_cast<std::size_t>(index);
        if (!faults_[i].empty()) fail(faults_[i]);
        const bool image = scene_.textures[i].image >= 0;
        if (const char* other = image ? nullptr : otherImageOf(textures_[i]))
            fail(who,
                 fmt::format("texture {} has only an image of {}, which is not supported", index, other));
        TextureSlot& result = m_.*materialSlots[slot].texture;
        if (texcoord < 0 || texcoord > 1)
            scene_.notes.push_back(
                fmt::format("{} reads TEXCOORD_{}: left out, only two UV sets are supported", who, texcoord));
        else if (!image)
            scene_.notes.push_back(
                fmt::format("{}: texture {} has no PNG, JPEG or WebP image: left out", who, index));
        else
            result.texture = index;
        result.texcoord = texcoord == 1 ? 1 : 0;
    }

    // Replaces pbrMetallicRoughness. An infinite index of refraction makes the specular colour F0, and F90 1.
    void readSpecularGlossiness(const Json& e) {
        m_.specular_glossiness = true;
        m_.metallic = m_.roughness = m_.ior = 0;
        read(e, schema::specularGlossiness);
        for (const auto& [name, value] : file_["extensions"].items())
            if (name.starts_with("KHR_materials_") && name != glossyName && name != strengthName)
                scene_.notes.push_back(fmt::format("{}: {} beside {}: ignored", who_, name, glossyName));
    }

    // KHR_materials_unlit: keeps only base colour, alpha and double_sided.
    Material unlit() const {
        Material m;
        m.unlit = true;
        m.name = m_.name;
        m.base_color = m_.base_color;
        m.base_color_texture = m_.base_color_texture;
        m.alpha_mode = m_.alpha_mode;
        m.alpha_cutoff = m_.alpha_cutoff;
        m.double_sided = m_.double_sided;
        return m;
    }

    void readEmission() {
        constexpr double max = std::numeric_limits<float>::max();
        const std::vector<double> factor = file_.value("emissiveFactor", std::vector<double>(3));
        if (const Json* e = extension(file_, strengthName))
            parts_.emissive_strength = bounded("emissiveStrength", e->value("emissiveStrength", 1.0), 0, max);
        for (int c = 0; c < 3; ++c) {
            const double own = factor[static_cast<std::size_t>(c)], emitted = own * parts_.emissive_strength;
            if (!(emitted <= max))
                fail(who_, fmt::format("emits {:g}, more than a float can store", emitted));
            m_.emissive[c] = static_cast<float>(bounded("emissiveFactor", emitted, 0, max));
            parts_.emissive[c] = std::max(own, 0.0);
        }
    }

    void readLightmap() {
        const Lightmap lightmap = lightmapOf(file_, textures_.size(), who_, lightmap_notes_);
        if (lightmap.texture < 0) return;
        setTexture(gpu::SLOT_lightmap, "extras: diptych: lightmap", lightmap.texture, lightmap.texcoord);
        m_.lightmap_intensity = static_cast<float>(lightmap.intensity);
    }
};

std::vector<bool> drawnMaterials(const Model& model, std::size_t count, const Scene& scene) {
    std::vector<bool> drawn(count, false);
    for (const Node& node : scene.nodes) {
        if (node.mesh < 0) continue;
        for (const tinygltf::Primitive& p : model.meshes[static_cast<std::size_t>(node.mesh)].primitives)
            if (p.material >= 0) drawn[static_cast<std::size_t>(p.material)] = true;
    }
    return drawn;
}

// Calls `use` with the slot and image of each texture of a material.
template <class Use>
void forImages(const Scene& scene, const Use& use) {
    for (const Material& m : scene.materials)
        for (std::size_t slot = 0; slot < materialSlots.size(); ++slot)
            if (slotOf(m, slot).texture >= 0)
                use(slot, static_cast<std::size_t>(textureOf(scene, slotOf(m, slot)).image));
}

// Keeps only the images that materials read, in the file's order, and updates texture indices.
void keepImagesInUse(Scene& scene, std::size_t imageCount, std::vector<int>& imageOf) {
    std::vector<bool> used(imageCount, false);
    forImages(scene, [&](std::size_t, std::size_t image) { used[image] = true; });
    std::vector<int> newIndex(imageCount, -1);
    for (std::size_t i = 0; i < imageCount; ++i) {
        if (!used[i]) continue;
        newIndex[i] = static_cast<int>(imageOf.size());
        imageOf.push_back(static_cast<int>(i));
    }
    for (Texture& texture : scene.textures)
        if (texture.image >= 0) texture.image = newIndex[static_cast<std::size_t>(texture.image)];
    scene.images.resize(imageOf.size());
}

}  // namespace

void readMaterials(const Model& model, Scene& scene, std::vector<int>& imageOf) {
    const Json &materials = arrayAt(model.rest, "/materials"), &textures = arrayAt(model.rest, "/textures");
    const std::size_t before = scene.notes.size();
    const std::vector<std::string> faults = readTextures(model.rest, scene);
    const std::vector<bool> drawn = drawnMaterials(model, materials.size(), scene);
    const std::set<int> moving = materialsThatMove(scene);
    NoteList left("materials"), lightmaps("lightmaps");
    for (std::size_t i = 0; i < materials.size(); ++i) {
        Material& m = scene.materials.emplace_back();
        try {
            MaterialReader reader(materials[i], textures, scene, faults, i, lightmaps);
            m = reader.read();
            if (moving.contains(static_cast<int>(i)))
                scene.material_parts[static_cast<int>(i)] = reader.parts();
        } catch (const std::runtime_error& e) {
            if (drawn[i]) throw;
            left.add(std::string(e.what()) + ": left out, the scene does not use it");
            m = {};
            m.name = materials[i].value("name", std::string());
        }
        if (!drawn[i])
            for (const MaterialSlot& slot : materialSlots) m.*slot.texture = {};
    }
    limitNotes(scene.notes, before, "materials");
    left.moveTo(scene.notes);
    lightmaps.moveTo(scene.notes);
    noteTransmission(materials, drawn, scene);
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
    forImages(scene, [&](std::size_t slot, std::size_t image) {
        if (slot != gpu::SLOT_lightmap) alone[image] = false;
    });
    return alone;
}

}  // namespace diptych::gltf
