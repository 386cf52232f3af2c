// SPDX-License-Identifier: MIT
// Errors of both area-light methods relative to the reference. Measures the table of
// shared/light/MEASURED.md and writes it to the file named by DIPTYCH_AREA_TABLE.
#include "tests/probe/area_builder.h"

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
constexpr std::array angles{0.0, 45.0, 60.0, 75.0, 85.0};
constexpr std::array distances{0.5, 1.0, 2.0, 5.0};
constexpr std::array sizes{0.3, 1.0};

struct AreaCase {
    LightKind kind;
    double roughness, angle, distance, size;
    bool dielectric;  // false: a metal with F = 1
    // {diffuse, specular}, as shadeArea() returns them.
    std::array<double, 2> reference, ltc, points;
    double sky;  // specular radiance under a uniform sky of the same radiance
};

// Lights of a given size (m) at a given distance (m): in the mirror direction of the viewer, beside it,
// and above the surface.
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
    for (const LightKind kind : areaKinds)
        for (const double roughness : roughnesses)
            for (const double angle : angles)
                for (const double distance : distances)
                    for (const double size : sizes)
                        for (const Light& light : placesOf(kind, angle, distance, size))
                            for (const bool dielectric : {false, true}) {
                                Receiver r{.roughness = roughness, .to_viewer = viewAt(angle)};
                                if (dielectric) r.metallic = 0, r.albedo = 0.5;
                                pushArea(input, light, r);
                                const glm::dvec2 f = fresnelOf(r);
                                const double sky = ltcTable().at(roughness, r.nDotV()).reflected(f.x, f.y);
                                cases.push_back({kind,
                                                 roughness,
                                                 angle,
                                                 distance,
                                                 size,
                                                 dielectric,
                                                 referenceArea(light, r),
                                                 {},
                                                 {},
                                                 sky});
                            }
    const auto ltc = shadeArea(probes, input), points = shadeArea(probes, input, true);
    for (std::size_t i = 0; i < cases.size(); ++i) cases[i].ltc = ltc[i], cases[i].points = points[i];
    return cases;
}

double seen(const std::array<double, 2>& shaded) {
    return shaded[0] + shaded[1];
}

// |shaded - reference|: mean, relative to the reference's mean, and maximum, relative to a sky of the same
// radiance.
struct Error {
    double sum = 0, reference = 0, max = 0;
    void add(double shaded, double expected, double sky) {
        const double off = std::abs(shaded - expected);
        sum += off, reference += expected, max = std::max(max, off / sky);
    }
    double mean() const { return sum / reference; }
    std::string words(const char* format) const {
        return fmt::format(fmt::runtime(format), 100 * mean(), 100 * max);
    }
};

// `dielectric`: diffuse base plus layer. `metal`, `layer`: specular lobe alone.
struct Metrics {
    Error metal, layer, dielectric, points;
    void add(const AreaCase& c) {
        points.add(c.points[1], c.reference[1], c.sky);
        (c.dielectric ? layer : metal).add(c.ltc[1], c.reference[1], c.sky);
        if (c.dielectric) dielectric.add(seen(c.ltc), seen(c.reference), seen({0.5, c.sky}));
    }
    std::string row() const {
        const char* format = "{:.1f} / {:.1f}";
        return fmt::format("{} | {} | {} | {}", metal.words(format), layer.words(format),
                           dielectric.words(format), points.words("{:.0f} / {:.0f}"));
    }
};

template <class Key>
std::string tableOf(const std::vector<AreaCase>& cases, const char* name, const Key& key) {
    std::map<std::string, Metrics> rows;
    for (const AreaCase& c : cases) rows[key(c)].add(c);
    std::string text = fmt::format(
        "| {} | metal | a dielectric's layer | dielectric | representative |\n|---|---|---|---|---|\n", name);
    for (const auto& [label, metrics] : rows) text += fmt::format("| {} | {} |\n", label, metrics.row());
    return text;
}

std::string roughnessAndAngle(const AreaCase& c) {
    return fmt::format("{:.2f}, {:.0f}", c.roughness, c.angle);
}

// The mean error stays below 5 % at every roughness and angle, for dielectrics and for metals up to 75
// degrees, plus a tenth for other devices' rounding. At 85 degrees a metal has the fit's residual error
// (shared/light/MEASURED.md).
// The largest error of any light, relative to a sky of the same radiance, is at most half the total
// variation between lobe and transformed cosine, plus 2 % for table interpolation and half floats.
TEST(AreaError, IsBoundedByTheFit) {
    Probes probes;
    const std::vector<AreaCase> cases = measured(probes);
    std::map<std::string, Metrics> groups;
    Metrics all;
    for (const AreaCase& c : cases) {
        const LtcCell cell = ltcTable().at(c.roughness, std::cos(c.angle * reference::pi / 180));
        const LtcLobe& lobe = c.dielectric ? cell.layer : cell.even;
        EXPECT_LE(std::abs(c.ltc[1] - c.reference[1]) / c.sky, 0.5 * double{lobe.error} + 0.02)
            << static_cast<int>(c.kind) << " roughness " << c.roughness << " angle " << c.angle
            << " distance " << c.distance << " size " << c.size << (c.dielectric ? " dielectric" : " metal");
        groups[roughnessAndAngle(c)].add(c);
        all.add(c);
    }
    for (const auto& [name, metrics] : groups) {
        EXPECT_LE(metrics.dielectric.mean(), 0.055) << name;
        EXPECT_LE(metrics.layer.mean(), name.ends_with("85") ? 0.08 : 0.055) << name;
        EXPECT_LE(metrics.metal.mean(), name.ends_with("85") ? 0.16 : 0.055) << name;
    }
    EXPECT_LT(all.metal.mean(), 0.1 * all.points.mean())
        << "a representative point is as good: the table is not worth its while";
    std::string text;
    text += tableOf(cases, "roughness, angle", roughnessAndAngle);
    text += tableOf(cases, "distance", [](const AreaCase& c) { return fmt::format("{:.1f} m", c.distance); });
    text += tableOf(cases, "shape", [](const AreaCase& c) { return std::string(nameOf(c.kind)); });
    if (const char* file = std::getenv("DIPTYCH_AREA_TABLE")) std::ofstream(file) << text;
}

}  // namespace
}  // namespace diptych::tests
