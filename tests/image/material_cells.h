// SPDX-License-Identifier: MIT
// A wall of square cells, each with a material of its own, as a glTF file that is written here and read by
// the loader; and what glTF says every pixel of it is, in closed form: loader, upload, shaders and reference
// are all held against it. Textures are of 4 x 4 texels and not filtered.
#pragma once

#include "shared/contract/material.h"
#include "shared/scene/model/scene.h"

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

namespace diptych::tests {

// A texture slot in the file.
struct CellTexture {
    int picture = -1;  // -1: no texture; otherwise the picture of this slot, or a slot's of another number
    int texcoord = 0;
    struct Transform {
        glm::dvec2 offset{0};
        double rotation = 0;  // rad
        glm::dvec2 scale{1};
        std::optional<int> texcoord;  // replaces the one outside
    };
    std::optional<Transform> transform;
};

enum class CellColors { none, floats, bytes, shorts, rgb };  // COLOR_0's components

struct Cell {
    std::string name;
    std::array<CellTexture, gpu::SLOT_COUNT> textures{};  // by SLOT_*
    glm::dvec4 base_color{1};
    double metallic = 1, roughness = 1, normal_scale = 1, occlusion_strength = 1, lightmap_intensity = 1;
    glm::dvec3 emissive{0};
    std::optional<double> emissive_strength, ior, alpha_cutoff;  // absent: the extension or property is
    double specular = 1;
    glm::dvec3 specular_color{1};
    bool masked = false, double_sided = false, unlit = false;
    CellColors colors = CellColors::none;
    glm::dvec4 color{1};  // the same at all corners; what its components can hold
    // Of the node, along the axes of the square's object space, where it faces +Z as the wall does.
    glm::dvec3 scale{1};
    bool turned = false;         // about Y by half a turn
    bool tangents_made = false;  // the file has none
    double tangent_angle = 0;    // of the file's, from +X towards +Y, rad
    double tangent_w = 1;

    glm::dmat3 node() const;  // object space to the wall's axes
    bool fromBehind() const { return (scale.z < 0) != turned; }
};

// All of them, and a few of every kind, which need fewer pipelines. They hang in rows of eight, in the order
// of their materials.
const std::vector<Cell>& materialCells();
const std::vector<Cell>& fewMaterialCells();
constexpr int cellsAcross = 8;

// The cameras of the file. All but the tilted ones look straight at the wall.
struct CellCamera {
    const char* name;
    bool orthographic = false;
    glm::dvec3 eye{0, 0, 10};
    double half = 4.3;          // half the picture's height at the wall, m
    glm::dvec2 tilt{0};         // about Y, then about the camera's own X, rad
    glm::ivec2 size{208, 160};  // of its picture
    bool all = false;           // it draws all cells; otherwise a few
    float ambient = 0;          // of its picture, W/(sr m^2)

    glm::dmat3 axes() const;  // right, up, backward
    friend void PrintTo(const CellCamera& camera, std::ostream* out) { *out << camera.name; }
};
const std::vector<CellCamera>& cellCameras();

// The scene of a glTF file with these cells and the cameras, under a sun and a lamp.
Scene materialScene(const std::vector<Cell>& cells);

// Codes 0 to 255 of the picture of a slot.
glm::ivec4 codesAt(int picture, int column, int row);

// Decoded values of codes; exact by default.
struct CellDecode {
    std::function<double(int)> srgb, linear;
};
CellDecode exactDecode();

// What is seen at a place of the picture in pixels, (0, 0) being its upper left corner.
struct CellPlace {
    int cell = -1;           // -1: beside the wall
    glm::dvec2 at{0};        // in the cell, from its upper left corner, 0 to 1
    glm::dvec3 position{0};  // from the camera
    double depth = 0;
};
CellPlace cellPlace(const std::vector<Cell>& cells, const CellCamera& camera, const glm::dvec2& pixel);

// Column and row of the texel that a slot of the cell shows there.
glm::ivec2 texelAt(const Cell& cell, std::size_t slot, const glm::dvec2& at);

// Values by channel (DEBUG_*), each of as many components as the channel has; nothing where the cell has a
// hole.
std::optional<std::map<int, std::vector<double>>> cellValues(const Cell& cell, const CellPlace& place,
                                                             const CellDecode& decode);

}  // namespace diptych::tests
