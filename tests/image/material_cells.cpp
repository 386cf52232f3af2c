// SPDX-License-Identifier: MIT
#include "tests/image/material_cells.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace diptych::tests {
namespace {

constexpr double degree = std::numbers::pi / 180;

// Factors that all differ, none 0 or 1.
Cell withFactors(const std::string& name) {
    Cell cell;
    cell.name = name;
    cell.base_color = {0.9, 0.6, 0.4, 1};
    cell.metallic = 0.55;
    cell.roughness = 0.8;
    cell.normal_scale = 0.7;
    cell.occlusion_strength = 0.65;
    cell.emissive = {0.3, 0.5, 0.2};
    cell.emissive_strength = 2.5;
    cell.ior = 1.8;
    cell.specular = 0.85;
    cell.specular_color = {0.5, 1.5, 0.75};
    cell.lightmap_intensity = 1.25;
    return cell;
}

Cell withTextures(const std::string& name) {
    Cell cell = withFactors(name);
    for (std::size_t slot = 0; slot < cell.textures.size(); ++slot)
        cell.textures[slot].image = static_cast<int>(slot);
    return cell;
}

// A different one for each slot: rotation, scale and offset.
CellTexture::Transform transformOf(std::size_t slot) {
    const auto i = static_cast<double>(slot);
    return {{0.13 + 0.11 * i, 0.29 - 0.07 * i}, (20 + 29 * i) * degree, {0.8 + 0.05 * i, 1.2 - 0.06 * i}, {}};
}

bool transformable(std::size_t slot) {
    return slot != gpu::SLOT_lightmap;  // extras name no transform
}

// The same factors and textures with each use of texture coordinates.
void addCoordinates(std::vector<Cell>& cells) {
    const auto add = [&](const char* name, const auto& change) {
        Cell cell = withTextures(name);
        for (std::size_t slot = 0; slot < cell.textures.size(); ++slot) change(cell.textures[slot], slot);
        cells.push_back(cell);
    };
    using Use = CellTexture;
    add("first UV set", [](Use&, std::size_t) {});
    add("second UV set", [](Use& use, std::size_t) { use.texcoord = 1; });
    add("UV sets in turn", [](Use& use, std::size_t slot) { use.texcoord = slot % 2; });
    add("UV sets in turn, the other way", [](Use& use, std::size_t slot) { use.texcoord = 1 - slot % 2; });
    add("UV sets in pairs", [](Use& use, std::size_t slot) { use.texcoord = slot / 2 % 2; });
    add("transforms", [](Use& use, std::size_t slot) {
        if (transformable(slot)) use.transform = transformOf(slot);
    });
    add("transforms of the second UV set", [](Use& use, std::size_t slot) {
        use.texcoord = 1;
        if (transformable(slot)) use.transform = transformOf(slot);
    });
    add("transforms in turn", [](Use& use, std::size_t slot) {
        if (transformable(slot) && slot % 2 == 0) use.transform = transformOf(slot);
    });
    add("transforms in turn, the other way", [](Use& use, std::size_t slot) {
        if (transformable(slot) && slot % 2 == 1) use.transform = transformOf(slot);
    });
    add("offsets", [](Use& use, std::size_t slot) {
        if (transformable(slot)) use.transform = {transformOf(slot).offset, 0, {1, 1}, {}};
    });
    add("rotations", [](Use& use, std::size_t slot) {
        if (transformable(slot)) use.transform = {{0, 0}, transformOf(slot).rotation, {1, 1}, {}};
    });
    add("scales", [](Use& use, std::size_t slot) {
        if (transformable(slot)) use.transform = {{0, 0}, 0, transformOf(slot).scale, {}};
    });
    for (const int set : {0, 1})
        add(set == 0 ? "the transform's UV set is the first" : "the transform's UV set is the second",
            [&](Use& use, std::size_t slot) {
                use.texcoord = 1 - set;
                if (!transformable(slot)) return;
                use.transform = transformOf(slot);
                use.transform->texcoord = set;
            });
}

void addSlots(std::vector<Cell>& cells) {
    // Any two slots differ in one of the first three cells; the last textures only the first slot.
    static_assert(cellSlots == 8);
    for (int bit = 0; bit < 4; ++bit) {
        Cell cell = withFactors("textures in the slots of bit " + std::to_string(bit));
        for (int slot = 0; slot < static_cast<int>(cellSlots); ++slot)
            if (bit == 3 ? slot == 0 : (slot >> bit & 1) == 1)
                cell.textures[static_cast<std::size_t>(slot)] = {slot, 1, {}};
        cells.push_back(cell);
    }
    // One image as sRGB and as linear, except in the normal slot: its colours are not normals.
    Cell shared = withTextures("one image in every slot");
    for (CellTexture& use : shared.textures)
        if (use.image != gpu::SLOT_normal) use.image = gpu::SLOT_base_color;
    cells.push_back(shared);
}

void addFactors(std::vector<Cell>& cells) {
    Cell plain;
    plain.name = "nothing stated";
    cells.push_back(plain);
    cells.push_back(withFactors("factors"));
    Cell ones = withTextures("textures with factors of one");
    ones.base_color = glm::dvec4(1);
    ones.metallic = ones.roughness = ones.normal_scale = ones.occlusion_strength = 1;
    ones.emissive = ones.specular_color = glm::dvec3(1);
    ones.specular = ones.lightmap_intensity = 1;
    ones.emissive_strength.reset();
    ones.ior.reset();
    cells.push_back(ones);
    const auto add = [&](const char* name, const auto& change) {
        cells.push_back(withTextures(name));
        change(cells.back());
    };
    add("normal scale 1.6", [](Cell& c) { c.normal_scale = 1.6; });
    add("normal scale -0.5", [](Cell& c) { c.normal_scale = -0.5; });
    add("normal scale 0", [](Cell& c) { c.normal_scale = 0; });
    add("no occlusion", [](Cell& c) { c.occlusion_strength = 0; });
    add("ior 0", [](Cell& c) { c.ior = 0; });
    add("ior 1", [](Cell& c) { c.ior = 1; });
    add("no metal", [](Cell& c) { c.metallic = 0; });
    add("no specular", [](Cell& c) { c.specular = 0; });
    add("emissive strength 40", [](Cell& c) { c.emissive_strength = 40; });
    add("unlit", [](Cell& c) { c.unlit = true; });
}

void addColors(std::vector<Cell>& cells) {
    // 51, 102, 204 and 153 of 255 are fifths.
    for (const CellColors kind :
         {CellColors::floats, CellColors::bytes, CellColors::shorts, CellColors::rgb}) {
        Cell cell = kind == CellColors::rgb ? withFactors("vertex colours") : withTextures("vertex colours");
        cell.colors = kind;
        cell.color = {0.2, 0.4, 0.8, kind == CellColors::rgb ? 1 : 0.6};
        cells.push_back(cell);
    }
    cells.push_back(cells[cells.size() - 2]);
    cells.back().name = "vertex colours, unlit";
    cells.back().unlit = true;
}

// Alpha equal to the cutoff is opaque.
void addMasks(std::vector<Cell>& cells) {
    const auto add = [&](const char* name, std::optional<double> cutoff, double factor, double vertex) {
        Cell cell = withTextures(name);
        cell.masked = true;
        cell.alpha_cutoff = cutoff;
        cell.base_color.a = factor;
        if (vertex < 1) cell.colors = CellColors::floats;
        cell.color.a = vertex;
        cells.push_back(cell);
    };
    // The alpha of texels of the base colour image, as a file would write it.
    for (const glm::ivec2 texel : {glm::ivec2(1, 0), glm::ivec2(2, 1), glm::ivec2(0, 3)}) {
        const int code = codesAt(gpu::SLOT_base_color, texel.x, texel.y).a;
        add("cutoff of a texel's alpha", double{static_cast<float>(code / 255.0)}, 1, 1);
    }
    add("cutoff of the opaque texel's alpha", 1, 1, 1);
    add("cutoff of half the opaque texel's alpha", 0.5, 0.5, 1);
    // Perspective interpolation rounds even values that are equal at all vertices.
    add("cutoff below half the opaque texel's alpha, by the vertices", 0.499, 1, 0.5);
    add("cutoff not stated", {}, 1, 1);
    Cell edge = withFactors("cutoff of the factor");
    edge.masked = true;
    edge.base_color.a = 0.3;
    edge.alpha_cutoff = 0.3;
    cells.push_back(edge);
    edge.name = "cutoff above the factor";
    edge.alpha_cutoff = 0.3 + 1e-6;
    cells.push_back(edge);
}

// F0 is at most a half, because float32 loses digits in 1 - F0.
void addSpecularGlossiness(std::vector<Cell>& cells) {
    Cell cell = withFactors("specular-glossiness");
    cell.specular_glossiness = true;
    cell.roughness = 0.4;
    cell.specular_color = {0.35, 0.5, 0.2};
    cells.push_back(cell);
    cell.name = "specular-glossiness with textures";
    cell.textures = withTextures("").textures;
    cell.textures[gpu::SLOT_metallic_roughness] = cell.textures[gpu::SLOT_specular] = {};
    cell.textures[gpu::SLOT_specular_color].texcoord = 1;
    cell.textures[gpu::SLOT_specular_color].transform = transformOf(gpu::SLOT_specular_color);
    cells.push_back(cell);
}

void addGeometry(std::vector<Cell>& cells) {
    const auto add = [&](const char* name, const auto& change) {
        cells.push_back(withTextures(name));
        change(cells.back());
    };
    add("tangents of the file", [](Cell& c) { c.tangent_angle = 20 * degree; });
    add("bitangents turned", [](Cell& c) { c.tangent_w = -1; });
    add("tangents made", [](Cell& c) { c.tangents_made = true; });
    add("tangents made of the second UV set", [](Cell& c) {
        c.tangents_made = true;
        c.textures[gpu::SLOT_normal].texcoord = 1;
    });
    add("tangents made, the map turned", [](Cell& c) {
        c.tangents_made = true;
        c.textures[gpu::SLOT_normal].transform = transformOf(gpu::SLOT_normal);
    });
    add("tangents made, the map mirrored", [](Cell& c) {
        c.tangents_made = true;
        c.textures[gpu::SLOT_normal].transform = {{1, 0}, 0, {-1, 1}, {}};
    });
    add("mirrored in x", [](Cell& c) { c.scale = {-1, 1, 1}; });
    add("mirrored in y", [](Cell& c) {
        c.scale = {1, -1, 1};
        c.tangent_angle = 20 * degree;
        c.tangent_w = -1;
    });
    add("mirrored in x, tangents made", [](Cell& c) {
        c.scale = {-1, 1, 1};
        c.tangents_made = true;
    });
    add("turned and stretched", [](Cell& c) {
        c.scale = {2, 0.5, 3};
        c.tangent_angle = 30 * degree;
    });
    add("double-sided, from the front", [](Cell& c) { c.double_sided = true; });
    add("double-sided, from behind", [](Cell& c) { c.double_sided = c.turned = true; });
    add("double-sided, mirrored, from behind", [](Cell& c) {
        c.double_sided = true;
        c.scale = {1, 1, -1};
        c.tangent_angle = 20 * degree;
    });
    add("double-sided, from behind, no normal texture", [](Cell& c) {
        c = withFactors(c.name);
        c.double_sided = c.turned = true;
    });
    add("double-sided mask, from behind", [](Cell& c) { c.double_sided = c.masked = c.turned = true; });
    add("single-sided, from behind", [](Cell& c) { c.turned = true; });
}

}  // namespace

