// SPDX-License-Identifier: MIT
// Injected deviations of a renderer, one and two at a time: exactly these are reported.
#include "compare/external/calibration.h"

#include "compare/external/placement.h"
#include "compare/external/response.h"
#include "compare/external/sky.h"
#include "compare/render/reference_frame.h"
#include "shared/contract/debug_mode.h"
#include "shared/image/srgb.h"
#include "shared/scene/load.h"
#include "tests/support/campaign.h"
#include "tests/support/srgb.h"

#include <gtest/gtest.h>

#include <glm/mat3x3.hpp>
#include <glm/trigonometric.hpp>

#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <random>
#include <set>

namespace diptych::external {
namespace {

// Deviations of a fake renderer from its job. Its images are the reference's for the changed job, with
// noise and a few percent more or less light.
struct Fake {
    double fov = 0;           // degrees
    int right = 0, down = 0;  // half pixels
    bool upside_down = false, mirrored = false;
    std::function<double(double)> curve;
    std::optional<glm::dmat3> primaries;
    bool colour_linear = false, data_srgb = false;
    std::map<Lamp, double> factors;  // 0: not drawn
    double turned = 0;               // degrees
    bool sky_mirrored = false, sky_cut_off = false;
};

struct Fault {
    std::string group, name;  // two faults of one group are never combined
    std::string text;         // words of its description
    std::function<void(Fake&)> plant;
};

glm::dmat3 fromRec709(const glm::dmat3& rec709_from) {
    return glm::inverse(rec709_from);
}

std::vector<Fault> faults() {
    // ITU-R BT.2087 and SMPTE EG 432-1, column by column.
    const glm::dmat3 rec709_from_p3{{1.2249, -0.0420, -0.0196}, {-0.2249, 1.0420, -0.0786}, {0, 0, 1.0982}};
    const glm::dmat3 rec709_from_rec2020{
        {1.6605, -0.1246, -0.0182}, {-0.5876, 1.1329, -0.1006}, {-0.0728, -0.0083, 1.1187}};
    const auto lights = [](double factor) {
        return [factor](Fake& f) {
            for (const Lamp lamp : {Lamp::directional, Lamp::point, Lamp::spot, Lamp::area})
                f.factors[lamp] = factor;
        };
    };
    const auto lamp = [](Lamp which, double factor) {
        return [which, factor](Fake& f) { f.factors[which] = factor; };
    };
    const auto encoded = [](double v) { return encodedSrgb(std::min(v, 1.0)); };
    const double pi = glm::radians(180.0);
    return {
        {"fov", "fov", "degrees wider than requested", [](Fake& f) { f.fov = 1; }},
        {"fov", "fov", "degrees narrower than requested", [](Fake& f) { f.fov = -1; }},
        {"shift", "shift", "pixels too far right", [](Fake& f) { f.right = 1; }},
        {"shift", "shift", "too far down", [](Fake& f) { f.down = 1; }},
        {"upside_down", "upside_down", "the picture is upside down", [](Fake& f) { f.upside_down = true; }},
        {"mirrored", "mirrored", "the picture is mirrored, left for right",
         [](Fake& f) { f.mirrored = true; }},
        {"curve", "srgb_output", "pixels are encoded as sRGB and clipped at 1; they should be linear",
         [=](Fake& f) { f.curve = encoded; }},
        {"curve", "tone_curve", "pixels have a tone curve; they should be linear",
         [](Fake& f) { f.curve = [](double v) { return v / (1 + v); }; }},
        {"curve", "tone_curve", "pixels have a tone curve; they should be linear",
         [](Fake& f) {
             f.curve = [](double v) {  // Narkowicz's fit of the ACES film curve, with its encoding
                 return std::pow(std::clamp(v * (2.51 * v + 0.03) / (v * (2.43 * v + 0.59) + 0.14), 0.0, 1.0),
                                 1 / 2.2);
             };
         }},
        {"curve", "cut_off", "radiance is clipped at ",
         [](Fake& f) { f.curve = [](double v) { return std::min(v, 1.0); }; }},
        {"curve", "exposure", "all radiance is multiplied by 1 / 2",
         [](Fake& f) { f.curve = [](double v) { return 0.5 * v; }; }},
        {"primaries", "primaries", "red, green and blue have the primaries of Display P3",
         [=](Fake& f) { f.primaries = fromRec709(rec709_from_p3); }},
        {"primaries", "primaries", "red, green and blue have the primaries of Rec.2020",
         [=](Fake& f) { f.primaries = fromRec709(rec709_from_rec2020); }},
        {"colour", "colour_textures_linear", "colour textures are read as linear; they are sRGB",
         [](Fake& f) { f.colour_linear = true; }},
        {"data", "data_textures_srgb", "data textures are decoded from sRGB; they are linear",
         [](Fake& f) { f.data_srgb = true; }},
        {"lights", "light_factor", "lights are pi times as bright as requested", lights(pi)},
        {"lights", "light_factor", "lights are 1 / pi times as bright as requested", lights(1 / pi)},
        {"lights", "light_factor", "lights are 2 times as bright as requested", lights(2)},
        {"lights", "point_factor", "point lights are 4 pi times as bright as requested",
         lamp(Lamp::point, 4 * pi)},
        {"lights", "spot_factor", "spot lights are 1 / 2 times as bright as requested",
         lamp(Lamp::spot, 0.5)},
        {"lights", "directional_factor", "directional lights are pi times as bright as requested",
         lamp(Lamp::directional, pi)},
        {"lights", "no_directional_lights", "directional lights are not drawn", lamp(Lamp::directional, 0)},
        {"lights", "no_point_lights", "point lights are not drawn", lamp(Lamp::point, 0)},
        {"lights", "no_spot_lights", "spot lights are not drawn", lamp(Lamp::spot, 0)},
        {"lights", "no_area_lights", "area lights are not drawn", lamp(Lamp::area, 0)},
        {"turned", "environment_rotation", "the environment is rotated by 90 degrees more than requested",
         [](Fake& f) { f.turned = 90; }},
        {"turned", "environment_rotation", "the environment is rotated by 180 degrees more than requested",
         [](Fake& f) { f.turned = 180; }},
        {"turned", "environment_rotation", "the environment is rotated by -90 degrees more than requested",
         [](Fake& f) { f.turned = -90; }},
        {"sky", "environment_mirrored", "the environment is mirrored, left for right",
         [](Fake& f) { f.sky_mirrored = true; }},
        {"cut", "ldr_environment", "the environment's radiance is clipped at 1",
         [](Fake& f) { f.sky_cut_off = true; }},
        {"brightness", "environment_factor", "environments are 2 times as bright as requested",
         lamp(Lamp::environment, 2)},
        {"brightness", "environment_factor", "environments are 1 / pi times as bright as requested",
         lamp(Lamp::environment, 1 / pi)}};
}

// Images of the charts, each drawn once.
class Studio {
public:
    Studio() : charts_(loadScene("builtin:calibration")) {
        for (const Lamp lamp : lamps) truths_[lamp] = referenceUnder(charts_, lamp);
        std::normal_distribution<double> noise(1, 0.02);
        for (double& factor : noise_) factor = noise(random_);
    }
    const Scene& charts() const { return charts_; }

