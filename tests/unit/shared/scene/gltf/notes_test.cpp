// SPDX-License-Identifier: MIT
// Notes about a file, each with the smallest change that causes it and the nearest that does not. Notes whose
// tests already state both: node_test.cpp, repair_test.cpp, repair_bytes_test.cpp, variants_test.cpp.
#include "tests/unit/shared/scene/gltf/as_is.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace diptych::noted {
namespace {

using Json = nlohmann::json;

using Change = std::function<void(GltfFile&)>;

struct NotedChange {
    std::vector<std::string> notes;  // all notes of the file
    Change base, cause, nearest;
};

constexpr float last = 1e18f;  // the largest coordinate that is drawn
const float beyond = std::nextafter(last, 2 * last);

void nothing(GltfFile&) {}

template <class... Changes>
Change all(Changes... changes) {
    return [=](GltfFile& f) { (changes(f), ...); };
}

// Sets the value at a JSON pointer.
Change at(const std::string& pointer, const std::string& value) {
    return [=](GltfFile& f) { f.json[Json::json_pointer(pointer)] = Json::parse(value); };
}

Change accessorAt(const std::string& pointer, std::size_t width, const std::vector<float>& values) {
    return [=](GltfFile& f) {
        static constexpr std::array types{"", "SCALAR", "VEC2", "VEC3", "VEC4"};
        const int index = f.accessor(values, FLOAT, types.at(width), width);
        f.json[Json::json_pointer(pointer)] = index;
    };
}

const std::string primitive = "/meshes/0/primitives/0/", attributes = primitive + "attributes/";

Change attribute(const std::string& name, std::size_t width, const std::vector<float>& values) {
    return accessorAt(attributes + name, width, values);
}
Change target(const std::string& name, const std::vector<float>& values) {
    return accessorAt(primitive + "targets/0/" + name, 3, values);
}
Change indices(const std::vector<std::uint8_t>& values) {
    return [=](GltfFile& f) { f.primitive()["indices"] = f.accessor(values, UBYTE, "SCALAR", 1); };
}

Change material(const std::string& value) {
    return all(at("/materials/0", value), at(primitive + "material", "0"));
}
// A material with two sets of texture coordinates and a texture.
Change mapped(const std::string& value) {
    return all(material(value), attribute("TEXCOORD_0", 2, {0, 0, 0, 1, 1, 0}),
               attribute("TEXCOORD_1", 2, {1, 0, 0, 0, 1, 1}),
               at("/images/0/uri", fmt::format("\"{}\"", twoPixels)), at("/textures/0/source", "0"));
}
// A material named pane with these extensions.
Change pane(const std::string& extensions) {
    return material(R"({"name": "pane", "extensions": {)" + extensions + "}}");
}

// An animation of one channel with keys at two times; `width`: numbers per key.
Change animated(int index, const std::string& goal, std::size_t width, const std::vector<float>& values,
                const std::vector<float>& times = {0, 1}) {
    const std::string animation = fmt::format("/animations/{}/", index);
    return all(accessorAt(animation + "samplers/0/input", 1, times),
               accessorAt(animation + "samplers/0/output", width, values),
               at(animation + "channels/0", fmt::format(R"({{"sampler": 0, "target": {}}})", goal)));
}
std::string pointer(const std::string& to) {
    return fmt::format(
        R"({{"path": "pointer", "extensions": {{"KHR_animation_pointer": {{"pointer": "{}"}}}}}})", to);
}
const std::string moves = R"({"node": 0, "path": "translation"})";

void hasJoints(GltfFile& f) {
    f.primitive()["attributes"]["JOINTS_0"] = f.accessor(std::vector<std::uint8_t>(12, 0), UBYTE, "VEC4", 4);
    attribute("WEIGHTS_0", 4, {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0})(f);
    f.json["skins"] = {{{"joints", {0}}}};
}
// The last vertex has these weights.
Change weights(const std::vector<float>& own) {
    std::vector<float> values{1, 0, 0, 0, 1, 0, 0, 0};
    values.insert(values.end(), own.begin(), own.end());
    return attribute("WEIGHTS_0", 4, values);
}

const std::string copies = "/nodes/0/extensions/EXT_mesh_gpu_instancing/attributes";
const Change instanced = accessorAt(copies + "/TRANSLATION", 3, {0, 0, 0, 2, 0, 0}),
             upright = attribute("NORMAL", 3, {0, 0, 1, 0, 0, 1, 0, 0, 1}),
             skinned = all(hasJoints, at("/nodes/0/skin", "0"));

// Node 1 has a mesh, a light or a camera.
Change beside(const std::string& node) {
    return all(at("/nodes/1", node), at("/scenes/0/nodes/1", "1"),
               at("/cameras", R"([{"type": "perspective", "perspective": {"yfov": 1, "znear": 1}}])"),
               at("/extensions/KHR_lights_punctual/lights", R"([{"type": "point"}])"));
}
NotedChange tooFar(const std::string& what, const std::string& node) {
    return {{"1 " + what + " is not finite or beyond 1e+18 m: left out"},
            beside(node),
            at("/nodes/1/translation", "[2e18, 0, 0]"),
            at("/nodes/1/translation", "[5e17, 0, 0]")};
}

void expectEach(const std::vector<NotedChange>& rows) {
    for (const NotedChange& row : rows) {
        GltfFile caused = GltfFile::triangle(), near = GltfFile::triangle();
        all(row.base, row.cause)(caused);
        all(row.base, row.nearest)(near);
        EXPECT_EQ(caused.load().notes, row.notes);
        EXPECT_EQ(near.load().notes, std::vector<std::string>()) << "without the cause of: " << row.notes[0];
    }
}

}  // namespace

