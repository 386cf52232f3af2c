// SPDX-License-Identifier: MIT
// A wall of square cells, each with its own material, as a glTF file that the loader reads. glTF defines
// every pixel of it in closed form; loader, upload, shaders and reference are compared with that. Textures
// have 4 x 4 texels and no filter.
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

// Slots of the base; layers_test.cpp proves those of layers.
inline constexpr std::size_t cellSlots = gpu::SLOT_lightmap + 1;

// A texture slot in the file.
struct CellTexture {
    int image = -1;  // index of the image, by slot; -1: no texture
    int texcoord = 0;
    struct Transform {
        glm::dvec2 offset{0};
        double rotation = 0;  // radians
        glm::dvec2 scale{1};
        std::optional<int> texcoord;  // overrides the outer one
    };
    std::optional<Transform> transform;
};

enum class CellColors { none, floats, bytes, shorts, rgb };  // COLOR_0's components

struct Cell {
    std::string name;
    std::array<CellTexture, cellSlots> textures{};  // by SLOT_*
    glm::dvec4 base_color{1};
    double metallic = 1, roughness = 1, normal_scale = 1, occlusion_strength = 1, lightmap_intensity = 1;
    glm::dvec3 emissive{0};
    std::optional<double> emissive_strength, ior, alpha_cutoff;  // absent: not in the file
    double specular = 1;
    glm::dvec3 specular_color{1};
    bool masked = false, double_sided = false, unlit = false;
    // Written as KHR_materials_pbrSpecularGlossiness: diffuse is base_color, F0 specular_color, glossiness
    // 1 - roughness; the slots base_color and specular_color hold its textures.
    bool specular_glossiness = false;
    CellColors colors = CellColors::none;
    glm::dvec4 color{1};  // the same at all vertices, exactly representable
    // The node's, along the axes of the square's object space, in which it faces +Z like the wall.
    glm::dvec3 scale{1};
    bool turned = false;         // by 180 degrees about Y
    bool tangents_made = false;  // the file has none
    double tangent_angle = 0;    // in the file, from +X towards +Y, radians
    double tangent_w = 1;

    glm::dmat3 node() const;  // object space to the wall's axes
    bool fromBehind() const { return (scale.z < 0) != turned; }
};

// All cells, and a few of every kind, which need fewer pipelines. Arranged in rows of eight, in the order
// of their materials.
const std::vector<Cell>& materialCells();
const std::vector<Cell>& fewMaterialCells();
constexpr int cellsAcross = 8;

// The cameras of the file. All but the tilted ones face the wall.
struct CellCamera {
    const char* name;
    bool orthographic = false;
    glm::dvec3 eye{0, 0, 10};
    double half = 4.3;          // half the image's height at the wall, m
    glm::dvec2 tilt{0};         // about Y, then about the camera's own X, radians
    glm::ivec2 size{208, 160};  // of its image
    bool all = false;           // renders all cells; otherwise a few
    float ambient = 0;          // ambient light of its image, W/(sr m^2)

    glm::dmat3 axes() const;  // right, up, backward
    friend void PrintTo(const CellCamera& camera, std::ostream* out) { *out << camera.name; }
};
const std::vector<CellCamera>& cellCameras();

// The scene of a glTF file with these cells and the cameras, a sun and a lamp.
Scene materialScene(const std::vector<Cell>& cells);

// Codes (0 to 255) of an image.
glm::ivec4 codesAt(int image, int column, int row);

// Decoded values of codes; exact by default.
struct CellDecode {
    std::function<double(int)> srgb, linear;
};
CellDecode exactDecode();

// The surface at a position in the image, in pixels from the upper left corner.
struct CellPosition {
    int cell = -1;           // -1: beside the wall
    glm::dvec2 at{0};        // in the cell, from its upper left corner, 0 to 1
    glm::dvec3 position{0};  // from the camera
    double depth = 0;
};
CellPosition cellPosition(const std::vector<Cell>& cells, const CellCamera& camera, const glm::dvec2& pixel);

// Column and row of the texel of the slot's texture there.
glm::ivec2 texelAt(const Cell& cell, std::size_t slot, const glm::dvec2& at);

// Values by channel (DEBUG_*), one per component of the channel; nothing in a hole of the cell.
std::optional<std::map<Channel, std::vector<double>>> cellValues(const Cell& cell, const CellPosition& place,
                                                                 const CellDecode& decode);

}  // namespace diptych::tests
