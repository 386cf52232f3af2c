// SPDX-License-Identifier: MIT
// KHR_materials_transmission, _volume, _dispersion and _diffuse_transmission in both paths, compared with
// closed forms, with the image behind them, and with each other.
#include "compare/frames/frame_properties.h"
#include "compare/render/prepared_view.h"
#include "shared/scene/builtin/builder.h"
#include "shared/scene/builtin/textures.h"
#include "tests/image/scenes.h"
#include "tests/support/layer_formulas.h"

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <vector>

namespace diptych::tests {
namespace {

Settings image() {
    Settings settings = smallImage(GBufferEncoding::full);
    settings.size = {96, 54};
    return settings;
}

Image litOf(Path path, const Scene& scene, const Settings& settings) {
    Renderer renderer(device(), scene, pipelines());
    return drawnBy(path, renderer, settings, {Channel::lit}).channels.at(Channel::lit);
}

// A pane one metre before a chequered wall, without light of its own.
Scene paneBeforeWall(const Material& pane, bool wall_only = false) {
    Builder b;
    b.camera("front", {0, 0, 4}, {0, 0, 0}, 40, 0.1, 100);
    b.sun({0, 0, 1}, {1, 1, 1}, 0);  // without lights, the default sun would shine
    b.add("wall", quad({-9, -9, -1}, {18, 0, 0}, {0, 18, 0}),
          b.material("wall", {glm::vec3(0), 0, 1, {1, 2, 3}}), glm::dvec3(0.0));
    b.scene.materials.back().emissive_texture =
        b.texture(checker("squares", 64, 16, {255, 230, 200, 255}, {60, 90, 128, 255}), 2);
    if (!wall_only) {
        b.add("pane", quad({-9, -9, 0}, {18, 0, 0}, {0, 18, 0}), static_cast<int>(b.scene.materials.size()),
              glm::dvec3(0.0));
        b.scene.materials.push_back(pane);
    }
    return std::move(b.scene);
}

Material glassOf(float thickness, float ior = 1.5f) {
    Material m;
    m.metallic = m.roughness = 0;
    m.transmission = 1;
    m.thickness = thickness;
    m.ior = ior;
    return m;
}

double bilinear(const Image& image, glm::dvec2 p, int c) {
    const auto at = [&](double x, double y) {
        return double{image.at(std::clamp(static_cast<int>(x), 0, image.width - 1),
                               std::clamp(static_cast<int>(y), 0, image.height - 1), c)};
    };
    p = glm::clamp(p, glm::dvec2(0), glm::dvec2(image.width, image.height)) - 0.5;
    const glm::dvec2 first = glm::floor(p), t = p - first;
    return glm::mix(glm::mix(at(first.x, first.y), at(first.x + 1, first.y), t.x),
                    glm::mix(at(first.x, first.y + 1), at(first.x + 1, first.y + 1), t.x), t.y);
}

// The pixel that shows where the ray through pixel p leaves a slab at z = 0: the camera looks along -z from
// z = 4 with a field of view of 40 degrees.
glm::dvec2 pixelBehind(const glm::dvec2& p, double thickness, double ior, const Image& image) {
    const double scale = 2 * std::tan(20 * std::numbers::pi / 180) / image.height;
    const glm::dvec2 middle(0.5 * image.width, 0.5 * image.height), offset = (p - middle) * scale;
    const glm::dvec3 along = glm::normalize(glm::dvec3(offset, -1));  // y down
    const double sine = std::sqrt(1 - along.z * along.z) / ior;
    const glm::dvec2 aside = glm::length(offset) > 0 ? glm::normalize(offset) : glm::dvec2(0);
    const glm::dvec3 inside(aside * sine, -std::sqrt(1 - sine * sine));
    const glm::dvec3 exit = along * (4 / -along.z) + inside * thickness;
    return glm::dvec2(exit) / (-exit.z * scale) + middle;
}

// The wall without the pane.
const Image& wallOf(Path path) {
    static std::map<Path, Image> walls;
    const auto found = walls.find(path);
    return found != walls.end() ? found->second
                                : walls[path] = litOf(path, paneBeforeWall({}, true), image());
}

// The largest difference to expected(x, y, component), right of the columns before `first`.
template <class F>
double largestDifference(const Image& made, const F& expected, int first = 0) {
    double max = 0;
    for (int y = 0; y < made.height; ++y)
        for (int x = first; x < made.width; ++x)
            for (int c = 0; c < 3; ++c)
                max = std::max(max, std::abs(double{made.at(x, y, c)} - expected(x, y, c)));
    return max;
}

// The same to the wall where rays leave a slab, one index for each component. `kept`: what passes; a pane
// with `specular` reflects by Schlick's term.
double largestError(const Image& made, const Image& wall, double thickness, const glm::dvec3& iors,
                    const glm::dvec3& kept, bool specular = true) {
    const double scale = 2 * std::tan(20 * std::numbers::pi / 180) / made.height;
    return largestDifference(made, [&](int x, int y, int c) {
        const glm::dvec2 p(x + 0.5, y + 0.5),
            offset = (p - glm::dvec2(0.5 * made.width, 0.5 * made.height)) * scale;
        const double passes = specular ? 1 - schlick(1 / std::sqrt(1 + glm::dot(offset, offset))) : 1;
        return passes * kept[c] * bilinear(wall, pixelBehind(p, thickness, iors[c], made), c);
    });
}
void expectThrough(const Material& glass, const glm::dvec3& iors, const glm::dvec3& kept, double max) {
    for (const Path path : drawn_paths) {
        const Image made = litOf(path, paneBeforeWall(glass), image());
        EXPECT_LT(largestError(made, wallOf(path), double{glass.thickness}, iors, kept, glass.specular > 0),
                  max)
            << nameOf(path) << " " << glass.ior;
    }
}

// A texel's step of 1 times a pixel's rounding, 1e-4, and its light.
constexpr double rounding = 1e-3;

TEST(Refraction, AThinWallShowsWhatIsStraightBehind) {
    expectThrough(glassOf(0), glm::dvec3(1.5), glm::dvec3(1), 1e-5);
}

TEST(Refraction, ASlabMovesTheImageBySnellsLaw) {
    for (const float ior : {1.0f, 1.33f, 2.4f}) {
        Material glass = glassOf(0.7f, ior);
        glass.specular = 0;  // no reflection, whose F0 follows the index
        expectThrough(glass, glm::dvec3(double{ior}), glm::dvec3(1), rounding);
    }
}

TEST(Refraction, ColoursBendApartByDispersion) {
    Material glass = glassOf(0.7f);
    glass.dispersion = 8;
    const double half = 0.5 * 0.025 * 8;
    expectThrough(glass, {1.5 - half, 1.5, 1.5 + half}, glm::dvec3(1), rounding);
}

TEST(Refraction, ASlabAbsorbsByItsThickness) {
    Material glass = glassOf(0.5f);
    glass.attenuation_color = {0.5f, 0.25f, 0};
    glass.attenuation_distance = 0.25f;
    expectThrough(glass, glm::dvec3(1.5), {0.25, 0.0625, 0}, rounding);
}

// The node's scale is the slab's.
TEST(Refraction, ThicknessIsInTheSpaceOfTheMesh) {
    Scene scene = paneBeforeWall(glassOf(0.1f));
    scene.nodes.back().parent_from_node = glm::scale(glm::dmat4(1), glm::dvec3(5));
    const Image made = litOf(Path::deferred, scene, image());
    EXPECT_LT(largestError(made, wallOf(Path::deferred), double{0.1f} * 5, glm::dvec3(1.5), glm::dvec3(1)),
              rounding);
}

TEST(Refraction, RoughGlassShowsTheMeanOfWhatIsBehind) {
    Material glass = glassOf(0);
    glass.roughness = 1;
    const Image& wall = wallOf(Path::deferred);
    glm::dvec3 mean(0);
    for (std::size_t i = 0; i < wall.pixels(); ++i)
        mean += glm::dvec3(wall.pixel(i)[0], wall.pixel(i)[1], wall.pixel(i)[2]) /
                static_cast<double>(wall.pixels());
    for (const Path path : drawn_paths) {
        const Image made = litOf(path, paneBeforeWall(glass), image());
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(made.at(48, 27, c), 0.96 * mean[c], 0.02 * mean[c]) << nameOf(path);
    }
}

// The mip chain of an image: each texel is the mean over its area.
std::vector<Image> meansOf(const Image& image) {
    std::vector<Image> levels{image};
    while (std::max(levels.back().width, levels.back().height) > 1) {
        const Image& from = levels.back();
        Image to(std::max(from.width / 2, 1), std::max(from.height / 2, 1), 3);
        const double across = static_cast<double>(from.width) / to.width,
                     down = static_cast<double>(from.height) / to.height;
        const auto covered = [](double first, double side, int texel) {
            return std::max(0.0, std::min(first + side, texel + 1.0) - std::max(first, double(texel)));
        };
        for (int y = 0; y < to.height; ++y)
            for (int x = 0; x < to.width; ++x)
                for (int c = 0; c < 3; ++c) {
                    double sum = 0;
                    for (int v = 0; v < from.height; ++v)
                        for (int u = 0; u < from.width; ++u)
                            sum += from.at(u, v, c) * covered(x * across, across, u) *
                                   covered(y * down, down, v);
                    to.at(x, y, c) = static_cast<float>(sum / (across * down));
                }
        levels.push_back(std::move(to));
    }
    return levels;
}
double blurred(const std::vector<Image>& levels, const glm::dvec2& p, double level, int c) {
    const auto at = [&](std::size_t k) {
        const Image& image = levels.at(std::min(k, levels.size() - 1));
        const glm::dvec2 size(levels[0].width, levels[0].height), inside = glm::clamp(p, glm::dvec2(0), size);
        return bilinear(image, inside * glm::dvec2(image.width, image.height) / size, c);
    };
    const auto first = static_cast<std::size_t>(level);
    return glm::mix(at(first), at(first + 1), level - std::floor(level));
}

// Level log2(width) times roughness; the lobe is narrower if the index is below 1.5, also a thin wall's.
TEST(Refraction, RoughGlassReadsTheMeansOfTheImage) {
    struct Case {
        float roughness, thickness, ior;
    };
    const std::vector<Image> levels = meansOf(wallOf(Path::deferred));
    for (const Case& of : {Case{0.3f, 0, 1.5f}, Case{0.65f, 0, 1.1f}, Case{0.4f, 0.7f, 1.25f},
                           Case{0.4f, 0.7f, 2}, Case{1, 0.7f, 1}}) {
        Material glass = glassOf(of.thickness, of.ior);
        glass.roughness = of.roughness;
        glass.specular = 0;
        const double narrower = std::clamp(2 * double{of.ior} - 2, 0.0, 1.0);
        for (const Path path : drawn_paths) {
            const Image made = litOf(path, paneBeforeWall(glass), image());
            const double level = std::log2(made.width) * double{of.roughness} * narrower;
            const double max = largestDifference(made, [&](int x, int y, int c) {
                return blurred(levels,
                               pixelBehind({x + 0.5, y + 0.5}, double{of.thickness}, double{of.ior}, made),
                               level, c);
            });
            EXPECT_LT(max, rounding) << of.roughness << " " << of.ior << " " << nameOf(path);
        }
    }
}

// Parallel rays meet a pane turned by `turn` at the same angle, and leave it beside themselves by
// d sin(turn - refracted).
TEST(Refraction, AnOrthographicCameraSeesASlabsShiftEverywhere) {
    constexpr double turn = 0.6;
    Material glass = glassOf(0.5f);
    glass.specular = 0;
    Scene scene = paneBeforeWall(glass), wall = paneBeforeWall({}, true);
    scene.nodes.back().parent_from_node = glm::rotate(glm::dmat4(1), turn, glm::dvec3(0, 1, 0));
    for (Scene* of : {&scene, &wall}) {
        of->cameras[0].orthographic = true;
        of->cameras[0].ymag = 0.4;
    }
    for (Node& node : wall.nodes) node.parent_from_node[3].z -= 6;  // the turned pane does not cross it
    scene.nodes[0].parent_from_node[3].z -= 6;
    for (const Path path : drawn_paths) {
        const Image behind = litOf(path, wall, image()), made = litOf(path, scene, image());
        const double refracted = std::asin(std::sin(turn) / 1.5),
                     pixels = 0.5 * std::sin(turn - refracted) * made.height / 0.8;
        // The normal leans to the right (+X), and with it the ray's way inside to the left.
        const auto expected = [&](int x, int y, int c) {
            return bilinear(behind, {x + 0.5 - pixels, y + 0.5}, c);
        };
        EXPECT_LT(largestDifference(made, expected, 8), rounding) << nameOf(path);
    }
}

// A ball without boundary, absorption and reflection.
TEST(Refraction, ABallOfIndexOneIsInvisible) {
    Builder b;
    b.scene = paneBeforeWall({}, true);
    Material glass = glassOf(0.5f, 1);
    glass.specular = 0;
    glass.roughness = 1;
    b.add("ball", sphere(0.8, 48, 24), static_cast<int>(b.scene.materials.size()), glm::dvec3(0.0));
    b.scene.materials.push_back(glass);
    for (const Path path : drawn_paths) {
        const auto behind = [&](int x, int y, int c) { return double{wallOf(path).at(x, y, c)}; };
        EXPECT_LT(largestDifference(litOf(path, b.scene, image()), behind), rounding) << nameOf(path);
    }
}

// The nearest of several panes is seen, whatever the order of their draws, and opaque surfaces behind it.
TEST(Refraction, TheNearestPaneIsSeen) {
    for (const bool turned : {false, true}) {
        Scene scene = paneBeforeWall(glassOf(0));
        scene.materials.back().base_color = {1, 0.5f, 0.25f, 1};
        Scene two = scene;
        two.nodes.push_back(two.nodes.back());
        two.nodes.back().parent_from_node[3] = {0, 0, -0.5, 1};
        two.meshes.push_back(two.meshes[1]);
        two.nodes.back().mesh = 2;
        two.materials.push_back(two.materials.back());
        two.materials.back().base_color = {0, 0, 0, 1};
        two.meshes[2].primitives[0].material = 2;
        if (turned) std::swap(two.nodes[1], two.nodes[2]);
        for (const Path path : drawn_paths)
            EXPECT_EQ(differingPixels(litOf(path, scene, image()), litOf(path, two, image())), 0u)
                << nameOf(path) << turned;
    }
}

// Smooth surfaces read the first level alone, unless anti-aliasing may make them rough.
TEST(Refraction, OnlyRoughSurfacesHaveAMipChain) {
    const auto levels = [](float roughness, bool spec_aa) {
        Material glass = glassOf(0.5f);
        glass.roughness = roughness;
        const Scene scene = paneBeforeWall(glass);
        SharedResources shared(device(), scene, pipelines());
        SceneViews views(scene);
        Settings settings = image();
        settings.path = Path::forward_plus;
        settings.spec_aa = spec_aa;
        const PreparedFrame prepared(device(), shared, views.at(viewRequest(settings)), settings);
        std::set<std::uint32_t> written;
        for (const DeclaredUse& use : prepared.passes.declarations())
            if (use.resource == "backdrop" && writes(use.access)) written.insert(use.part.level);
        return written.size();
    };
    EXPECT_EQ(levels(0, false), 1u);
    EXPECT_EQ(levels(0.01f, false), 7u);  // of 96 x 54
    EXPECT_EQ(levels(0, true), 7u);
}

void expectSamePaths(Layers layers, int msaa = 1, MsaaShading shading = MsaaShading::pixel) {
    const Scene scene = loadScene("builtin:transmission");
    Renderer renderer(device(), scene, pipelines());
    Settings settings = with(smallImage(GBufferEncoding::full), "ambient 0.1,0.2,0.3 shadows pcf haze on");
    settings.msaa = msaa;
    settings.msaa_shading = shading;
    settings.layers = layers;
    const std::vector<Frame> frames = bothPaths(renderer, settings);
    expectSameChannels(frames[0], frames[1], 30);
    for (const Frame& frame : frames) {
        EXPECT_EQ(frame.counters.unreproduced_pixels, 0u) << frame.name << nameOf(layers);
        EXPECT_EQ(frame.counters.nonfinite_pixels, 0u) << frame.name << nameOf(layers);
    }
}

TEST(Refraction, BothPathsAreEqualBitForBit) {
    for (const Layers layers : {Layers::gbuffer, Layers::forward}) expectSamePaths(layers);
}

TEST(Refraction, BothPathsAreEqualBitForBitWithSamples) {
    expectSamePaths(Layers::gbuffer, 4);
    expectSamePaths(Layers::forward, 4, MsaaShading::sample);
}

// A leaf lit from behind: the fraction w of the light that its layer admits leaves its front in its colour.
TEST(DiffuseTransmission, IsLambertsLawOnTheFarSide) {
    Builder b;
    b.camera("front", {0, 0, 4}, {0, 0, 0}, 1, 0.1, 100);
    Material leaf;
    leaf.metallic = 0;
    leaf.roughness = 1;
    leaf.base_color = {0.9f, 0.9f, 0.9f, 1};
    leaf.diffuse_transmission = 0.75f;
    leaf.diffuse_transmission_color = {0.2f, 0.8f, 0.4f};
    b.add("leaf", quad({-9, -9, 0}, {18, 0, 0}, {0, 18, 0}), 0, glm::dvec3(0.0));
    b.scene.materials.push_back(leaf);
    b.sun({0, 0, 1}, glm::vec3(1), 2);  // from behind, head-on
    Settings settings = image();
    settings.size = {9, 9};
    for (const Path path : drawn_paths) {
        const Image made = litOf(path, b.scene, settings);
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(made.at(4, 4, c),
                        0.75 * leaf.diffuse_transmission_color[c] * 0.96 * 2 / std::numbers::pi, 1e-5)
                << nameOf(path);
    }
    b.scene.lights[0].direction = {0, 0, -1};  // in front: only the rest is scattered back
    for (const Path path : drawn_paths) {
        Scene matt = b.scene, opaque = b.scene;
        opaque.materials[0].diffuse_transmission = 0;
        opaque.materials[0].base_color = {0.225f, 0.225f, 0.225f, 1};
        EXPECT_NEAR(litOf(path, matt, settings).at(4, 4, 0), litOf(path, opaque, settings).at(4, 4, 0), 1e-6)
            << nameOf(path);
    }
}

}  // namespace
}  // namespace diptych::tests
