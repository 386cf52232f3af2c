// SPDX-License-Identifier: MIT
// Test scenes about surface properties that a G-buffer must store.
#include "shared/scene/builtin/scenes.h"
#include "shared/scene/builtin/textures.h"
#include "shared/scene/lights/rig.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

namespace diptych::builtin {
namespace {

// Key, fill and rim lights: three sharp highlights on every sphere.
void studio(Builder& b) {
    b.sun({-0.4, -0.8, -0.6}, glm::vec3(1), 2);
    b.point({-4, 3, 5}, {1.0f, 0.75f, 0.5f}, 30, 20);
    b.point({5, -1, 4}, {0.5f, 0.7f, 1.0f}, 20, 20);
}

}  // namespace

// Octahedral encodings have seams in the planes x = 0, y = 0 and z = 0; every sphere crosses some. The
// insides of the bowls show the normals that no outside shows. Roughness of 0.05 to 0.3 makes quantization
// steps visible.
void normals(Builder& b) {
    b.camera("front", {0.7, 0.9, 7}, {0, 0, 0}, 32, 0.1, 100);
    const Primitive ball = sphere(0.6, 96, 48);
    Primitive bowl = ball;  // inverted
    for (std::size_t i = 0; i < bowl.indices.size(); i += 3) std::swap(bowl.indices[i], bowl.indices[i + 1]);
    for (glm::vec3& n : bowl.normals) n = -n;
    for (glm::vec4& t : bowl.tangents) t.w = -t.w;
    for (int i = 0; i < 5; ++i) {
        const float roughness = 0.05f + 0.0625f * static_cast<float>(i);
        const int material =
            b.material(fmt::format("roughness {:.4f}", roughness), {{0.6f, 0.6f, 0.65f}, 1, roughness});
        b.add("ball", ball, material, at(1.3 * (i - 2), 0.75, 0) * rotated(17.0 * i, {1, 2, 3}));
        b.add("bowl", bowl, material, glm::dvec3(1.3 * (i - 2), -0.75, 0));
    }
    b.scene.background = glm::vec3(0.05f);
    studio(b);
    for (int i = 0; i < 6; ++i) b.point({2.4 * (i - 2.5), 2.0 - i % 2 * 4, 3.5}, glm::vec3(1), 6, 9);
}

// Columns: radiance 1e-6 to 1e6 by decades. Rows: grey; one strong component and two at a thousandth of
// it, beyond a shared exponent; textured, so that values between 0 and the factor occur.
void emission(Builder& b) {
    b.camera("front", {0, 0, 10}, {0, 0, 0}, 24, 0.1, 100);
    const TextureSlot signs = b.texture(glyphs("signs", 256));
    for (int column = 0; column < 13; ++column) {
        const auto radiance = static_cast<float>(std::pow(10.0, column - 6));
        const double x = 0.54 * (column - 6);
        const auto panel = [&](double y, const glm::vec3& tint) {
            const int material = b.material(fmt::format("1e{} {}", column - 6, y),
                                            {glm::vec3(0.1f), 0, 0.6f, tint * radiance});
            b.add("panel", quad({x - 0.24, y - 0.5, 0}, {0.48, 0, 0}, {0, 1, 0}), material);
        };
        panel(1.1, glm::vec3(1));
        panel(0, {1.0f, 0.001f, 0.03f});
        panel(-1.1, glm::vec3(1));
        b.last().emissive_texture = signs;
    }
    b.sun({-0.3, -0.5, -1}, glm::vec3(1), 1);
}

// Ramps by vertex colour, which is not limited to 8 bits. The upper rows run from 0 to 0.05 (13 steps in 8
// linear bits), the lower from 0 to 1. Each half has a ramp per component and a grey one.
void darkAlbedo(Builder& b) {
    b.camera("front", {0, 0, 5}, {0, 0, 0}, 30, 0.1, 100);
    const int white = b.material("ramps", {glm::vec3(1), 0, 0.9f});
    for (int row = 0; row < 8; ++row) {
        const float top = row < 4 ? 0.05f : 1.0f;
        const glm::vec3 mask =
            row % 4 == 3 ? glm::vec3(1) : glm::vec3(row % 4 == 0, row % 4 == 1, row % 4 == 2);
        Primitive ramp = quad({-2.2, 0.9 - 0.3 * row, 0}, {4.4, 0, 0}, {0, 0.26, 0}, 16, 1);
        b.add(fmt::format("ramp {}", row),
              paint(std::move(ramp),
                    [=](const glm::vec3& p) { return glm::vec4(mask * top * ((p.x + 2.2f) / 4.4f), 1); }),
              white);
    }
    b.sun({0.2, -0.3, -1}, glm::vec3(1), 20);  // bright, so that steps in dark colours become visible
    b.point({-1.5, 1, 1}, {1.0f, 0.8f, 0.6f}, 10, 5);
}

// Columns: index of refraction. Rows: specular 1, 0.5, 0, and a tint beyond 1, which is clamped after the
// product.
void dielectrics(Builder& b) {
    b.camera("front", {0, 0.2, 9}, {0, 0, 0}, 31, 0.1, 100);
    const Primitive ball = sphere(0.46, 64, 32);
    const float iors[] = {1.0f, 1.1f, 1.33f, 1.5f, 1.8f, 2.4f, 0.0f};  // 0: infinite
    const float speculars[] = {1.0f, 0.5f, 0.0f, 1.0f};
    for (int row = 0; row < 4; ++row)
        for (int column = 0; column < 7; ++column) {
            b.material(
                fmt::format("ior {} specular {}{}", iors[column], speculars[row], row == 3 ? " tinted" : ""),
                {{0.25f, 0.05f, 0.08f}, 0, column % 2 == 0 ? 0.15f : 0.35f});
            Material& material = b.last();
            material.ior = iors[column];
            material.specular = speculars[row];
            if (row == 3) material.specular_color = {4.0f, 1.0f, 0.25f};
            b.add(material.name, ball, row * 7 + column,
                  glm::dvec3(1.1 * (column - 3), 1.1 * (1.5 - row), 0));
        }
    studio(b);
}

// Leaves and lattices with normal maps, seen from the front, edge-on, from behind, and overlapping.
void cutout(Builder& b) {
    b.camera("low", {0, 1.1, 5}, {0, 0.8, 0}, 42, 0.05, 100);
    b.scene.background = {0.04f, 0.05f, 0.08f};
    const TextureSlot relief = b.texture(normalMap("relief", weaveHeights(256), 24), 2);
    const auto masked = [&](const std::string& name, TextureImage image, double tiles, bool doubleSided) {
        const int made = b.material(name, {glm::vec3(1), 0, 0.4f});
        Material& material = b.last();
        material.base_color_texture = b.texture(std::move(image), tiles);
        material.normal_texture = relief;
        material.alpha_mode = AlphaMode::mask;
        material.double_sided = doubleSided;
        return made;
    };
    const int leaves = masked("leaf", leaf("leaf", 256), 1, true);
    const int oneSided = masked("leaf, one side", leaf("leaf, one side", 256), 1, false);
    const int screen = masked("lattice", lattice("lattice", 256), 2, true);
    const Primitive card = quad({-0.5, 0, 0}, {1, 0, 0}, {0, 1.5, 0});
    for (int i = 0; i < 9; ++i) {
        const double angle = 22.5 * i;  // from front to edge-on (90 degrees) to back
        b.add("leaf", card, leaves, at(-3.2 + 0.8 * i, 0.9, -0.6) * rotated(angle));
        b.add("leaf, one side", card, oneSided,
              at(-3.2 + 0.8 * i, -0.3, 0.6) * rotated(angle) * scaled(0.7, 0.7, 0.7));
    }
    b.add("screen", quad({-2, 0, 0}, {4, 0, 0}, {0, 2, 0}), screen, at(0, 0, -1.6));
    b.add("screen along the view", quad({-2.5, 0, 0}, {5, 0, 0}, {0, 2, 0}), screen,
          at(1.4, 0, 1) * rotated(84));
    b.add("screen underfoot", quad({-4, 0, 4}, {8, 0, 0}, {0, 0, -8}), screen);
    // Lit from behind, because normals of double-sided materials flip.
    b.point({0, 1.6, -3}, {1.0f, 0.7f, 0.4f}, 14, 10);
    b.point({-2, 2, 2.5}, {0.6f, 0.8f, 1.0f}, 12, 10);
    b.sun({0.4, -0.6, -0.7}, glm::vec3(1), 1);
}

// The upper tiles have occlusion maps of strength 0, 0.5 and 1, the lower ones none. Without ambient
// light, all must look alike.
void occlusion(Builder& b) {
    b.camera("front", {0, 0, 5}, {0, 0, 0}, 34, 0.1, 100);
    const TextureSlot map = b.texture(diptych::occlusion("depths", brickHeights(256)));
    const Primitive tile = quad({-0.62, -0.62, 0}, {1.24, 0, 0}, {0, 1.24, 0});
    for (int column = 0; column < 3; ++column) {
        const int open = b.material(fmt::format("open {}", column), {{0.6f, 0.5f, 0.4f}, 0, 0.5f});
        const int occluded = b.material(fmt::format("occluded {}", column), {{0.6f, 0.5f, 0.4f}, 0, 0.5f});
        b.last().occlusion_texture = map;
        b.last().occlusion_strength = 0.5f * static_cast<float>(column);
        b.add("occluded", tile, occluded, glm::dvec3(1.35 * (column - 1), 0.68, 0));
        b.add("open", tile, open, glm::dvec3(1.35 * (column - 1), -0.68, 0));
    }
    b.sun({-0.2, 0, -1}, glm::vec3(1), 2);  // in the plane of symmetry between the rows
    b.point({0, 0, 1.5}, {1.0f, 0.8f, 0.5f}, 3, 6);
}

// 100 x 50 tiles with one material each: 10 bits hold 1024 material ids, 12 bits 4096. Adjacent tiles
// differ in every factor.
void manyMaterials(Builder& b) {
    b.camera("front", {0, 0, 10}, {0, 0, 0}, 30, 0.1, 100);
    const Primitive tile = quad({-0.045, -0.045, 0}, {0.09, 0, 0}, {0, 0.09, 0});
    for (std::uint32_t i = 0; i < 5000; ++i) {
        const glm::dvec3 color(u01(4 * i), u01(4 * i + 1), u01(4 * i + 2));
        const int material =
            b.material(fmt::format("material {}", i), {glm::vec3(color), static_cast<float>(i % 3) / 2,
                                                       static_cast<float>(0.1 + 0.9 * u01(4 * i + 3))});
        b.add("tile", tile, material, glm::dvec3(0.09 * (i % 100 - 49.5), 0.1 * (24.5 - i / 100), 0));
    }
    studio(b);
}

// Three rows of cards under grazing light, 16 bits on the left, 8 bits on the right. Rows: a dark ramp of
// base colour (8 bits: five steps), a normal map of waves 1/100 high (8 bits: terraces), a narrow
// roughness ramp on metal (8 bits: bands).
void sixteenBits(Builder& b) {
    b.camera("front", {0, 0, 6}, {0, 0, 0}, 34, 0.1, 100);
    const auto slot = [&](const std::string& name, bool deep, const auto& texel) {
        TextureImage image{name, 64, 64, {}};
        for (int y = 0; y < 64; ++y)
            for (int x = 0; x < 64; ++x)
                for (const double value : texel(x, y)) {
                    const double top = deep ? 65535 : 255;
                    const auto code = static_cast<int>(std::lround(value * top));
                    if (deep)
                        image.rgba16.push_back(static_cast<std::uint16_t>(code));
                    else
                        image.rgba.push_back(static_cast<std::uint8_t>(code));
                }
        return b.texture(std::move(image));
    };
    using Texel = std::array<double, 4>;
    const auto dark = [](int x, int y) { return Texel{x / 3200.0, y / 3200.0, (x + y) / 6400.0, 1}; };
    const auto waves = [](int x, int) {
        const int t = x % 32;  // a triangle wave; integers, so exact with any C library
        return Texel{0.5 + 0.01 * (t < 16 ? t - 8 : 24 - t) / 8.0, 0.5, 1, 1};
    };
    const auto rough = [](int x, int y) { return Texel{1, 0.2 + (x + y) / 6400.0, 1, 1}; };
    const Primitive card = quad({-0.7, -0.5, 0}, {1.4, 0, 0}, {0, 1, 0});
    for (const bool deep : {true, false})
        for (int row = 0; row < 3; ++row) {
            const int made = b.material(fmt::format("{} bits, row {}", deep ? 16 : 8, row),
                                        {glm::vec3(0.8f), row == 2 ? 1.0f : 0.0f, row == 2 ? 1.0f : 0.3f});
            if (row == 0) b.last().base_color_texture = slot("dark", deep, dark);
            if (row == 1) b.last().normal_texture = slot("waves", deep, waves);
            if (row == 2) b.last().metallic_roughness_texture = slot("rough", deep, rough);
            b.add("card", card, made, glm::dvec3(deep ? -0.8 : 0.8, 1.1 * (1 - row), 0));
        }
    b.sun({0.9, -0.1, -0.3}, glm::vec3(1), 4);
    b.point({-3, 1, 2}, glm::vec3(1), 30, 20);
}

// Unlit cards among lit ones. Their other parameters must be ignored, and would be visible otherwise.
// Cards: base colour, texture, vertex colours, cutout, cutout by the colour's alpha, seen from behind.
void unlitMaterials(Builder& b) {
    b.camera("front", {0, 0.3, 7.5}, {0, 0, 0}, 34, 0.1, 100);
    b.scene.background = {0.04f, 0.05f, 0.08f};
    const TextureSlot checks =
        b.texture(checker("checker", 128, 8, {250, 180, 40, 255}, {30, 60, 160, 255}), 1);
    const TextureSlot openings = b.texture(lattice("lattice", 256), 1);
    const TextureSlot relief = b.texture(normalMap("relief", weaveHeights(256), 24), 2);
    const TextureSlot depths = b.texture(diptych::occlusion("depths", brickHeights(256)));
    const Primitive card = quad({-0.55, -0.55, 0}, {1.1, 0, 0}, {0, 1.1, 0}, 8, 8);
    const auto rainbow = [](const glm::vec3& p) { return glm::vec4(0.5f + 0.8f * p, 0.5f + 0.8f * p.x); };
    for (const bool unlit : {true, false})
        for (int i = 0; i < 6; ++i) {
            if (!unlit && i % 3 != 0) continue;
            const int made = b.material(fmt::format("{} {}", unlit ? "unlit" : "lit", i),
                                        {{0.9f, 0.6f, 0.3f}, 0.8f, 0.3f, {0.4f, 0, 0.6f}});
            Material& m = b.last();
            m.unlit = unlit;
            m.normal_texture = relief;
            m.occlusion_texture = m.metallic_roughness_texture = depths;
            m.specular_color = {1.5f, 0.5f, 1};
            if (i == 1 || i == 5) m.base_color_texture = checks;
            if (i == 3) m.base_color_texture = openings;
            if (i == 3 || i == 4) m.alpha_mode = AlphaMode::mask;
            m.double_sided = i >= 3;
            const bool painted = i == 2 || i == 4;
            b.add(m.name, painted ? paint(Primitive(card), rainbow) : card, made,
                  at(1.25 * (i - 2.5), unlit ? 0.6 : -0.6, 0) * rotated(i == 5 ? 180 : 12.0 * (i - 2)));
        }
    studio(b);
}

void vertexColors(Builder& b) {
    b.camera("front", {0, 0.6, 5}, {0, 0, 0}, 34, 0.1, 100);
    const int plain = b.material("plain", {glm::vec3(1), 0, 0.3f});
    const int textured = b.material("textured", {{0.9f, 0.9f, 0.7f}, 0, 0.5f});
    b.last().base_color_texture =
        b.texture(checker("checker", 128, 8, {240, 240, 240, 255}, {120, 120, 120, 255}), 2);
    const auto rainbow = [](const glm::vec3& p) { return glm::vec4(0.5f + 0.5f * p, 1); };
    b.add("ball", paint(sphere(0.9), rainbow), plain, glm::dvec3(-1.1, 0, 0));
    b.add("checkered ball", paint(sphere(0.9), rainbow), textured, glm::dvec3(1.1, 0, 0));
    b.add("uncoloured ball", sphere(0.3), textured, glm::dvec3(0, 0.9, 0));
    studio(b);
}

}  // namespace diptych::builtin
