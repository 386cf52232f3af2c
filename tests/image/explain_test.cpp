// SPDX-License-Identifier: MIT
// Explanations of differences with injected, known causes.
#include "compare/explain/explain.h"
#include "compare/explain/lighting_components.h"
#include "compare/frames/frame_properties.h"
#include "compare/image/channel_image.h"
#include "compare/render/channel_shading.h"
#include "shared/contract/debug_mode.h"
#include "tests/image/scenes.h"
#include "tests/support/srgb.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

namespace diptych::tests {
namespace {

Settings explained(Size size) {
    Settings settings = smallImage(GBufferEncoding::full);
    settings.path = Path::forward_plus;
    settings.size = size;
    settings.ambient = {0.05f, 0.05f, 0.05f};
    return settings;
}

// A fault of a channel: `plant` modifies a pixel.
struct Fault {
    std::string channel;
    std::string means;
    std::function<void(float*)> plant;
};

std::vector<Fault> faults() {
    const auto each = [](const std::function<double(double)>& of) {
        return [of](float* p) {
            for (int c = 0; c < 3; ++c) p[c] = static_cast<float>(of(double{p[c]}));
        };
    };
    return {
        {"normals", "8 bits",
         [](float* p) {
             double n[3], length = 0;
             for (int c = 0; c < 3; ++c) n[c] = std::round(127 * double{p[c]}) / 127, length += n[c] * n[c];
             for (int c = 0; c < 3; ++c) p[c] = static_cast<float>(n[c] / std::sqrt(std::max(length, 1e-9)));
         }},
        {"roughness", "squared once more", [](float* p) { p[0] *= p[0]; }},
        {"metallic", "of plastic", [](float* p) { p[0] = 0; }},
        {"albedo", "sRGB taken for linear", each(decodedSrgb)},
        {"albedo", "4 bits", each([](double x) { return std::round(15 * x) / 15; })},
        {"emission", "clamped at 1", each([](double x) { return std::min(x, 1.0); })},
        {"occlusion", "left out", [](float* p) { p[0] = 1; }},
        {"dielectric_f0", "that of water", each([](double x) { return 0.5 * x; })},
        {"position", "5 cm off", [](float* p) { p[1] += 0.05f; }},
    };
}

// A scene rendered by forward+, and copies of its Frame with injected faults.
class Injected {
public:
    Injected(const std::string& name, Size size)
        : scene(loadScene(name)), renderer(device(), scene, pipelines()), settings(explained(size)) {
        std::vector<Channel> modes = explainedChannels();
        right = drawnBy(Path::forward_plus, renderer, settings, modes);
    }

    // The Frame that a renderer with these faults would produce.
    Frame with(const std::vector<Fault>& injected) {
        Frame frame = right;
        SurfaceImages images(device(), settings.size);
        for (std::size_t i = 0; i < surfaceChannels().size(); ++i) {
            const Channel number = surfaceChannels()[i];
            if (layerOf(number) != 0) continue;
            Image& image = frame.channels.at(number);
            for (const Fault& fault : injected)
                if (fault.channel == debugMode(number).name)
                    for (std::size_t p = 0; p < image.pixels(); ++p)
                        if (covered(p)) fault.plant(image.pixel(p));
        }
        for (std::size_t i = 0; i < surfaceChannels().size(); ++i) images.set(0, i, frame);
        const Image shaded = renderer.shadeChannels(settings, images).shade(0);
        frame.channels.at(Channel::lit) = shaded;
        return frame;
    }

    bool covered(std::size_t pixel) const {
        return right.channels.at(Channel::material_id).pixel(pixel)[0] >= 0;
    }