    std::vector<LampFrame> images(const Fake& fake, unsigned seed) {
        random_.seed(seed);
        std::vector<LampFrame> all;
        for (const Lamp lamp : lamps) all.push_back({lamp, truths_.at(lamp), image(fake, lamp), {}});
        return all;
    }

private:
    Image image(const Fake& fake, Lamp lamp) {
        const double model = std::uniform_real_distribution<double>(0.95, 1.05)(random_);
        const auto found = fake.factors.find(lamp);
        const double factor = (found == fake.factors.end() ? 1 : found->second) * model;
        const ChartReference& lit = drawn(fake, lamp);
        const ChartReference& dark = drawn(fake, Lamp::none);
        Image image = lit.lit;
        std::size_t next = random_() % noise_.size();
        for (int y = 0; y < image.height; ++y)
            for (int x = 0; x < image.width; ++x) {
                const int fx = fake.mirrored ? image.width - 1 - x : x,
                          fy = fake.upside_down ? image.height - 1 - y : y;
                glm::dvec3 v;
                for (int c = 0; c < 3; ++c)
                    v[c] =
                        (dark.lit.at(fx, fy, c) + factor * (lit.lit.at(fx, fy, c) - dark.lit.at(fx, fy, c))) *
                        noise_[next++ % noise_.size()];
                if (fake.primaries) v = *fake.primaries * v;
                for (int c = 0; c < 3; ++c)
                    image.at(x, y, c) = static_cast<float>(fake.curve ? fake.curve(v[c]) : v[c]);
            }
        return image;
    }