TEST(GltfNotes, OfGeometryComeWithTheirCauseAlone) {
    const std::string who = "mesh 0, primitive 0: ";
    const auto corner = [](float y) {
        return attribute("POSITION", 3, {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, y, 0});
    };
    const auto uv = [](float first, float second) {
        return attribute("TEXCOORD_0", 2, {first, 0, 0, second, 0, 0});
    };
    const auto normals = [](float first, float second) {
        return attribute("NORMAL", 3, {0, 0, first, 0, 0, second, 0, 0, 1});
    };
    const auto tangents = [](float first, float second) {
        return attribute("TANGENT", 4, {first, 0, 0, 1, second, 0, 0, 1, 1, 0, 0, 1});
    };
    expectEach({
        {{who + "points or lines, left out"},
         nothing,
         at(primitive + "mode", "3"),
         at(primitive + "mode", "4")},
        {{who + "has no POSITION, left out"}, nothing, at(primitive + "attributes", "{}"), nothing},
        {{who + "has no triangles, left out"},
         at(primitive + "mode", "5"),
         indices({0, 1}),
         indices({0, 1, 2})},
        {{who + "the last 1 index cannot form a triangle"},
         nothing,
         indices({0, 1, 2, 0}),
         indices({0, 1, 2})},
        {{who + "the last 2 indices cannot form a triangle"},
         nothing,
         indices({0, 1, 2, 0, 1}),
         indices({0, 1, 2, 0, 1, 2})},
        {{who + "1 of 2 triangles with a vertex that is not finite or beyond 1e+18 m: left out"},
         nothing,
         corner(beyond),
         corner(last)},
        {{who + "TEXCOORD_0: 1 is beyond 1e+18: 0, 0 is used"}, nothing, uv(beyond, 0), uv(last, 0)},
        {{who + "TEXCOORD_0: 2 are not finite: 0, 0 is used"}, nothing, uv(NAN, INFINITY), uv(last, -last)},
        {{who + "COLOR_0: 1 is not finite: white is used"},
         nothing,
         attribute("COLOR_0", 3, {0, 0, INFINITY, 0, 0, 0, 0, 0, 0}),
         attribute("COLOR_0", 3, {0, 0, last, 0, 0, 0, 0, 0, 0})},
        {{who + "target 0: POSITION: 1 is beyond 1e+18: 0 is used"},
         nothing,
         target("POSITION", {0, 0, 0, beyond, 0, 0, 0, 0, 0}),
         target("POSITION", {0, 0, 0, last, 0, 0, 0, 0, 0})},
        {{who + "target 0: NORMAL: left out"},
         nothing,
         target("NORMAL", {0, 0, 1, 0, 0, 1, 0, 0, 1}),
         all(upright, target("NORMAL", {0, 0, 1, 0, 0, 1, 0, 0, 1}))},
        {{who + "1 normal has no direction: triangle normals are used"},
         nothing,
         normals(1, 0),
         normals(1, 1e-30f)},
        {{who + "2 normals have no direction: triangle normals are used"},
         nothing,
         normals(NAN, INFINITY),
         normals(last, -last)},
        {{who + "1 tangent has no direction: any perpendicular to the normal is used"},
         upright,
         tangents(1, 0),
         tangents(1, 1e-30f)},
        {{who + "2 tangents have no direction: any perpendicular to the normal is used"},
         upright,
         tangents(0, 0),
         tangents(-1, -1)},
    });
}