    const Scene scene;
    Renderer renderer;
    const Settings settings;
    Frame right;
};

double sumOfFractions(const Explanation& e) {
    return std::accumulate(e.causes.begin(), e.causes.end(), 0.0,
                           [](double sum, const Cause& cause) { return sum + cause.contribution; });
}

// The maps sum to the difference at each pixel, and each map's mean is its contribution.
void expectMapsAddUp(const Explanation& e, const Frame& baseline, const Frame& test) {
    const Image &a = baseline.channels.at(Channel::lit), &b = test.channels.at(Channel::lit);
    const auto mean = [](const Image& map) {
        return std::accumulate(map.data.begin(), map.data.end(), 0.0) / static_cast<double>(map.pixels());
    };
    for (const Cause& cause : e.causes) EXPECT_NEAR(mean(cause.map), cause.contribution, 1e-6 * e.distance);
    EXPECT_NEAR(mean(e.unexplained_map), e.unexplained, 1e-6 * e.distance);
    double all = mean(e.unexplained_map), worst = 0;
    for (const Cause& cause : e.causes) all += mean(cause.map);
    EXPECT_NEAR(all, e.distance, 1e-6 * e.distance);
    for (std::size_t p = 0; p < a.pixels(); ++p) {
        double difference = 0, sum = double{e.unexplained_map.pixel(p)[0]}, size = sum;
        for (int c = 0; c < 3; ++c) difference += std::abs(double{a.pixel(p)[c]} - b.pixel(p)[c]) / 3;
        for (const Cause& cause : e.causes) {
            sum += double{cause.map.pixel(p)[0]};
            size += std::abs(double{cause.map.pixel(p)[0]});
        }
        if (size > 0) worst = std::max(worst, std::abs(sum - difference) / size);
    }
    EXPECT_LE(worst, 1e-6);
}

std::vector<std::string> names(const Explanation& e) {
    std::vector<std::string> all;
    for (const Cause& cause : e.causes) all.push_back(cause.name);
    return all;
}

// Whether lit changed at all: a scene without metal, for instance, is not sensitive to a metallic fault.
bool hasEffect(const Explanation& e) {
    return e.distance > 0;
}

class ExplainOf : public testing::TestWithParam<std::string> {};

// Each fault alone is the only cause, explains everything, and contributions add up.
TEST_P(ExplainOf, NamesEachPlantedFault) {
    Injected injected(GetParam(), {96, 54});
    int effective = 0;
    for (const Fault& fault : faults()) {
        SCOPED_TRACE(fault.channel + ", " + fault.means);
        const Explanation e =
            explain(device(), injected.renderer, injected.scene, injected.right, injected.with({fault}));
        if (!hasEffect(e)) continue;
        ++effective;
        ASSERT_FALSE(e.causes.empty());
        EXPECT_EQ(e.causes.front().name, fault.channel);
        EXPECT_NEAR(sumOfFractions(e), e.distance - e.unexplained, 1e-6 * e.distance);
        EXPECT_LE(e.unexplained, 1e-6 * e.distance);
        const Frame test = injected.with({fault});
        expectMapsAddUp(e, injected.right, test);
        if (e.causes.size() > 1) continue;
        // The map of a single cause is the difference itself.
        const Image &a = injected.right.channels.at(Channel::lit), &b = test.channels.at(Channel::lit);
        std::size_t wrong = 0;
        for (std::size_t p = 0; p < a.pixels(); ++p)
            wrong += std::equal(a.pixel(p), a.pixel(p) + 3, b.pixel(p)) != (e.dominant.pixel(p)[0] < 0);
        EXPECT_EQ(wrong, 0u);
        double ofMaterials = 0;
        for (const CausePart& one : e.causes[0].materials) ofMaterials += one.contribution;
        EXPECT_NEAR(ofMaterials, e.distance, 1e-6 * e.distance);
    }
    EXPECT_GE(effective, 4);
    EXPECT_EQ(device().validationMessages(), 0u) << device().firstValidationMessage();
}

// Both of two faults are named before anything else, whichever is larger.
TEST_P(ExplainOf, NamesBothOfTwoFaults) {
    Injected injected(GetParam(), {96, 54});
    const std::vector<Fault> all = faults();
    int effective = 0;
    for (const auto& [first, second] : {std::pair<std::size_t, std::size_t>{0, 1}, {1, 3}, {0, 3}, {3, 8}}) {
        SCOPED_TRACE(all[first].channel + " and " + all[second].channel);
        const Explanation e = explain(device(), injected.renderer, injected.scene, injected.right,
                                      injected.with({all[first], all[second]}));
        const std::vector<std::string> found = names(e);
        EXPECT_NEAR(sumOfFractions(e), e.distance - e.unexplained, 1e-6 * e.distance);
        if (found.size() < 2) continue;  // the scene is insensitive to one of them
        ++effective;
        EXPECT_EQ(found.size(), 2u);
        EXPECT_TRUE(std::ranges::count(found, all[first].channel) == 1 &&
                    std::ranges::count(found, all[second].channel) == 1);
    }
    EXPECT_GE(effective, 2);
}

INSTANTIATE_TEST_SUITE_P(Builtin, ExplainOf,
                         testing::Values("builtin:gallery", "builtin:spheres", "builtin:dielectrics"),
                         sceneName);

TEST(Explain, OfTheSameFrameHasNoCause) {
    Injected injected("builtin:points", {64, 36});
    const Explanation e =
        explain(device(), injected.renderer, injected.scene, injected.right, injected.right);
    EXPECT_EQ(e.distance, 0);
    EXPECT_TRUE(e.causes.empty());
    EXPECT_TRUE(std::ranges::all_of(e.dominant.data, [](float position) { return position < 0; }));
}

// Two faults that hide each other: one restores the light that the other removes.
TEST(Explain, FaultsThatHideEachOtherAreBothNamed) {
    Injected injected("builtin:points", {64, 36});
    const Fault darker{"albedo", "halved", [](float* p) {
                           for (int c = 0; c < 3; ++c) p[c] *= 0.5f;
                       }};
    // Emission that nearly restores lit.
    const Frame dark = injected.with({darker});
    const Image &was = injected.right.channels.at(Channel::lit), &is = dark.channels.at(Channel::lit);
    Frame hidden = dark;
    Image& emission = hidden.channels.at(Channel::emission);
    Image& hidden_lit = hidden.channels.at(Channel::lit);
    for (std::size_t p = 0; p < was.pixels(); ++p)
        if (injected.covered(p))
            for (int c = 0; c < 3; ++c) {
                const float lost = 0.9f * (was.pixel(p)[c] - is.pixel(p)[c]);
                emission.pixel(p)[c] += lost;
                hidden_lit.pixel(p)[c] += lost;
            }
    const Explanation e = explain(device(), injected.renderer, injected.scene, injected.right, hidden);
    const std::vector<std::string> found = names(e);
    ASSERT_EQ(found.size(), 2u);
    EXPECT_EQ(std::ranges::count(found, "albedo") + std::ranges::count(found, "emission"), 2);
    ASSERT_FALSE(e.pairs.empty());
    EXPECT_GT(e.pairs.front().interaction, 0);
    for (const Cause& cause : e.causes) EXPECT_LT(cause.alone, 0) << "alone it makes things worse";
    expectMapsAddUp(e, injected.right, hidden);
    EXPECT_NEAR(sumOfFractions(e), e.distance - e.unexplained, 1e-6 * e.distance);
}

// A differing Setting is a cause like a differing channel, and its effect is located in the image.
TEST(Explain, SettingsAreCauses) {
    Injected injected("builtin:points", {64, 36});
    for (const auto& [option, value] : {std::pair<std::string, std::string>{"ambient", "0.2,0.2,0.2"},
                                        {"haze", "on"},
                                        {"multiscatter", "fdez"}}) {
        Settings settings = injected.settings;
        settings.set(option, value);
        const Frame test = drawnBy(Path::forward_plus, injected.renderer, settings, explainedChannels());
        const Explanation e = explain(device(), injected.renderer, injected.scene, injected.right, test);
        ASSERT_FALSE(e.causes.empty()) << option;
        EXPECT_EQ(e.causes.front().name, "--" + option);
        EXPECT_GT(e.frames, 1u);
        expectMapsAddUp(e, injected.right, test);
        EXPECT_NEAR(sumOfFractions(e), e.distance - e.unexplained, 1e-6 * e.distance);
    }
}

// The packed G-buffer's channels explain deferred's whole difference: both paths share the background and
// blended surfaces.
TEST(Explain, APackedGBufferIsExplainedByItsChannels) {
    for (const char* name : {"builtin:gallery", "builtin:glass"}) {
        const Scene scene = loadScene(name);
        Renderer renderer(device(), scene, pipelines());
        Settings settings = explained({96, 54});
        settings.gbuffer = GBufferEncoding::compact;
        const Frame baseline = drawnBy(Path::forward_plus, renderer, settings, explainedChannels()),
                    test = drawnBy(Path::deferred, renderer, settings, explainedChannels());
        const Explanation e = explain(device(), renderer, scene, baseline, test);
        EXPECT_GT(e.distance, 0);
        EXPECT_LE(e.unexplained, 1e-6 * e.distance);
        EXPECT_EQ(e.reproduction[0], 0) << name;
        EXPECT_EQ(e.reproduction[1], 0) << name;
        expectMapsAddUp(e, baseline, test);
        EXPECT_NEAR(sumOfFractions(e), e.distance - e.unexplained, 1e-6 * e.distance);
    }
}

std::vector<Channel> withTerms() {
    std::vector<Channel> modes = explainedChannels();
    for (const Channel term : termChannels()) modes.push_back(term);
    for (const Channel more : {Channel::shadow_visibility, Channel::local_visibility, Channel::light_count})
        modes.push_back(more);
    return modes;
}

// lit as a renderer with these terms would sum it, where nothing is blended.
void sumTerms(Frame& frame) {
    const auto data = [&](Channel number) { return frame.channels.at(number).data.data(); };
    Image& sum = frame.channels.at(Channel::lit);
    const float *const ids = data(Channel::material_id), *const d = data(Channel::lit_diffuse),
                       *const s = data(Channel::lit_specular), *const a = data(Channel::lit_ambient),
                       *const e = data(Channel::emission), *const t = data(Channel::transmittance),
                       *const h = data(Channel::lit_haze);
    float* const out = sum.data.data();
    for (std::size_t i = 0; i < sum.data.size(); ++i)
        if (ids[i / 3] >= 0) out[i] = (((d[i] + s[i]) + a[i]) + e[i]) * t[i] + h[i];
}

// Names the lighting component that a renderer computes differently, with all of the difference.
TEST(Explain, NamesTheStageThatTermsDifferIn) {
    const Scene scene = loadScene("builtin:points");
    Renderer renderer(device(), scene, pipelines());
    Settings settings = explained({64, 36});
    settings.haze = true;
    const Frame right = drawnBy(Path::forward_plus, renderer, settings, withTerms());
    struct Scaled {
        const char* stage;
        std::vector<Channel> terms;
        float scale;
    };
    for (const Scaled& fault : {Scaled{"direct diffuse", {Channel::lit_diffuse}, 0.8f},
                                {"direct specular", {Channel::lit_specular}, 1.5f},
                                {"ambient light", {Channel::lit_ambient}, 0.5f},
                                {"haze in the air", {Channel::lit_haze, Channel::transmittance}, 0.9f},
                                {"sum of terms", {}, 1}}) {
        SCOPED_TRACE(fault.stage);
        Frame test = right;
        for (const Channel term : fault.terms)
            for (float& value : test.channels.at(term).data) value *= fault.scale;
        if (fault.terms.empty()) {
            const Image& ids = test.channels.at(Channel::material_id);
            Image& all = test.channels.at(Channel::lit);
            for (std::size_t p = 0; p < all.pixels(); ++p)
                if (ids.pixel(p)[0] >= 0) all.pixel(p)[0] += 0.25f;  // nothing emits light
        } else {
            sumTerms(test);
        }
        const Explanation e = explain(device(), renderer, scene, right, test);
        ASSERT_GT(e.distance, 0);
        ASSERT_FALSE(e.causes.empty());
        EXPECT_EQ(e.causes.front().name, fault.stage);
        EXPECT_NEAR(e.causes.front().contribution, e.distance, 1e-5 * e.distance);
        EXPECT_LE(e.unexplained, 1e-5 * e.distance);
        EXPECT_NEAR(sumOfFractions(e), e.distance - e.unexplained, 1e-6 * e.distance);
        expectMapsAddUp(e, right, test);
    }
}

// A channel and a component at once, and direct light whose visibility differs.
TEST(Explain, StagesStandBesideChannelsAndShadowsBesideStages) {
    const Scene scene = loadScene("builtin:points");
    Renderer renderer(device(), scene, pipelines());
    const Settings settings = explained({64, 36});
    const Frame right = drawnBy(Path::forward_plus, renderer, settings, withTerms());
    Frame test = right;
    for (const Channel term : {Channel::lit_diffuse, Channel::lit_specular})
        for (float& value : test.channels.at(term).data) value *= 0.5f;
    for (float& fraction : test.channels.at(Channel::shadow_visibility).data) fraction *= 0.5f;
    sumTerms(test);
    Explanation e = explain(device(), renderer, scene, right, test);
    ASSERT_FALSE(e.causes.empty());
    EXPECT_EQ(names(e), std::vector<std::string>{"shadow_visibility"});
    EXPECT_NEAR(e.causes.front().contribution, e.distance, 1e-5 * e.distance);

    for (float& value : test.channels.at(Channel::emission).data) value += 0.01f;
    const Image& ids = test.channels.at(Channel::material_id);
    for (std::size_t p = 0; p < ids.pixels(); ++p)
        if (ids.pixel(p)[0] < 0) std::fill_n(test.channels.at(Channel::emission).pixel(p), 3, 0.0f);
    sumTerms(test);
    e = explain(device(), renderer, scene, right, test);
    const std::vector<std::string> both = names(e);
    EXPECT_EQ(both.size(), 2u);
    EXPECT_EQ(std::ranges::count(both, "shadow_visibility") + std::ranges::count(both, "emission"), 2);
    EXPECT_LE(e.unexplained, 1e-5 * e.distance);
    EXPECT_NEAR(sumOfFractions(e), e.distance - e.unexplained, 1e-6 * e.distance);
}

// A missing shadow is attributed to the sun that would cast it, although that sun lights nothing there in
// the frame with shadows.
TEST(Explain, AMissingShadowIsOfTheLightThatWouldCastIt) {
    const Scene scene = loadScene("builtin:suns");
    Renderer renderer(device(), scene, pipelines());
    Settings settings = explained({64, 36});
    settings.shadows = Shadows::pcf;
    const Frame right = drawnBy(Path::forward_plus, renderer, settings, withTerms());
    Settings without = settings;
    without.shadows = Shadows::off;
    Frame test = drawnBy(Path::forward_plus, renderer, without, withTerms());
    test.settings = right.settings;
    for (const auto& [baseline, other] :
         {std::pair<const Frame*, const Frame*>(&right, &test), {&test, &right}}) {
        const Explanation e = explain(device(), renderer, scene, *baseline, *other);
        ASSERT_FALSE(e.causes.empty());
        EXPECT_EQ(e.causes.front().name, "shadow_visibility");
        ASSERT_EQ(e.causes.front().lights.size(), 1u);
        EXPECT_EQ(e.causes.front().lights[0].index, 0) << "the first sun alone casts";
        EXPECT_NEAR(e.causes.front().lights[0].contribution, e.causes.front().contribution,
                    1e-3 * e.causes.front().contribution);
    }
}

// Without terms the same difference stays unexplained.
TEST(Explain, WithoutTermsTheRestStaysUnexplained) {
    Injected injected("builtin:points", {32, 18});
    Frame test = injected.right;
    for (std::size_t p = 0; p < test.channels.at(Channel::lit).pixels(); ++p)
        if (injected.covered(p)) test.channels.at(Channel::lit).pixel(p)[0] *= 1.1f;
    const Explanation e = explain(device(), injected.renderer, injected.scene, injected.right, test);
    EXPECT_TRUE(e.causes.empty());
    EXPECT_EQ(e.unexplained, e.distance);
}

TEST(Explain, MissingChannelsAreNamed) {
    Injected injected("builtin:triangle", {16, 9});
    Frame lacking = injected.right;
    lacking.channels.erase(Channel::roughness);
    try {
        explain(device(), injected.renderer, injected.scene, injected.right, lacking);
        FAIL() << "explained without roughness";
    } catch (const std::runtime_error& error) {
        EXPECT_NE(std::string(error.what()).find("roughness"), std::string::npos) << error.what();
    }
}

}  // namespace
}  // namespace diptych::tests