    const ChartReference& drawn(const Fake& fake, Lamp lamp) {
        const bool sky = lamp == Lamp::environment;
        const std::string key = fmt::format(
            "{} {} {} {} {} {} {} {} {}", nameOf(lamp), fake.fov, fake.right, fake.down, fake.colour_linear,
            fake.data_srgb, sky ? fake.turned : 0, sky && fake.sky_mirrored, sky && fake.sky_cut_off);
        const auto [found, added] = drawn_.try_emplace(key);
        if (added) found->second = draw(fake, lamp);
        return found->second;
    }

    // An additional column or row moves the projection's centre by half a pixel; the image is cropped to its
    // original size.
    ChartReference draw(const Fake& fake, Lamp lamp) const {
        Scene scene = chartsUnder(charts_, lamp);
        Settings settings = chartSettings(lamp);
        // With light, where only the centres of faces count, at a quarter of the size; under the environment,
        // where pixels are slow, at an eighth.
        const int coarse = lamp == Lamp::none ? 1 : lamp == Lamp::environment ? 8 : 4;
        const Size whole_size = settings.size;
        const Size size{whole_size.width / coarse, whole_size.height / coarse};
        settings.size = coarse > 1 ? size : Size{size.width + fake.right, size.height + fake.down};
        double& yfov = scene.cameras.front().yfov;
        yfov += glm::radians(fake.fov);
        yfov = 2 * std::atan(std::tan(yfov / 2) * settings.size.height / size.height);
        for (TextureImage& image : scene.images)
            for (std::size_t i = 0; i < image.rgba.size(); i += 4) {
                const bool colour = image.name == "128";
                // Codes that decode to what the fake reads: 0.502 of a colour, 0.216 of a number.
                for (std::size_t c = 0; colour && fake.colour_linear && c < 3; ++c) image.rgba[i + c] = 188;
                if (!colour && fake.data_srgb) image.rgba[i + 2] = 55;
            }
        if (scene.environment) {
            const Image sky = scene.environment->radiance;
            for (int y = 0; y < sky.height; ++y)
                for (int x = 0; x < sky.width; ++x)
                    for (int c = 0; c < 3; ++c) {
                        float value = sky.at(fake.sky_mirrored ? sky.width - 1 - x : x, y, c);
                        if (fake.sky_cut_off) value = std::min(value, 1.0f);
                        scene.environment->radiance.at(x, y, c) = value;
                    }
        }
        settings.env_rotation = static_cast<float>(fake.turned);
        settings.path = Path::reference;
        settings.reference_mode = ReferenceMode::scene;
        RenderOptions options;
        options.channels = {Channel::lit};
        options.runs = 0;
        const Frame frame =
            std::move(drawWithoutDevice(scene, {referenceSettings(settings)}, options).front());
        const Image& whole = frame.channels.at(Channel::lit);
        ChartReference shown{Image(whole_size.width, whole_size.height, 3), {}};
        for (int y = 0; y < whole_size.height; ++y)
            for (int x = 0; x < whole_size.width; ++x)
                for (int c = 0; c < 3; ++c) shown.lit.at(x, y, c) = whole.at(x / coarse, y / coarse, c);
        return shown;
    }