TEST(GltfNotes, OfMaterialsComeWithTheirCauseAlone) {
    const std::string extension = "/materials/0/extensions/KHR_materials_", pbr = "pbrMetallicRoughness";
    const auto sets = [&](const std::string& normal, const std::string& others) {
        return mapped(fmt::format(R"({{"normalTexture": {}, "extensions": {{{}}}}})", normal, others));
    };
    const std::string turned = R"({"index": 0, "extensions": {"KHR_texture_transform": {"rotation": 1.57}}})",
                      coat = R"("KHR_materials_clearcoat": {"clearcoatFactor": 1, "clearcoatNormalTexture":
                          {"index": 0, "texCoord": 1, "extensions": {"KHR_texture_transform": {}}}})",
                      brushed = R"("KHR_materials_anisotropy": {"anisotropyStrength": 1,
                          "anisotropyTexture": {"index": 0}})",
                      coat_map = extension +
                                 "clearcoat/clearcoatNormalTexture/extensions/"
                                 "KHR_texture_transform/";
    expectEach({
        {{"material 0: roughnessFactor 1.00000001 is outside 0 to 1: 1 is used"},
         material("{}"),
         at("/materials/0/" + pbr + "/roughnessFactor", "1.00000001"),
         at("/materials/0/" + pbr + "/roughnessFactor", "1")},
        {{"material 0: ior 0.5 is not 0 or at least 1: 1 is used"},
         material("{}"),
         at(extension + "ior/ior", "0.5"),
         at(extension + "ior/ior", "0")},
        {{"material 0: emissiveStrength -1 is outside 0 to 3.40282e+38: 0 is used"},
         material("{}"),
         at(extension + "emissive_strength/emissiveStrength", "-1"),
         at(extension + "emissive_strength/emissiveStrength", "0")},
        {{"mesh 0, primitive 0: direction of anisotropy is arbitrary: no tangents, no texture coordinates"},
         material("{}"),
         at(extension + "anisotropy/anisotropyStrength", "0.5"),
         at(extension + "anisotropy/anisotropyStrength", "0")},
        {{"mesh 0, primitive 0: anisotropy takes the tangents of the normal map: only the clear coat's map "
          "has others"},
         sets(turned, coat + "," + brushed),
         at(extension + "anisotropy/anisotropyTexture/texCoord", "0"),
         at(extension + "anisotropy/anisotropyTexture/texCoord", "1")},
        {{"mesh 0, primitive 0: animations turn texture coordinates: the clear coat's and anisotropy's "
          "tangents keep their angle to the normal map's"},
         sets(turned, coat),
         animated(0, pointer(coat_map + "rotation"), 1, {0, 1}),
         animated(0, pointer(coat_map + "offset"), 2, {0, 0, 1, 1})},
    });
}

