// SPDX-License-Identifier: MIT
#include "shared/scene/builtin/builtin.h"

#include "shared/image/free_memory.h"
#include "shared/scene/builtin/scenes.h"
#include "shared/scene/lights/rig.h"
#include "shared/text/did_you_mean.h"
#include "shared/text/fail.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <set>
#include <span>
#include <string_view>

namespace diptych {
namespace {

// A number after the name, as in "spheres?lights=64".
struct Parameter {
    std::string_view name;
    std::uint32_t default_value, max;
};
using Numbers = std::span<const std::uint32_t>;  // one per parameter, in order

constexpr bool IMAGE = false, TEST = true;

struct Row {
    std::string_view name, shows;
    void (*make)(Builder&);
    bool for_tests = TEST;
    void (*makeWith)(Builder&, Numbers) = nullptr;
    std::span<const Parameter> parameters = {};
    double (*bytes)(Numbers) = nullptr;  // estimated memory (rig.h: lightBytes)
};

constexpr std::array sphereParameters{Parameter{"lights", 256, 0x7fffffffu}};
// The maxima keep products within 32-bit indices.
constexpr std::array arrayParameters{
    Parameter{"objects", 100, 10'000'000}, Parameter{"triangles", 20'000, 1'000'000'000},
    Parameter{"meshes", 1, 10'000'000}, Parameter{"materials", 4, 10'000'000},
    Parameter{"texture_mib", 0, 65'536}};
constexpr std::array coveredParameters{Parameter{"coated", 0, 100}, Parameter{"woven", 0, 100},
                                       Parameter{"brushed", 0, 100}, Parameter{"glass", 0, 100},
                                       Parameter{"lights", 64, 0x7fffffffu}};

// Measured on lavapipe (scene/MEASURED.md): the scene, its views and its copy on a CPU device.
double arrayBytes(Numbers n) {
    constexpr double object = 3000, mesh = 5000, triangle = 230, material = 3800, texels = 2.6 * (1 << 20);
    const double objects = std::max(n[0], 1u), materials = std::max(n[3], 1u),
                 meshes = std::min(std::max<double>(n[2], materials), objects);
    return objects * object + meshes * (mesh + n[1] / objects * triangle) + materials * material +
           n[4] * texels;
}

constexpr std::array ROWS{
    Row{"gallery", "sculpture hall in the evening: every kind of material, about 70 lights (the default)",
        builtin::gallery, IMAGE},
    Row{"spheres", "400 spheres, a sun and N point lights: many-light benchmark", nullptr, IMAGE,
        [](Builder& b, Numbers n) { builtin::spheres(b, n[0]); }, sphereParameters,
        [](Numbers n) { return lightBytes * n[0]; }},
    Row{"furnace", "white furnace: white spheres, metallic by roughness, in uniform light", builtin::furnace,
        IMAGE},
    Row{"normals", "normals of every direction under sharp highlights: seams of normal encodings",
        builtin::normals},
    Row{"emission", "emitters from 1e-6 to 1e6 W/(sr m^2), grey and saturated: range of packed HDR formats",
        builtin::emission},
    Row{"dark_albedo", "base colour ramps from 0 to 0.05 and to 1: gamma-encoded albedo",
        builtin::darkAlbedo},
    Row{"dielectrics",
        "ior 1 to 2.4 and 0, specular 0 to 1, tinted: parameters a basic G-buffer does not store",
        builtin::dielectrics},
    Row{"layers",
        "clear coats, anisotropy, sheen and iridescence: every factor and texture, alone and combined",
        builtin::layers},
    Row{"transmission",
        "glass, slabs and leaves before a wall: transmission, volume, dispersion, diffuse transmission",
        builtin::transmission},
    Row{"cutout",
        "masked, normal-mapped, double-sided cards, some at grazing angles: alpha test in every pass",
        builtin::cutout},
    Row{"occlusion", "deep occlusion maps under direct light only, which they must not darken",
        builtin::occlusion},
    Row{"many_materials", "5000 tiles with 5000 materials: material ids beyond the packed bits",
        builtin::manyMaterials},
    Row{"vertex_colors", "varying vertex colours, with and without textures", builtin::vertexColors},
    Row{"unlit_materials",
        "KHR_materials_unlit beside the same lit materials: plain, textured, with vertex colours, "
        "alpha-masked",
        builtin::unlitMaterials},
    Row{"sixteen_bits", "16-bit textures beside 8-bit ones: dark colours, shallow normals, roughness",
        builtin::sixteenBits},
    Row{"lightmaps", "lightmaps on the second UV set, float and 8-bit, beside the same surfaces without",
        builtin::lightmaps},
    Row{"coplanar", "coincident triangles and intersecting bodies: depth ties", builtin::coplanar},
    Row{"deep", "0.2 m to 90 km in the corner of one view with far 1e5: position from depth", builtin::deep},
    Row{"glass", "blended panes, balls and textures, single and in 32 layers, before a wall and the sky",
        builtin::glass},
    Row{"crossed", "intersecting and coplanar blended panes: no draw order is correct", builtin::crossed},
    Row{"mirrored", "normal-mapped reliefs with mirroring transforms", builtin::mirrored},
    Row{"stretched", "non-uniform scales and shears in a node hierarchy", builtin::stretched},
    Row{"far_away", "spheres and a light a million metres from the origin", builtin::farAway},
    Row{"ortho", "an orthographic camera", builtin::ortho},
    Row{"triangle", "one triangle, one light", builtin::triangle},
    Row{"empty", "no meshes and no camera", builtin::empty},
    Row{"background", "a camera that looks past the only mesh: nothing but background", builtin::background},
    Row{"range_edge", "lights whose range ends inside the view: zero light beyond", builtin::rangeEdge},
    Row{"calibration", "charts for calibrate: how another renderer interprets its inputs",
        builtin::calibration},
    Row{"suns", "only directional lights", builtin::suns},
    Row{"points", "only point lights", builtin::points},
    Row{"spots", "only spot lights, cones of 0 to 90 degrees", builtin::spots},
    Row{"areas", "only rectangle, disc and tube lights, which occlude each other and meet the floor",
        builtin::areas},
    Row{"tangents", "normal maps rotated, mirrored and on the second UV set, on planes and columns",
        builtin::tangents},
    Row{"motion", "joints, morph targets, nodes and a light that move from 0 s to 2 s", builtin::motion},
    Row{"unlit", "no lights and no emission, with a camera", builtin::unlit},
    Row{"array", "any number of objects, triangles, meshes, materials and textures: growth of frame time",
        nullptr, TEST,
        [](Builder& b, Numbers n) {
            builtin::array(b, {n[0], n[1], n[2], n[3], n[4]});
        },
        arrayParameters, arrayBytes},
    Row{"covered", "a wall of tiles, N % of them coated, woven, brushed or glass: cost of layers", nullptr,
        TEST,
        [](Builder& b, Numbers n) {
            builtin::covered(b, {n[0], n[1], n[2], n[3]}, n[4]);
        },
        coveredParameters, [](Numbers n) { return lightBytes * n[4]; }},
};

// Joins "lights=N" of each parameter.
std::string namesOf(std::span<const Parameter> parameters, std::string_view joined) {
    std::vector<std::string> names;
    for (const Parameter& parameter : parameters) names.push_back(fmt::format("{}=N", parameter.name));
    return fmt::format("{}", fmt::join(names, joined));
}

// Parses "lights=64", or several separated by &.
std::vector<std::uint32_t> numbersFrom(const std::string& name, const Row& row, std::string_view query) {
    if (row.makeWith == nullptr) fail("builtin:" + name, fmt::format("{} takes no parameters", row.name));
    std::vector<std::uint32_t> numbers;
    for (const Parameter& parameter : row.parameters) numbers.push_back(parameter.default_value);
    std::set<std::string_view> seen;
    while (!query.empty()) {
        const std::string_view one = query.substr(0, query.find('&'));
        query.remove_prefix(std::min(query.size(), one.size() + 1));
        const std::string_view key = one.substr(0, one.find('='));
        const auto known = std::ranges::find(row.parameters, key, &Parameter::name);
        if (known == row.parameters.end() || key.size() == one.size())
            fail("builtin:" + name, fmt::format("unknown parameter '{}'; {} takes {}", one, row.name,
                                                namesOf(row.parameters, ", ")));
        if (!seen.insert(key).second) fail("builtin:" + name, fmt::format("{} is given twice", key));
        const std::string_view digits = one.substr(key.size() + 1);
        std::uint32_t& number = numbers[static_cast<std::size_t>(known - row.parameters.begin())];
        const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
        if (error != std::errc() || end != digits.data() + digits.size() || number > known->max)
            fail("builtin:" + name, fmt::format("'{}' is not a number of {}; it takes 0 to {}", digits,
                                                known->name, known->max));
    }
    return numbers;
}

const Row& rowOf(const std::string& name) {
    const std::string_view base = std::string_view(name).substr(0, name.find('?'));
    const auto row = std::ranges::find(ROWS, base, &Row::name);
    if (row != ROWS.end()) return *row;
    std::vector<std::string> names;
    for (const Row& known : ROWS) names.emplace_back(known.name);
    fail("builtin:" + name,
         fmt::format("no such scene{}; there are {}", didYouMean(base, names), fmt::join(names, ", ")));
}

// The parameters of "array?objects=5", or the defaults; none if the scene has none.
std::vector<std::uint32_t> numbersOf(const std::string& name, const Row& row) {
    const bool has_parameters = row.name.size() < name.size();
    if (has_parameters && row.name.size() + 1 == name.size())
        fail(fmt::format("builtin:{}: a parameter is missing after the ?", name));
    if (!has_parameters && row.makeWith == nullptr) return {};
    return numbersFrom(name, row,
                       std::string_view(name).substr(has_parameters ? row.name.size() + 1 : name.size()));
}

}  // namespace

std::vector<BuiltinName> builtinNames() {
    std::vector<BuiltinName> names;
    for (const Row& row : ROWS) {
        std::vector<std::string> parameters;
        for (const Parameter& parameter : row.parameters)
            parameters.push_back(fmt::format("{}={}", parameter.name, parameter.default_value));
        names.push_back({std::string(row.name), fmt::format("{}", fmt::join(parameters, "&")),
                         std::string(row.shows), row.for_tests});
    }
    return names;
}

std::uint64_t builtinBytes(const std::string& name) {
    const Row& row = rowOf(name);
    return row.bytes ? static_cast<std::uint64_t>(row.bytes(numbersOf(name, row))) : 0;
}

Scene makeBuiltin(const std::string& name) {
    const Row& row = rowOf(name);
    const std::vector<std::uint32_t> numbers = numbersOf(name, row);
    if (row.bytes) checkMemory("builtin:" + name, builtinBytes(name), "smaller numbers need less");
    Builder b;
    if (row.makeWith)
        row.makeWith(b, numbers);
    else
        row.make(b);
    b.scene.name = "builtin:" + name;
    return std::move(b.scene);
}

}  // namespace diptych