glm::dmat3 Cell::node() const {
    const double side = turned ? -1 : 1;
    return {side * scale.x, 0, 0, 0, scale.y, 0, 0, 0, side * scale.z};
}

glm::dmat3 CellCamera::axes() const {
    const double a = tilt.x, b = tilt.y;
    const glm::dvec3 right(std::cos(a), 0, -std::sin(a)), level(std::sin(a), 0, std::cos(a)), up(0, 1, 0);
    return {right, up * std::cos(b) + level * std::sin(b), level * std::cos(b) - up * std::sin(b)};
}

const std::vector<CellCamera>& cellCameras() {
    // Eight rows of cells, or three at the centre of the same wall. Perspective with ambient light,
    // orthographic without: all four combinations would need pipelines of their own.
    static const std::vector<CellCamera> all{
        {.name = "Landscape", .eye = {0.3, -0.2, 10}, .all = true, .ambient = 0.3f},
        {.name = "Portrait", .eye = {-0.2, 2.4, 8}, .half = 5.6, .size = {160, 208}, .ambient = 0.3f},
        {.name = "OrthographicLandscape",
         .orthographic = true,
         .eye = {0.1, 2.2, 3},
         .half = 2.2,
         .size = {176, 96}},
        {.name = "OrthographicPortrait",
         .orthographic = true,
         .eye = {-1, 1.5, 5},
         .half = 5.6,
         .tilt = {-0.2, 0.15},
         .size = {160, 208}},
        {.name = "Tilted",
         .eye = {3, 4, 9},
         .half = 2.6,
         .tilt = {0.35, -0.2},
         .size = {208, 112},
         .ambient = 0.3f},
    };
    return all;
}

