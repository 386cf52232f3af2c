// SPDX-License-Identifier: MIT
// With every light assignment the image equals that of assignment every, bit for bit.
#include "compare/frames/frame_properties.h"
#include "compare/frames/nonfinite.h"
#include "shared/contract/debug_mode.h"
#include "shared/scene/lights/rig.h"
#include "shared/scene/load.h"
#include "shared/scene/motion/bounds.h"
#include "shared/scene/view.h"
#include "tests/image/scenes.h"
#include "tests/support/campaign.h"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <random>
#include <tuple>

namespace diptych::tests {
namespace {

// Number of differing pixels; a NaN differs from everything, including itself.
std::size_t wrongPixels(const Image& a, const Image& b) {
    std::size_t nans = 0;
    for (std::size_t i = 0; i < a.pixels(); ++i)
        nans += std::any_of(a.pixel(i), a.pixel(i) + a.components, [](float v) { return std::isnan(v); });
    return differingPixels(a, b) + nans;
}

// Assignments and compute shaders that must not change the image.
struct Way {
    Assignment assign;
    LightKernel kernel;
};
constexpr Way ways[] = {{Assignment::clustered, LightKernel::scatter},
                        {Assignment::clustered, LightKernel::gather},
                        {Assignment::tiled, LightKernel::scatter},
                        {Assignment::tiled, LightKernel::gather}};

// The scene with exactly `count` lights: its own first, then a seeded rig's, every eighth a spot.
Scene withLights(Scene scene, std::size_t count) {
    if (scene.lights.size() < count) {
        const std::size_t more = count - scene.lights.size(), spots = more / 8;
        std::string rig = "point:" + std::to_string(more - spots);
        if (spots > 0) rig += ",spot:" + std::to_string(spots);
        const Pose pose = poseAt(scene, 0);
        for (Light& light : makeLights(rig, 7, boundsAtStart(scene, pose))) scene.lights.push_back(light);
    }
    scene.lights.resize(count);
    return scene;
}

Settings image(Size size, Path path, Assignment assign, LightKernel kernel = LightKernel::automatic) {
    Settings settings = unshadowed();
    settings.path = path;
    settings.size = size;
    settings.assign = assign;
    settings.light_kernel = kernel;
    settings.gbuffer = GBufferEncoding::full;
    return settings;
}

// Renders lit alone. No list may overflow. `captured`: the capture must also equal the rendered image.
Image litOf(Renderer& renderer, const Settings& settings, bool captured) {
    if (captured) {
        Frame frame = renderer.draw(settings, untimed());
        EXPECT_EQ(frame.counters.unreproduced_pixels, 0u);
        EXPECT_EQ(frame.counters.overflowed_lists, 0u);
        EXPECT_EQ(frame.counters.nonfinite_pixels, 0u);
        return std::move(frame.channels.at(Channel::lit));
    }
    PreparedFrames frames = renderer.prepare({&settings, 1});
    frames.draw(0);
    FrameCounters counters;
    frames.readCounters(0, counters);
    EXPECT_EQ(counters.overflowed_lists, 0u);
    return frames.lit(0);
}

// Compares every assignment on both paths with `every` on forward+. A capture renders everything again:
// small images are captured for every assignment, large ones once per path.
void expectEveryWayEqual(Renderer& renderer, Size size) {
    const bool small = size.width * size.height <= 1024;
    const Image every = litOf(renderer, image(size, Path::forward_plus, Assignment::every), small);
    EXPECT_EQ(nonfinitePixels(every), 0u);
    const Image deferred = litOf(renderer, image(size, Path::deferred, Assignment::every), small);
    EXPECT_EQ(wrongPixels(every, deferred), 0u) << "deferred, every";
    Settings objects = image(size, Path::forward_plus, Assignment::per_object);
    objects.pixel_lights = 1 << 20;
    EXPECT_EQ(wrongPixels(every, litOf(renderer, objects, small)), 0u) << "per_object, all per pixel";
    for (const Path path : {Path::forward_plus, Path::deferred})
        for (const Way& way : ways) {
            const Settings settings = image(size, path, way.assign, way.kernel);
            const Image image = litOf(renderer, settings, small || &way == &ways[0]);
            EXPECT_EQ(wrongPixels(every, image), 0u)
                << nameOf(path) << ", " << nameOf(way.assign) << ", " << nameOf(way.kernel);
        }
}

class LightMatrix : public testing::TestWithParam<std::tuple<const char*, int>> {};

// Many lights on a large image evaluate every light at every pixel several times, which takes seconds.
// Each scene has one large image, with more lights than the 256 of a batch; a campaign renders more.
std::vector<Size> sizesOf(const std::string& scene, int count) {
    std::vector<Size> sizes{{1, 1}, {15, 17}, {213, 119}};
    if (count == 257) sizes.push_back({1279, 719});
    if (!isCampaign()) return sizes;
    if (count <= 257 || (count == 1024 && scene == "spheres")) sizes.push_back({640, 360});
    if (count == 1 || (count == 1024 && scene == "spheres")) sizes.push_back({1279, 719});
    return sizes;
}

TEST_P(LightMatrix, EveryWayIsEvery) {
    const auto [name, count] = GetParam();
    const std::string scene = std::string("builtin:") + name;
    const bool spheres = scene == "builtin:spheres";
    const Scene lit_scene = spheres ? loadScene(scene + "?lights=" + std::to_string(count))
                                    : withLights(loadScene(scene), static_cast<std::size_t>(count));
    Renderer renderer(device(), lit_scene, pipelines());
    for (const Size size : sizesOf(name, count)) {
        SCOPED_TRACE(std::to_string(size.width) + "x" + std::to_string(size.height));
        expectEveryWayEqual(renderer, size);
    }
}

INSTANTIATE_TEST_SUITE_P(Lights, LightMatrix,
                         testing::Combine(testing::Values("spheres", "gallery"),
                                          testing::Values(1, 255, 256, 257, 1024, 4096)),
                         [](const auto& row) {
                             return std::string(std::get<0>(row.param)) + "_" +
                                    std::to_string(std::get<1>(row.param)) + "_lights";
                         });

// The other scenes, each with one light count and one size; together they combine every count with every
// size.
class LightPairs : public SceneTest {};

TEST_P(LightPairs, EveryWayIsEvery) {
    const std::vector<std::string> names = builtinScenes();
    const auto at = static_cast<std::size_t>(std::ranges::find(names, GetParam()) - names.begin());
    constexpr std::size_t counts[] = {1, 255, 256, 257, 1024};
    constexpr Size sizes[] = {{1, 1}, {15, 17}, {160, 90}, {213, 119}};
    const Scene scene = loadScene(GetParam());
    // 5 and 4 are coprime: over all scenes every count meets every size.
    const Scene many = withLights(scene, counts[at % std::size(counts)]);
    Renderer renderer(device(), many, pipelines());
    expectEveryWayEqual(renderer, sizes[at % std::size(sizes)]);
}

INSTANTIATE_TEST_SUITE_P(Builtin, LightPairs, testing::ValuesIn(slice(builtinScenes(), 4)), sceneName);

// ---- extremes ----------------------------------------------------------------------------------------

Light pointAt(glm::dvec3 position, float intensity, float range) {
    Light light;
    light.kind = LightKind::point;
    light.position = position;
    light.intensity = intensity;
    light.range = range;
    return light;
}

Light spotAt(glm::dvec3 position, glm::dvec3 direction, float outer, float range) {
    Light light = pointAt(position, 20, range);
    light.kind = LightKind::spot;
    light.direction = glm::normalize(direction);
    light.outer_cone = outer;
    light.inner_cone = 0.5f * outer;
    return light;
}

void expectEqualUnder(const std::string& name, std::vector<Light> lights, Size size = {213, 119}) {
    Scene scene = loadScene(name);
    scene.lights = std::move(lights);
    Renderer renderer(device(), scene, pipelines());
    expectEveryWayEqual(renderer, size);
}

glm::dvec3 eyeOf(const std::string& name) {
    const Scene scene = loadScene(name);
    return makeView(scene, poseAt(scene, 0), "", 64, 36).eye();
}

TEST(LightExtremes, TheCameraInsideLights) {
    const glm::dvec3 eye = eyeOf("builtin:spheres");
    std::vector<Light> lights;
    for (const float range : {0.05f, 1.0f, 30.0f, 1e5f}) lights.push_back(pointAt(eye, 5, range));
    lights.push_back(pointAt(eye + glm::dvec3(0.01, 0, 0), 5, 20));
    lights.push_back(spotAt(eye, {0, -6, -14}, 0.3f, 40));
    lights.push_back(spotAt(eye, {0, 6, 14}, 1.2f, 40));
    expectEqualUnder("builtin:spheres", std::move(lights));
}

TEST(LightExtremes, LightsBehindTheCameraAndAtTheNearPlane) {
    const Scene scene = loadScene("builtin:spheres");
    const View view = makeView(scene, poseAt(scene, 0), "", 64, 36);
    std::vector<Light> lights;
    for (const double along : {-30.0, -5.0, -0.1, 0.1, 0.1 + 1e-6}) {
        const glm::dvec3 at = view.eye() - view.backward() * along;
        for (const float range : {0.1f, 1.0f, 25.0f}) {
            lights.push_back(pointAt(at, 9, range));
            lights.push_back(spotAt(at, -view.backward(), 0.4f, range));
            lights.push_back(spotAt(at, view.backward(), 0.4f, range));
        }
    }
    expectEqualUnder("builtin:spheres", std::move(lights));
}

TEST(LightExtremes, ConesFromNothingToAHemisphere) {
    std::vector<Light> lights;
    std::mt19937 random(11);
    std::uniform_real_distribution<double> place(-15, 15), up(0.2, 4), turn(-1, 1);
    for (const double degrees : {0.0, 0.01, 0.5, 2.0, 10.0, 45.0, 90.0, 120.0, 150.0, 170.0, 178.0, 179.0})
        for (int i = 0; i < 8; ++i) {
            Light light = spotAt({place(random), up(random), place(random)}, {turn(random), -1, turn(random)},
                                 static_cast<float>(glm::radians(degrees / 2)), 8);
            if (i % 2 == 0)
                // Hard edge: the difference of cosines would be a zero divisor.
                light.inner_cone = light.outer_cone;
            if (i % 4 == 1) light.direction = {0, -1, 0};
            lights.push_back(light);
        }
    expectEqualUnder("builtin:spheres", lights);
    expectEqualUnder("builtin:ortho", lights);
}

TEST(LightExtremes, RangesFromAMillimetreToAMillionMetres) {
    std::vector<Light> lights;
    std::mt19937 random(12);
    std::uniform_real_distribution<double> place(-12, 12);
    for (int decade = -3; decade <= 6; ++decade)
        for (int i = 0; i < 20; ++i) {
            const auto range = static_cast<float>(std::pow(10.0, decade));
            const double height = decade < 0 ? 0.3 * std::pow(10.0, decade) : 0.4;
            lights.push_back(pointAt({place(random), height, place(random)}, 3, range));
            lights.push_back(spotAt({place(random), height, place(random)}, {1, -0.5, 0}, 0.6f, range));
        }
    lights.push_back(pointAt({0, 3, 0}, 3, std::numeric_limits<float>::infinity()));
    lights.push_back(spotAt({0, 3, 0}, {0, -1, 0}, 0.6f, std::numeric_limits<float>::infinity()));
    for (const char* scene : {"builtin:spheres", "builtin:deep", "builtin:far_away", "builtin:ortho"})
        expectEqualUnder(scene, lights);
}

// The most distant lights possible: outside bounding spheres whose squared radii still fit into float32.
TEST(LightExtremes, LightsAsFarAwayAsTheyMayBe) {
    constexpr float everywhere = std::numeric_limits<float>::infinity();
    std::vector<Light> lights;
    for (const double far : {1e14, 1e15, 1e16, 1e17, 1e18}) {
        const auto intensity = static_cast<float>(far * far);
        lights.push_back(pointAt({0, far, 0.1 * far}, intensity, everywhere));
        lights.push_back(spotAt({0.3 * far, far, -far}, {-0.3, -1, 1}, 0.5f, everywhere));
        lights.push_back(pointAt({-far, 0.5 * far, far}, intensity, static_cast<float>(3 * far)));
    }
    for (const char* scene : {"builtin:spheres", "builtin:ortho"}) expectEqualUnder(scene, lights);
}

TEST(LightExtremes, LightsOfNothingAndThousandsInOnePlace) {
    std::vector<Light> lights(3000, pointAt({0.3, 1, 0.2}, 0.01f, 4));
    for (std::size_t i = 0; i < lights.size(); i += 3) lights[i].intensity = 0;
    for (std::size_t i = 1; i < lights.size(); i += 30) lights[i].range = 0;
    lights.resize(3400, spotAt({0.3, 1, 0.2}, {0, -1, 0}, 0.5f, 5));
    expectEqualUnder("builtin:spheres", std::move(lights), {96, 54});
}

// Lights before, in and beyond the last slice; pixels behind the last light.
TEST(LightExtremes, LightsBeyondTheLastSliceStillLight) {
    // They determine the median, which makes slices short.
    std::vector<Light> lights(40, pointAt({0, 0.5, 13}, 1, 0.5f));
    for (double z = 5; z > -20; z -= 1) lights.push_back(pointAt({0, 1, z}, 4, 3));
    lights.push_back(pointAt({0, 2, -15}, 50, 200));
    expectEqualUnder("builtin:spheres", lights);
}

// ---- beyond one draw, beyond the buffer ----------------------------------------------------------------

TEST(LightLists, SixtyFiveThousandSixHundredLightsAreEveryOne) {
    const Scene scene = withLights(loadScene("builtin:gallery"), 65600);
    Renderer renderer(device(), scene, pipelines());
    expectEveryWayEqual(renderer, {24, 14});
    // Negative control: the last light is included in the sum.
    Scene without = scene;
    for (Light& light : without.lights) light.intensity *= 1e-3f;
    without.lights.back() = pointAt(eyeOf("builtin:gallery"), 100, 1000);
    Scene dark = without;
    dark.lights.back().intensity = 0;
    const Settings every = image({24, 14}, Path::forward_plus, Assignment::every);
    const Frame a = Renderer(device(), without, pipelines()).draw(every, untimed());
    const Frame b = Renderer(device(), dark, pipelines()).draw(every, untimed());
    EXPECT_GT(differingPixels(a, b, Channel::lit), 100u);
}

// The loops over reflectors, form factors and rims nest in the loop over lights, and lavapipe counts all of
// them: the last of many tubes still shines on coats and through leaves.
TEST(LightLists, ManyTubesOnLayersAreShadedInSeveralDraws) {
    Scene scene = loadScene("builtin:layers");
    for (Material& m : scene.materials) m.clearcoat = 1, m.diffuse_transmission = 0.5f;
    Light near = scene.lights.front(), far = near;
    near.kind = far.kind = LightKind::tube;
    near.position = eyeOf("builtin:layers");
    near.intensity = 1000;
    near.range = std::numeric_limits<float>::infinity();
    far.position = near.position + glm::dvec3(1e4, 0, 0);
    far.range = 0.1f;
    scene.lights.assign(device().profile().light_iterations / 16, far);
    scene.lights.push_back(near);
    Scene few = scene;
    few.lights = {near};
    const Settings every = image({12, 7}, Path::forward_plus, Assignment::every);
    const Frame many = Renderer(device(), scene, pipelines()).draw(every, untimed()),
                one = Renderer(device(), few, pipelines()).draw(every, untimed());
    EXPECT_EQ(wrongPixels(many.channels.at(Channel::lit), one.channels.at(Channel::lit)), 0u);
    EXPECT_GT(*std::ranges::max_element(one.channels.at(Channel::lit).data), 0.1f);
}

// More pairs of lights and froxels than fit into the device's largest buffer.
TEST(LightLists, WhatFindsNoRoomIsEveryLightAndCounted) {
    Scene scene = loadScene("builtin:spheres?lights=1");
    scene.lights.assign(65600, pointAt({0, 2, 0}, 1e-4f, std::numeric_limits<float>::infinity()));
    // The lights' median range is small: slices are thin and many.
    for (int i = 0; i < 200; ++i) scene.lights.push_back(pointAt({0.1 * i - 10, 0.1, 0.07 * i - 8}, 1, 0.2f));
    Light area = pointAt({0, 3, 0}, 5, std::numeric_limits<float>::infinity());
    area.kind = LightKind::rect;
    area.direction = {0, -1, 0};
    scene.lights.push_back(area);
    Renderer renderer(device(), scene, pipelines());
    const Size size{384, 1};  // few pixels in as many tiles
    const Frame every = renderer.draw(image(size, Path::forward_plus, Assignment::every), untimed());
    const Frame frame = renderer.draw(image(size, Path::deferred, Assignment::clustered),
                                      untimed({Channel::lit, Channel::list_overflow}));
    if (device().limits().maxStorageBufferRange <= (128u << 20)) {
        EXPECT_GT(frame.counters.overflowed_lists, 0u);
        const PixelData& overflow = frame.channels.at(Channel::list_overflow).data;
        EXPECT_GT(std::count(overflow.begin(), overflow.end(), 1.0f), 0);
    }
    EXPECT_EQ(wrongPixels(every.channels.at(Channel::lit), frame.channels.at(Channel::lit)), 0u);
}

// ---- counters and channels of the lists ----------------------------------------------------------------

TEST(LightLists, TheChannelCountsWhatIsEvaluated) {
    const Scene scene = loadScene("builtin:spheres?lights=256");
    Renderer renderer(device(), scene, pipelines());
    const RenderOptions options =
        untimed({Channel::lit, Channel::light_count, Channel::list_overflow, Channel::material_id});
    const auto counts = [&](Assignment assign) {
        return renderer.draw(image({640, 360}, Path::forward_plus, assign), options);
    };
    const Frame every = counts(Assignment::every);
    for (const Assignment assign : {Assignment::tiled, Assignment::clustered}) {
        const Frame frame = counts(assign);
        double sum = 0;
        std::size_t covered = 0;
        for (std::size_t i = 0; i < frame.channels.at(Channel::light_count).pixels(); ++i) {
            const float count = frame.channels.at(Channel::light_count).pixel(i)[0];
            const bool background = frame.channels.at(Channel::material_id).pixel(i)[0] < 0;
            EXPECT_EQ(every.channels.at(Channel::light_count).pixel(i)[0], background ? 0.0f : 257.0f)
                << "the sun too";
            EXPECT_LE(count, 257.0f);
            if (background) continue;
            EXPECT_GE(count, 1.0f) << "the sun";
            sum += double{count};
            ++covered;
            EXPECT_EQ(frame.channels.at(Channel::list_overflow).pixel(i)[0], 0.0f);
        }
        // Known for this scene: on average 5.07 point lights reach a covered pixel; a list has a few more.
        const double mean = sum / static_cast<double>(covered) - 1;
        EXPECT_GT(mean, 4.5);
        EXPECT_LT(mean, 5.07 * 4) << nameOf(assign);
    }
}

TEST(LightLists, BothPathsHaveTheSameLists) {
    const Scene scene = loadScene("builtin:gallery");
    Renderer renderer(device(), scene, pipelines());
    for (const Assignment assign : {Assignment::tiled, Assignment::clustered}) {
        const Frame a =
            renderer.draw(image({213, 119}, Path::deferred, assign), untimed({Channel::light_count}));
        const Frame b =
            renderer.draw(image({213, 119}, Path::forward_plus, assign), untimed({Channel::light_count}));
        EXPECT_EQ(differingPixels(a, b, Channel::light_count, true), 0u);
    }
}

// ---- negative controls
// -----------------------------------------------------------------------------------

TEST(LightNegativeControls, OneMoreLightChangesEvery) {
    const Scene scene = loadScene("builtin:spheres?lights=64");
    Scene more = scene;
    more.lights.push_back(pointAt({0, 1, 0}, 0.01f, 2));
    const Settings every = image({160, 90}, Path::forward_plus, Assignment::every);
    const Frame a = Renderer(device(), scene, pipelines()).draw(every, untimed());
    const Frame b = Renderer(device(), more, pipelines()).draw(every, untimed());
    EXPECT_GT(differingPixels(a, b, Channel::lit), 0u);
}

TEST(LightNegativeControls, NoNanEqualsAnything) {
    Image a(2, 1, 3, 1.0f), b = a;
    EXPECT_EQ(wrongPixels(a, b), 0u);
    a.pixel(1)[2] = b.pixel(1)[2] = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(wrongPixels(a, b), 1u);
}

// ---- light cutoff ----------------------------------------------------------------------------------------

TEST(LightCutoff, GivesRangesAndSaysWhatIsCut) {
    Scene scene = loadScene("builtin:spheres?lights=4");
    for (Light& light : scene.lights)
        if (light.kind == LightKind::point) light.range = std::numeric_limits<float>::infinity();
    Renderer renderer(device(), scene, pipelines());
    Settings settings = image({160, 90}, Path::forward_plus, Assignment::clustered);
    const Frame whole = renderer.draw(settings, untimed({Channel::lit, Channel::light_count}));
    EXPECT_EQ(whole.counters.energy_cut, 0.0);
    double before = 0;
    for (const float cutoff : {1e-3f, 1e-2f, 1e-1f}) {
        settings.light_cutoff = cutoff;
        const Frame cut = renderer.draw(settings, untimed({Channel::lit, Channel::light_count}));
        EXPECT_GT(cut.counters.energy_cut, before);
        EXPECT_LT(cut.counters.energy_cut, 1.0);
        before = cut.counters.energy_cut;
        EXPECT_GT(differingPixels(whole, cut, Channel::lit), 0u);
        Settings every = settings;
        every.assign = Assignment::every;
        const Frame same = renderer.draw(every, untimed());
        EXPECT_EQ(wrongPixels(same.channels.at(Channel::lit), cut.channels.at(Channel::lit)), 0u);
    }
}

}  // namespace
}  // namespace diptych::tests