    const Scene charts_;
    std::mt19937 random_{1};
    std::array<double, 99991> noise_{};  // factors; each image starts at another one
    std::map<Lamp, ChartReference> truths_;
    std::map<std::string, ChartReference> drawn_;
};

Studio& studio() {
    static Studio one;
    return one;
}

std::set<std::string> setOfWords(const std::string& text) {
    std::istringstream stream(text);
    return {std::istream_iterator<std::string>(stream), {}};
}

std::set<std::string> namesOf(const std::vector<Deviation>& deviations) {
    std::set<std::string> names;
    for (const Deviation& one : deviations) names.insert(one.name);
    return names;
}

struct Tally {
    int right = 0, all = 0;
    std::string wrong;
    void add(const std::string& planted, const std::vector<Deviation>& found) {
        ++all;
        if (namesOf(found) == setOfWords(planted)) {
            ++right;
            return;
        }
        wrong += planted + " ->";
        for (const Deviation& one : found) wrong += " " + one.name + " (" + one.text + ")";
        wrong += "\n";
    }
};

TEST(Calibration, NothingIsNamedOfARendererThatMeansWhatItIsTold) {
    for (const unsigned seed : {0u, 1u})
        EXPECT_EQ(namesOf(deviationsOf(studio().charts(), studio().images({}, seed))),
                  std::set<std::string>());
}

TEST(Calibration, OnePlantedDeviationIsNamed) {
    Tally tally;
    unsigned seed = 100;
    for (const Fault& fault : faults()) {
        Fake fake;
        fault.plant(fake);
        const std::vector<Deviation> found = deviationsOf(studio().charts(), studio().images(fake, seed++));
        tally.add(fault.name, found);
        if (!found.empty() && found.front().text.find(fault.text) == std::string::npos)
            ADD_FAILURE() << found.front().text << ": not " << fault.text;
    }
    EXPECT_EQ(tally.right, tally.all) << tally.wrong;
}

// All pairs in a full test run, otherwise one of six.
TEST(Calibration, TwoAtOnceAreNamed) {
    Tally tally;
    const unsigned stride = isCampaign() ? 1 : 6;
    unsigned seed = 1000;
    const std::vector<Fault> all = faults();
    for (std::size_t i = 0; i < all.size(); ++i)
        for (std::size_t k = i + 1; k < all.size(); ++k) {
            if (all[i].group == all[k].group || ++seed % stride != campaignSeed() % stride) continue;
            Fake fake;
            all[i].plant(fake);
            all[k].plant(fake);
            tally.add(all[i].name + " " + all[k].name,
                      deviationsOf(studio().charts(), studio().images(fake, seed)));
        }
    std::printf("two at once: %d of %d are named\n%s", tally.right, tally.all, tally.wrong.c_str());
    EXPECT_GE(tally.right, 0.95 * tally.all) << tally.wrong;
}

// An input correction undoes the deviation.
TEST(Calibration, GrantsAreTheWayBack) {
    const auto correctionOf = [&](const Fake& fake) {
        nlohmann::ordered_json corrections = nlohmann::ordered_json::object();
        for (const Deviation& one : deviationsOf(studio().charts(), studio().images(fake, 7)))
            corrections.update(one.correction);
        return corrections;
    };
    Fake fake;
    fake.fov = 1;
    EXPECT_NEAR(correctionOf(fake)["fov_offset"].get<double>(), -1, 0.1);
    fake = {};
    fake.right = 1;
    EXPECT_NEAR(correctionOf(fake)["shift_x"].get<double>(), -0.5, 0.1);
    fake = {};
    fake.turned = 90;
    EXPECT_EQ(correctionOf(fake)["environment_rotation"], -90);
    fake = {};
    for (const Lamp lamp : {Lamp::directional, Lamp::point, Lamp::spot, Lamp::area})
        fake.factors[lamp] = 1 / glm::radians(180.0);
    EXPECT_NEAR(correctionOf(fake)["light_factor"].get<double>(), glm::radians(180.0), 1e-9);
}

TEST(Calibration, AFaceTakesFromTheSkyWhatTheReferenceSays) {
    const Scene& charts = studio().charts();
    const Image ids = referenceUnder(charts, Lamp::environment).ids;
    const Image lit = std::move(studio().images({}, 3).back().image);
    int faces = 0;
    for (const Mesh& mesh : charts.meshes) {
        const Primitive& primitive = mesh.primitives.front();
        const std::string& name = charts.materials[static_cast<std::size_t>(primitive.material)].name;
        if (!std::set<std::string>{"front", "left", "right", "up", "down"}.contains(name)) continue;
        ++faces;
        const auto shown = medianColor(ids, primitive.material, lit, {});
        ASSERT_TRUE(shown) << name;
        const glm::dvec3 light =
            lightFrom(charts.environment->radiance, glm::dvec3(primitive.normals.front()), false);
        // The images have up to 5 % more or less light.
        for (int c = 0; c < 3; ++c) EXPECT_NEAR((*shown)[c], light[c], 0.08 * light[c] + 0.002) << name << c;
    }
    EXPECT_EQ(faces, 5);
}

TEST(Calibration, AResponseIsItsOwnInverse) {
    const auto rampBy = [](const std::function<double(double)>& curve) {
        std::vector<RampStep> ramp;
        for (const double v : {0.02, 0.05, 0.1, 0.2, 0.35, 0.5, 0.7, 1.0, 2.0, 4.0, 8.0})
            ramp.push_back({v, curve(v)});
        return Response(ramp);
    };
    const Response plain = rampBy([](double v) { return v; });
    EXPECT_EQ(plain.kind(), CurveKind::linear);
    EXPECT_FALSE(plain.cutOffAt());
    EXPECT_EQ(rampBy([](double v) { return std::pow(v, 1 / 2.2); }).kind(), CurveKind::tone)
        << "a power is not sRGB's curve";
    EXPECT_EQ(rampBy([](double v) { return v < 1 ? encodedSrgb(v) : v; }).kind(), CurveKind::srgb)
        << "sRGB ends at 1; a renderer may write anything above";
    const Response reinhard = rampBy([](double v) { return v / (1 + v); });
    EXPECT_EQ(reinhard.kind(), CurveKind::tone);
    for (const double v : {0.03, 0.3, 3.0})
        EXPECT_NEAR(reinhard.radiance(glm::dvec3(v / (1 + v))).r, v, 0.06 * v) << v;
}

// Emitters of one component each, as a renderer with these primaries writes them (BT.2087, EG 432-1).
TEST(Calibration, PrimariesAreNamedByTheirColumns) {
    using Columns = std::array<glm::dvec3, 3>;
    const std::pair<std::optional<Primaries>, Columns> cases[] = {
        {Primaries::rec709, {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}},
        {Primaries::display_p3, {{{0.8225, 0.0332, 0.0171}, {0.1775, 0.9668, 0.0724}, {0, 0, 0.9105}}}},
        {Primaries::rec2020,
         {{{0.6274, 0.0691, 0.0164}, {0.3293, 0.9195, 0.0880}, {0.0433, 0.0114, 0.8956}}}},
        {std::nullopt, {{{0, 1, 0}, {0, 0, 1}, {1, 0, 0}}}}};
    for (const auto& [primaries, columns] : cases) {
        Response response({{0.1, 0.1}, {1, 1}, {4, 4}});
        Columns doubled = columns;
        for (glm::dvec3& column : doubled) column *= 2;
        response.measurePrimaries(doubled, 2);
        EXPECT_EQ(response.primaries(), primaries);
        const glm::dvec3 wanted(0.5, 0.25, 0.75),
            written = columns[0] * wanted.r + columns[1] * wanted.g + columns[2] * wanted.b;
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(response.radiance(written)[c], wanted[c], 1e-3) << c;
    }
}

}  // namespace
}  // namespace diptych::external