TEST(GltfNotes, OfTransmissionWithoutEffectComeWithTheirCauseAlone) {
    const std::string extension = "/materials/0/extensions/KHR_materials_",
                      volume =
                          "with KHR_materials_volume, but without transmission: the volume has no "
                          "effect",
                      dispersion =
                          "1 material (pane) with KHR_materials_dispersion, but without "
                          "transmission through a thickness: no effect",
                      scattering =
                          "1 material (pane) with KHR_materials_diffuse_transmission and a volume: "
                          "diffuses as a thin surface and absorbs over the thickness, scattering in "
                          "the volume is not modelled",
                      thick = R"("KHR_materials_volume": {"thicknessFactor": 0.5})",
                      half = R"("KHR_materials_transmission": {"transmissionFactor": 0.5})",
                      disperses = R"("KHR_materials_dispersion": {"dispersion": 1})",
                      diffuses =
                          R"("KHR_materials_diffuse_transmission": {"diffuseTransmissionFactor": 0.5})";
    const Change transmits = at(extension + "transmission/transmissionFactor", "0.01"),
                 opaque = at(extension + "transmission/transmissionFactor", "0");
    std::vector<NotedChange> rows{
        {{"1 material (pane) " + volume}, pane(thick), opaque, transmits},
        {{"1 material (pane) " + volume},
         pane(R"("KHR_materials_volume": {})"),
         opaque,
         at(extension + "diffuse_transmission/diffuseTransmissionFactor", "0.01")},
        {{"1 material (pane) " + volume},
         all(pane(thick), opaque),
         animated(0, pointer(extension + "volume/thicknessFactor"), 1, {0, 1}),
         animated(0, pointer(extension + "transmission/transmissionFactor"), 1, {0, 1})},
        // The note names the drawn materials, by name or index.
        {{"2 materials (pane, 2) " + volume},
         all(at("/materials", "[{\"name\": \"pane\", \"extensions\": {" + thick +
                                  "}}, {}, {\"extensions\": {" + thick +
                                  "}}, {\"name\": \"spare\", \"extensions\": {" + thick + "}}]"),
             at("/meshes/0/primitives/1", R"({"attributes": {"POSITION": 0}})")),
         all(at(primitive + "material", "0"), at("/meshes/0/primitives/1/material", "2")),
         all(at(primitive + "material", "1"), at("/meshes/0/primitives/1/material", "1"))},
        {{"1 material (pane) " + volume, dispersion}, pane(thick + "," + disperses), opaque, transmits},
        {{dispersion},
         pane(half + "," + disperses),
         at(extension + "volume/thicknessFactor", "0"),
         at(extension + "volume/thicknessFactor", "0.01")},
        {{scattering},
         pane(thick + "," + half),
         at(extension + "diffuse_transmission/diffuseTransmissionFactor", "0.01"),
         at(extension + "diffuse_transmission/diffuseTransmissionFactor", "0")},
        {{scattering},
         pane(diffuses),
         at(extension + "volume/thicknessFactor", "0.01"),
         at(extension + "volume/thicknessFactor", "0")},
    };
    for (const char* name : {"transmission", "volume", "dispersion", "diffuse_transmission"})
        rows.push_back({{"1 material (pane) with KHR_materials_unlit: light that they transmit is left out"},
                        pane(R"("KHR_materials_unlit": {})"),
                        at(extension + name, "{}"),
                        at(extension + "clearcoat", "{}")});
    expectEach(rows);
}