const std::vector<Cell>& materialCells() {
    static const std::vector<Cell> all = [] {
        std::vector<Cell> cells;
        addFactors(cells);
        addCoordinates(cells);
        addSlots(cells);
        addColors(cells);
        addMasks(cells);
        addGeometry(cells);
        addSpecularGlossiness(cells);
        return cells;
    }();
    return all;
}

const std::vector<Cell>& fewMaterialCells() {
    static const std::vector<Cell> few = [] {
        std::vector<Cell> cells;
        for (const char* name : {"factors",
                                 "textures with factors of one",
                                 "normal scale 1.6",
                                 "unlit",
                                 "first UV set",
                                 "second UV set",
                                 "cutoff of the opaque texel's alpha",
                                 "transforms",
                                 "transforms of the second UV set",
                                 "the transform's UV set is the first",
                                 "one image in every slot",
                                 "cutoff of a texel's alpha",
                                 "cutoff below half the opaque texel's alpha, by the vertices",
                                 "bitangents turned",
                                 "tangents made",
                                 "tangents made, the map turned",
                                 "tangents made, the map mirrored",
                                 "mirrored in x",
                                 "mirrored in y",
                                 "mirrored in x, tangents made",
                                 "turned and stretched",
                                 "double-sided, from behind",
                                 "double-sided, mirrored, from behind",
                                 "vertex colours",
                                 "cutoff of half the opaque texel's alpha",
                                 "single-sided, from behind",
                                 "specular-glossiness",
                                 "specular-glossiness with textures"})
            cells.push_back(*std::ranges::find(materialCells(), name, &Cell::name));
        return cells;
    }();
    return few;
}

}  // namespace diptych::tests
