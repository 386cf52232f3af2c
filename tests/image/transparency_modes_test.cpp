// SPDX-License-Identifier: MIT
// The transparency modes, compared with exact sorting in double.
#include "tests/image/transparency_modes.h"
#include "compare/frames/nonfinite.h"
#include "shared/scene/builtin/builder.h"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <cstdio>
#include <map>
#include <numeric>
#include <random>

namespace diptych::tests {
namespace {

constexpr Path bothOf[] = {Path::deferred, Path::forward_plus};

// Stacks of layers, one per cell of a grid, seen by an orthographic camera: random colours at random
// depths in disjoint slabs. Columns are drawn in groups, each in its own random order. The background
// emits randomly, too.
struct Stacks {
    static constexpr int columns = 32, rows = 18, groups = 8;
    struct Layer {
        double depth;
        glm::vec4 color;
    };
    std::vector<std::vector<Layer>> cells;  // back to front, the opaque one first
    Scene scene;

    static Settings settings(Transparency transparency, int layers) {
        Settings s = imageSettings(transparency);
        s.size = {3 * columns, 3 * rows};  // a cell's middle pixel is far from its edges
        if (transparency == Transparency::list) s.transparency_layers = layers;
        return s;
    }
    glm::dvec3 exact(std::size_t cell) const {
        glm::dvec3 color(cells[cell].front().color);
        for (std::size_t i = 1; i < cells[cell].size(); ++i)
            color = glm::mix(color, glm::dvec3(cells[cell][i].color), double{cells[cell][i].color.a});
        return color;
    }
    static glm::dvec3 drawn(const Image& lit, std::size_t cell) {
        const int x = 3 * (static_cast<int>(cell) % columns) + 1,
                  y = 3 * (static_cast<int>(cell) / columns) + 1;
        return {double{lit.at(x, y, 0)}, double{lit.at(x, y, 1)}, double{lit.at(x, y, 2)}};
    }
    double rmse(const Image& lit) const {
        double sum = 0;
        for (std::size_t i = 0; i < cells.size(); ++i) {
            const glm::dvec3 error = drawn(lit, i) - exact(i);
            sum += glm::dot(error, error) / 3;
        }
        return std::sqrt(sum / static_cast<double>(cells.size()));
    }
};

// `opacity`: of every layer; 0: random.
Stacks stacks(int layers, float opacity, unsigned seed) {
    Stacks made;
    std::mt19937 random(seed);
    const auto number = [&] { return std::generate_canonical<double, 24>(random); };
    Builder b;
    Camera& camera = b.camera("front", {0, 0, 2}, {0, 0, 0}, 20, 0.5, 10);
    camera.orthographic = true;
    camera.ymag = Stacks::rows / 2.0;
    made.cells.resize(Stacks::columns * Stacks::rows);
    const int solid = b.material("behind", {glm::vec3(1), 0, 0.5f});
    const int blended = b.material("layers", {glm::vec3(1), 0, 0.5f});
    for (const int material : {solid, blended})
        b.scene.materials[static_cast<std::size_t>(material)].unlit = true;
    b.scene.materials[static_cast<std::size_t>(blended)].alpha_mode = AlphaMode::blend;
    for (int group = 0; group < Stacks::groups; ++group) {
        std::vector<Primitive> primitives;
        for (int layer = 0; layer <= layers; ++layer) {
            Primitive all;
            for (std::size_t cell = 0; cell < made.cells.size(); ++cell) {
                const int column = static_cast<int>(cell) % Stacks::columns,
                          row = static_cast<int>(cell) / Stacks::columns;
                if (column * Stacks::groups / Stacks::columns != group) continue;
                const double z = layer == 0 ? -0.1 : (layer - 1 + number()) / layers;
                const glm::vec4 color(number(), number(), number(),
                                      opacity > 0 ? static_cast<double>(opacity) : number());
                made.cells[cell].push_back({z, color});
                const glm::dvec3 corner(column - Stacks::columns / 2.0, Stacks::rows / 2.0 - row - 1, z);
                const Primitive one = quad(corner, {1, 0, 0}, {0, 1, 0});
                const auto base = static_cast<std::uint32_t>(all.positions.size());
                for (const std::uint32_t index : one.indices) all.indices.push_back(base + index);
                all.positions.insert(all.positions.end(), one.positions.begin(), one.positions.end());
                all.normals.insert(all.normals.end(), one.normals.begin(), one.normals.end());
                all.tangents.insert(all.tangents.end(), one.tangents.begin(), one.tangents.end());
                for (const std::size_t set : {0u, 1u})
                    all.texcoords[set].insert(all.texcoords[set].end(), one.texcoords[set].begin(),
                                              one.texcoords[set].end());
                all.colors.insert(all.colors.end(), one.positions.size(), color);
            }
            primitives.push_back(std::move(all));
        }
        std::vector<int> order(static_cast<std::size_t>(layers));
        std::iota(order.begin(), order.end(), 1);
        std::ranges::shuffle(order, random);
        order.insert(order.begin(), 0);
        for (const int layer : order)
            b.add("layer", std::move(primitives[static_cast<std::size_t>(layer)]),
                  layer > 0 ? blended : solid, glm::dvec3(0.0));
    }
    made.scene = std::move(b.scene);
    return made;
}

// The table of shared/transparent/MEASURED.md, printed in its format.
TEST(TransparencyModes, ErrorsAreThoseOfTheTable) {
    std::map<std::tuple<Transparency, int, float>, double> errors;
    constexpr float opacities[] = {0.1f, 0.2f, 0.5f, 0.9f, 1.0f, 0.0f};
    constexpr int counts[] = {1, 2, 4, 8, 32};
    for (const int layers : counts)
        for (const float opacity : opacities) {
            const Stacks scene = stacks(layers, opacity, 7u * static_cast<unsigned>(layers));
            for (const Transparency mode : allModes)
                errors[{mode, layers, opacity}] =
                    scene.rmse(litWith(scene.scene, Stacks::settings(mode, layers), nothing));
        }
    for (const Transparency mode : allModes)
        for (const int layers : counts) {
            std::string row = fmt::format("| `{}` | {} |", nameOf(mode), layers);
            for (const float opacity : opacities)
                row += fmt::format(" {:.2g} |", errors[{mode, layers, opacity}]);
            std::puts(row.c_str());
        }
    for (const int layers : counts)
        for (const float opacity : opacities) {
            const auto of = [&](Transparency mode) { return errors[{mode, layers, opacity}]; };
            const std::string where = fmt::format("{} layers of {}", layers, opacity);
            // Each layer rounds to float32 once or twice.
            EXPECT_LT(of(Transparency::list), 1e-6) << where;
            EXPECT_LT(of(Transparency::sorted), 1e-6) << where;
            EXPECT_LT(of(Transparency::triangles), 1e-6) << where;
            if (layers == 1) {
                // The mean of one layer is that layer, up to float32's exp and log. Moments transmit e^-10
                // through opaque layers.
                EXPECT_LT(of(Transparency::weighted), 1e-6) << where;
                EXPECT_LT(of(Transparency::moments), opacity == 1 ? 5e-5 : 1e-6) << where;
            } else if (opacity != 0.1f && opacity != 0.2f) {
                EXPECT_LT(of(Transparency::weighted), 0.8 * of(Transparency::unsorted)) << where;
                EXPECT_LT(of(Transparency::moments), 0.75 * of(Transparency::weighted)) << where;
            }
        }
    // Published errors at 4 layers of random opacity: 0.178, 0.083, 0.033.
    EXPECT_NEAR((errors[{Transparency::unsorted, 4, 0.0f}]), 0.178, 0.02);
    EXPECT_LT((errors[{Transparency::weighted, 4, 0.0f}]), 0.083);
    EXPECT_LT((errors[{Transparency::moments, 4, 0.0f}]), 0.040);
}

struct Fragment {
    std::uint64_t key;
    glm::vec4 value;  // radiance times opacity, opacity
};
// The fragments in each pixel's list, near to far.
std::vector<std::vector<Fragment>> listed(const FragmentLists& lists, std::size_t pixels) {
    const FragmentLists::Contents contents = lists.contents();
    std::vector<std::vector<Fragment>> all(pixels);
    for (std::size_t layer = 0; layer < lists.layers(); ++layer)
        for (std::size_t pixel = 0; pixel < pixels; ++pixel) {
            const std::size_t at = layer * pixels + pixel;
            if (contents.keys[at] != ~std::uint64_t{0})
                all[pixel].push_back({contents.keys[at], contents.fragments[at]});
        }
    return all;
}

Scene withoutBlended(Scene scene) {
    for (Mesh& mesh : scene.meshes)
        std::erase_if(mesh.primitives, [&](const Primitive& p) {
            return scene.materials[static_cast<std::size_t>(p.material)].alpha_mode == AlphaMode::blend;
        });
    return scene;
}

TEST(TransparencyModes, ListIsTheExactBlendingOfItsFragments) {
    for (const char* name : {"builtin:glass", "builtin:crossed"}) {
        const Scene scene = loadScene(name);
        Settings settings = imageSettings(Transparency::list);
        settings.transparency_layers = 32;
        const std::size_t pixels = 96 * 54;
        std::vector<std::vector<Fragment>> all;
        const Image behind = litWith(withoutBlended(scene), settings, nothing),
                    made = litWith(scene, settings, nothing, [&](PreparedView&view) {
                        EXPECT_EQ(view.fragments.rows(), 54u);
                        EXPECT_EQ(view.fragments.overflow().fragments, 0u) << name;
                        all = listed(view.fragments, pixels);
                    });
        std::size_t deepest = 0;
        double worst = 0;
        for (std::size_t pixel = 0; pixel < pixels; ++pixel) {
            const int x = static_cast<int>(pixel) % 96, y = static_cast<int>(pixel) / 96;
            glm::dvec3 color(behind.at(x, y, 0), behind.at(x, y, 1), behind.at(x, y, 2));
            deepest = std::max(deepest, all[pixel].size());
            EXPECT_TRUE(std::ranges::is_sorted(all[pixel], std::less{}, &Fragment::key));
            for (std::size_t i = all[pixel].size(); i-- > 0;) {
                const glm::dvec4 f(all[pixel][i].value);
                color = glm::dvec3(f) + (1 - f.a) * color;
            }
            for (int c = 0; c < 3; ++c)
                worst =
                    std::max(worst, std::abs(double{made.at(x, y, c)} - color[c]) / std::max(1.0, color[c]));
        }
        EXPECT_GE(deepest, 4u) << name;
        EXPECT_LT(worst, 1e-6) << name;
    }
}

// With a capacity of 3, lists keep the nearest 3; the rest is counted and blended as one layer.
TEST(TransparencyModes, AListWithoutRoomKeepsTheNearest) {
    const Stacks scene = stacks(9, 0.0f, 5);
    Settings settings = Stacks::settings(Transparency::list, 16);
    const auto pixels =
        static_cast<std::size_t>(settings.size.width) * static_cast<std::size_t>(settings.size.height);
    std::vector<std::vector<Fragment>> all, nearest;
    litWith(scene.scene, settings, nothing,
            [&](PreparedView& view) { all = listed(view.fragments, pixels); });
    settings.transparency_layers = 3;
    FragmentLists::Overflow overflow;
    const Image made = litWith(scene.scene, settings, nothing, [&](PreparedView& view) {
        nearest = listed(view.fragments, pixels);
        overflow = view.fragments.overflow();
    });
    EXPECT_EQ(overflow.pixels, pixels);
    EXPECT_EQ(overflow.fragments, 6 * pixels);
    for (std::size_t pixel = 0; pixel < pixels; ++pixel) {
        ASSERT_EQ(all[pixel].size(), 9u);
        ASSERT_EQ(nearest[pixel].size(), 3u);
        for (std::size_t i = 0; i < 3; ++i) {
            EXPECT_EQ(nearest[pixel][i].key, all[pixel][i].key);
            EXPECT_EQ(nearest[pixel][i].value, all[pixel][i].value);
        }
    }
    double worst = 0;
    for (std::size_t cell = 0; cell < scene.cells.size(); ++cell) {
        const std::vector<Stacks::Layer>& layers = scene.cells[cell];
        glm::dvec3 rest(0), color(layers.front().color);
        double opacities = 0, through = 1;
        for (std::size_t i = 1; i <= 6; ++i) {
            const double opacity = layers[i].color.a;
            rest += opacity * glm::dvec3(layers[i].color);
            opacities += opacity;
            through *= 1 - opacity;
        }
        color = color * through + rest / opacities * (1 - through);
        for (std::size_t i = 7; i <= 9; ++i)
            color = glm::mix(color, glm::dvec3(layers[i].color), double{layers[i].color.a});
        const glm::dvec3 error = glm::abs(Stacks::drawn(made, cell) - color);
        worst = std::max({worst, error.x, error.y, error.z});
    }
    // exp and log of float32, and 2^-24 of each sum.
    EXPECT_LT(worst, 2e-6);
}

// If no buffer holds the lists of the whole image, they are built for some rows at a time; overflow is
// counted in every part.
TEST(TransparencyModes, WhatFindsNoRoomIsCountedInEveryPart) {
    constexpr int listed_layers = 256, blended_layers = listed_layers + 3;
    Builder b;
    Camera& camera = b.camera("front", {0, 0, 2}, {0, 0, 0}, 20, 0.5, 10);
    camera.orthographic = true;
    camera.ymag = 1;
    const int blended = b.material("layers", {glm::vec3(1), 0, 0.5f});
    b.scene.materials.back().unlit = true;
    b.scene.materials.back().alpha_mode = AlphaMode::blend;
    b.scene.materials.back().base_color.a = 0.5f;
    // A few pixels at the top of the image and a few at the bottom.
    for (int layer = 0; layer < blended_layers; ++layer)
        for (const double y : {-0.95, 0.9})
            b.add("layer", quad({0, y, layer * 1e-3}, {0.05, 0, 0}, {0, 0.05, 0}), blended, glm::dvec3(0.0));
    Settings settings = imageSettings(Transparency::list);
    settings.size = {256, 192};
    settings.transparency_layers = listed_layers;
    FragmentLists::Overflow overflow;
    std::uint32_t rows = 0;
    const Image made = litWith(b.scene, settings, nothing, [&](PreparedView& view) {
        overflow = view.fragments.overflow();
        rows = view.fragments.rows();
        EXPECT_GE(view.fragments.bytes(), std::uint64_t{256} * rows * listed_layers * 8)
            << "a key and a color";
    });
    if (rows >= 192) GTEST_SKIP() << "this device's buffers hold the whole picture";
    std::size_t pixels = 0, above = 0;
    for (std::size_t i = 0; i < made.pixels(); ++i) {
        const bool shows = made.pixel(i)[0] > 0.5f;
        pixels += shows;
        above += shows && i < std::size_t{256} * rows;
    }
    EXPECT_GT(above, 0u);
    EXPECT_GT(pixels, above) << "the parts have some each";
    EXPECT_EQ(overflow.pixels, pixels);
    EXPECT_EQ(overflow.fragments, pixels * (blended_layers - listed_layers));
}

TEST(TransparencyModes, TheOrderOfDrawsChangesNothing) {
    const auto shuffledBy = [](unsigned seed) {
        return [seed](PreparedView& view) {
            std::mt19937 random(seed);
            const auto first = view.draws.items.begin() + static_cast<std::ptrdiff_t>(view.draws.solid_count);
            std::shuffle(first, view.draws.items.end(), random);
        };
    };
    for (const bool crossed : {false, true}) {
        const Scene scene = crossed ? loadScene("builtin:crossed") : stacks(6, 0.0f, 3).scene;
        for (const Transparency mode : {Transparency::list, Transparency::weighted, Transparency::moments}) {
            for (const int layers : {16, 2}) {
                Settings settings = imageSettings(mode);
                if (mode == Transparency::list) settings.transparency_layers = layers;
                const Image first = litWith(scene, settings, nothing);
                double max = 0;
                std::size_t differing = 0;
                for (unsigned seed = 0; seed < 16; ++seed) {
                    const Image other = litWith(scene, settings, shuffledBy(seed));
                    differing += differingPixels(first, other);
                    for (std::size_t i = 0; i < first.data.size(); ++i)
                        max = std::max(max, std::abs(double{first.data[i]} - double{other.data[i]}));
                }
                if (mode == Transparency::list)
                    EXPECT_EQ(differing, 0u) << "room for " << layers;
                else
                    EXPECT_LT(max, 1e-3) << nameOf(mode);
                if (mode != Transparency::list) break;
            }
        }
    }
}

// The negative control: shuffled draws give another image where their order matters.
TEST(TransparencyModes, TheOrderOfDrawsChangesUnsorted) {
    const Scene scene = stacks(6, 0.5f, 3).scene;
    const Image first = litWith(scene, imageSettings(Transparency::unsorted), nothing),
                turned = litWith(scene, imageSettings(Transparency::unsorted), [](PreparedView&view) {
                    std::reverse(
                        view.draws.items.begin() + static_cast<std::ptrdiff_t>(view.draws.solid_count),
                        view.draws.items.end());
                });
    EXPECT_GT(differingPixels(first, turned), first.pixels() / 2);
}

// Light from behind a layer of opacity 1: list and sorted show none of it; for the others the leak is
// measured.
TEST(TransparencyModes, WhatAnOpaqueLayerHides) {
    Stacks scene = stacks(5, 0.5f, 11);
    // The third of five hides two others.
    for (const float bright : {0.0f, 1.0f}) {
        for (Mesh& mesh : scene.scene.meshes)
            for (Primitive& primitive : mesh.primitives)
                for (std::size_t i = 0; i < primitive.colors.size(); ++i) {
                    const double z = double{primitive.positions[i].z};
                    if (z >= 0.4 && z < 0.6) primitive.colors[i].a = 1;
                    if (z < 0.4) primitive.colors[i] = glm::vec4(glm::vec3(bright), primitive.colors[i].a);
                }
        static std::map<Transparency, Image> before;
        for (const Transparency mode : allModes) {
            const Image made = litWith(scene.scene, Stacks::settings(mode, 8), nothing);
            if (bright == 0.0f) {
                before[mode] = made;
                continue;
            }
            double leak = 0;
            for (std::size_t i = 0; i < made.data.size(); ++i)
                leak = std::max(leak, std::abs(double{made.data[i]} - double{before[mode].data[i]}));
            std::printf("%s: %.3g of what is behind shows\n", std::string(nameOf(mode)).c_str(), leak);
            RecordProperty(std::string(nameOf(mode)), fmt::format("{:.3g}", leak));
            if (mode == Transparency::sorted || mode == Transparency::triangles || mode == Transparency::list)
                EXPECT_EQ(leak, 0) << nameOf(mode);
            else
                EXPECT_GT(leak, 0) << nameOf(mode);
        }
    }
}

TEST(TransparencyModes, BothPathsAreEqualBitForBit) {
    for (const char* name : {"builtin:glass", "builtin:crossed"})
        for (const Transparency mode : allModes) {
            std::vector<Image> made;
            for (const Path path : bothOf) {
                Settings settings =
                    with(imageSettings(mode, path), "haze on haze-density 2000 lights point:200,spot:56");
                made.push_back(litWith(loadScene(name), settings, nothing));
            }
            EXPECT_EQ(differingPixels(made[0], made[1]), 0u) << name << " " << nameOf(mode);
        }
}

}  // namespace
}  // namespace diptych::tests