TEST(GltfNotes, OfScenesSkinsAndInstancesComeWithTheirCauseAlone) {
    const std::string instances = "node 0: EXT_mesh_gpu_instancing: ", who = "mesh 0, primitive 0: ";
    const auto turns = [](float first, float second) {
        return accessorAt(copies + "/ROTATION", 4, {0, 0, 0, first, 0, 0, 0, second});
    };
    expectEach({
        {{"2 scenes: scene 0 is drawn; FILE?scene=INDEX or NAME draws another"},
         nothing,
         at("/scenes/1", R"({"nodes": []})"),
         nothing},
        {{"2 scenes: scene 1 \"b\" is drawn; FILE?scene=INDEX or NAME draws another"},
         at("/scene", "1"),
         at("/scenes/1", R"({"nodes": [0], "name": "b"})"),
         at("/scene", "0")},
        {{"node 0: has a skin, but its mesh has no JOINTS_0: drawn unskinned"},
         nothing,
         all(at("/nodes/0/skin", "0"), at("/skins", R"([{"joints": [0]}])")),
         skinned},
        {{who + "1 joint weight is negative or not finite: 0 is used"},
         skinned,
         weights({1, -1e-30f, 0, 0}),
         weights({1, -0.0f, 0, 0})},
        {{who + "2 joint weights are negative or not finite: 0 is used"},
         skinned,
         weights({1, NAN, INFINITY, 0}),
         weights({1, 0, 0, 0})},
        // Rounding to 8 bits may change the sum of four weights by 4 * 0.5 / 255 = 0.00784.
        {{who + "the joint weights of 1 vertex do not add up to 1: normalized"},
         skinned,
         weights({0.992f, 0, 0, 0}),
         weights({0.9925f, 0, 0, 0})},
        {{who + "1 vertex without a joint weight: the first joint that each names is used"},
         skinned,
         weights({0, 0, 0, 0}),
         weights({0, 0, 0, 1})},
        {{instances + "the node has no mesh: left out"},
         instanced,
         [](GltfFile& f) { f.json["nodes"][0].erase("mesh"); },
         nothing},
        {{instances + "its mesh is skinned, so nodes do not move it: drawn once"},
         all(instanced, hasJoints),
         at("/nodes/0/skin", "0"),
         nothing},
        {{instances + "names no attribute: drawn once"}, instanced, at(copies, "{}"), nothing},
        {{instances + "1 rotation 0 0 0 0: no rotation is used"}, instanced, turns(1, 0), turns(1, 1e-30f)},
        {{instances + "2 rotations 0 0 0 0: no rotation is used"}, instanced, turns(0, 0), turns(1, -1)},
        {{"1 instance is not finite or beyond 1e+18 m: left out"},
         nothing,
         accessorAt(copies + "/TRANSLATION", 3, {0, 0, 0, 2e18f, 0, 0}),
         accessorAt(copies + "/TRANSLATION", 3, {0, 0, 0, 5e17f, 0, 0})},
        tooFar("drawn node", R"({"mesh": 0})"),
        tooFar("light", R"({"extensions": {"KHR_lights_punctual": {"light": 0}}})"),
        tooFar("camera", R"({"camera": 0})"),
    });
}

TEST(GltfNotes, OfAnimationsComeWithTheirCauseAlone) {
    const auto path = [](const char* name) {
        return at("/animations/0/channels/0/target/path", fmt::format("\"{}\"", name));
    };
    const Change moving = animated(0, moves, 3, {0, 0, 0, 1, 0, 0});
    const auto factor = [](const char* name, float last_key) {
        return animated(0, pointer(std::string("/materials/0/") + name), 1, {1, last_key});
    };
    const std::string fault = "animation 0: 1 of 1 channels left out: channel 0: ";
    expectEach({
        {{"2 animations: all play at once, later ones override earlier ones; --animation selects one"},
         moving,
         animated(1, moves, 3, {0, 0, 0, 0, 1, 0}),
         at("/animations/1", R"({"samplers": [], "channels": []})")},
        {{"animation 0: channel 0: several keys at one time: the last one is used"},
         nothing,
         animated(0, moves, 3, {0, 0, 0, 1, 0, 0}, {0, 0}),
         animated(0, moves, 3, {0, 0, 0, 1, 0, 0}, {0, std::numeric_limits<float>::min()})},
        {{"animation 0: channel 0: 1.5 is outside 0 to 1: the nearest value is used"},
         material("{}"),
         factor("pbrMetallicRoughness/roughnessFactor", 1.5f),
         factor("pbrMetallicRoughness/roughnessFactor", 0)},
        {{"animation 0: channel 0: ior 0.5 is not 0 or at least 1: 1 is used"},
         material(R"({"extensions": {"KHR_materials_ior": {}}})"),
         factor("extensions/KHR_materials_ior/ior", 0.5f),
         factor("extensions/KHR_materials_ior/ior", 0)},
        {{fault + "path \"size\" is not one of translation, rotation, scale, weights"},
         moving,
         path("size"),
         path("scale")},
        {{fault + "node 0 has no morph targets"},
         animated(0, moves, 1, {0, 1}),
         path("weights"),
         all(path("weights"), target("POSITION", std::vector<float>(9, 0)))},
        {{fault + "sampler 1, but the animation has 1"},
         moving,
         at("/animations/0/channels/0/sampler", "1"),
         at("/animations/0/channels/0/sampler", "0")},
    });
}

}  // namespace diptych::noted
