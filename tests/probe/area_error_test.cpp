// SPDX-License-Identifier: MIT
// The errors of both ways of shading area lights against the reference: the table of shared/light/README.md
// is measured here, and written to the file that DIPTYCH_AREA_TABLE names.
#include "tests/probe/area_maker.h"

#include <gtest/gtest.h>

#include <fmt/format.h>

#include <cstdlib>
#include <fstream>
#include <map>
#include <string>
#include <vector>

namespace diptych::tests {
namespace {

constexpr std::array roughnesses{0.1, 0.25, 0.5, 0.75, 1.0};
constexpr std::array angles{0.0, 45.0, 75.0};
constexpr std::array distances{0.5, 1.0, 2.0, 5.0};
constexpr std::array sizes{0.3, 1.0};

// Errors of the light's specular reflection, relative to that of a sky of the same radiance, so that a light
// counts by its apparent size.
struct AreaCase {
    LightKind kind;
    double roughness, angle, distance, size;
    std::array<double, 2> reference, ltc, points;
    double sky;
};

// A light of a given size (m) at a given distance (m): at the mirror image of the viewer, beside it, and
// above the surface.
std::vector<Light> placesOf(LightKind kind, double angle, double distance, double size) {
    std::vector<Light> lights;
    const glm::dvec3 mirrored = viewAt(angle, reference::pi);
    for (const glm::dvec3& towards :
         {mirrored, glm::normalize(mirrored + glm::dvec3(0, 0.5, 0.2)), glm::dvec3(0.2, 0, 0.98)}) {
        Light light = reference::lightOf(kind, glm::normalize(towards) * distance, -towards);
        light.width = light.length = static_cast<float>(size), light.height = static_cast<float>(size / 2);
        light.radius = static_cast<float>(kind == LightKind::tube ? size / 20 : size / 2);
        lights.push_back(light);
    }
    return lights;
}

std::vector<AreaCase> measured(Probes& probes) {
    std::vector<AreaCase> cases;
    std::vector<float> input;
    for (const LightKind kind : {LightKind::rect, LightKind::disc, LightKind::tube})
        for (const double roughness : roughnesses)
            for (const double angle : angles)
                for (const double distance : distances)
                    for (const double size : sizes)
                        for (const Light& light : placesOf(kind, angle, distance, size)) {
                            const Receiver r{.roughness = roughness, .to_viewer = viewAt(angle)};
                            pushArea(input, light, r);
                            AreaCase c{kind, roughness, angle, distance, size, referenceArea(light, r),
                                       {},   {},        0};
                            c.sky = double{ltcTable().at(roughness, r.nDotV()).magnitude};
                            cases.push_back(c);
                        }
    const auto ltc = shadeArea(probes, input), points = shadeArea(probes, input, true);
    for (std::size_t i = 0; i < cases.size(); ++i) cases[i].ltc = ltc[i], cases[i].points = points[i];
    return cases;
}

// Mean and largest of |specular - reference|, in percent of the reference's mean.
struct Figures {
    double reference = 0, ltc = 0, ltc_most = 0, points = 0, points_most = 0;
    int count = 0;
    void add(const AreaCase& c) {
        const double a = std::abs(c.ltc[1] - c.reference[1]), b = std::abs(c.points[1] - c.reference[1]);
        reference += c.reference[1], ltc += a, points += b, ++count;
        ltc_most = std::max(ltc_most, a / c.sky), points_most = std::max(points_most, b / c.sky);
    }
    std::string row() const {
        return fmt::format("{:.1f} | {:.1f} | {:.0f} | {:.0f}", 100 * ltc / reference, 100 * ltc_most,
                           100 * points / reference, 100 * points_most);
    }
};

template <class Key>
std::string tableOf(const std::vector<AreaCase>& cases, const char* name, const Key& key) {
    std::map<std::string, Figures> rows;
    for (const AreaCase& c : cases) rows[key(c)].add(c);
    std::string text =
        fmt::format("| {} | ltc: mean | most | representative: mean | most |\n|---|---|---|---|---|\n", name);
    for (const auto& [label, figures] : rows) text += fmt::format("| {} | {} |\n", label, figures.row());
    return text;
}

// The error of a light's reflection, relative to a sky of the same radiance, is at most half the cell's
// distance between lobe and transformed cosine (total variation); the table's bilinear interpolation and
// half floats add up to 2 %.
TEST(AreaError, IsBoundedByTheFit) {
    Probes probes;
    const std::vector<AreaCase> cases = measured(probes);
    Figures all;
    for (const AreaCase& c : cases) {
        const LtcCell cell = ltcTable().at(c.roughness, std::cos(c.angle * reference::pi / 180));
        EXPECT_LE(std::abs(c.ltc[1] - c.reference[1]) / c.sky, 0.5 * double{cell.error} + 0.02)
            << static_cast<int>(c.kind) << " roughness " << c.roughness << " angle " << c.angle
            << " distance " << c.distance << " size " << c.size;
        all.add(c);
    }
    EXPECT_LT(all.ltc, 0.5 * all.points)
        << "a representative point is as good: the table is not worth its while";
    std::string text;
    const auto kindOf = [](const AreaCase& c) {
        return std::string(c.kind == LightKind::rect ? "rect" : c.kind == LightKind::disc ? "disc" : "tube");
    };
    text += tableOf(cases, "roughness", [](const AreaCase& c) { return fmt::format("{:.2f}", c.roughness); });
    text += tableOf(cases, "angle", [](const AreaCase& c) { return fmt::format("{:.0f}", c.angle); });
    text += tableOf(cases, "distance", [](const AreaCase& c) { return fmt::format("{:.1f} m", c.distance); });
    text += tableOf(cases, "shape", kindOf);
    text += tableOf(cases, "roughness, angle",
                    [](const AreaCase& c) { return fmt::format("{:.2f}, {:.0f}", c.roughness, c.angle); });
    if (const char* file = std::getenv("DIPTYCH_AREA_TABLE")) std::ofstream(file) << text;
}

}  // namespace
}  // namespace diptych::tests
