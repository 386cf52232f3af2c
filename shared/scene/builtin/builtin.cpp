// SPDX-License-Identifier: MIT
#include "shared/scene/builtin/builtin.h"

#include "shared/image/free_memory.h"
#include "shared/scene/builtin/scenes.h"
#include "shared/scene/lights/rig.h"
#include "shared/text/did_you_mean.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <set>
#include <span>
#include <stdexcept>
#include <string_view>

namespace diptych {
namespace {

// A number after the name, as in "spheres?lights=64".
struct Parameter {
    std::string_view name;
    std::uint32_t default_value, most;  // default and largest value
};
using Numbers = std::span<const std::uint32_t>;  // one per parameter, in order

struct Row {
    std::string_view name, shows;
    bool for_tests;
    void (*make)(Builder&);
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

constexpr bool PICTURE = false, TEST = true;
constexpr std::array ROWS{
    Row{"gallery", "sculpture hall in the evening: every kind of material, about 70 lights (the default)",
        PICTURE, builtin::gallery},
    Row{"spheres", "400 spheres, a sun and N point lights: many-light benchmark", PICTURE, nullptr,
        [](Builder& b, Numbers n) { builtin::spheres(b, n[0]); }, sphereParameters,
        [](Numbers n) { return lightBytes * n[0]; }},
    Row{"furnace", "white furnace: white spheres, metallic by roughness, in uniform light", PICTURE,
        builtin::furnace},
    Row{"normals", "normals of every direction under sharp highlights: seams of normal encodings", TEST,
        builtin::normals},
    Row{"emission", "emitters from 1e-6 to 1e6 W/(sr m^2), grey and saturated: range of packed HDR formats",
        TEST, builtin::emission},
    Row{"dark_albedo", "base colour ramps from 0 to 0.05 and to 1: gamma-encoded albedo", TEST,
        builtin::darkAlbedo},
    Row{"dielectrics",
        "ior 1 to 2.4 and 0, specular 0 to 1, tinted: parameters a basic G-buffer does not store", TEST,
        builtin::dielectrics},
    Row{"layers",
        "clear coats, anisotropy, sheen and iridescence: every factor and texture, alone and combined", TEST,
        builtin::layers},
    Row{"transmission",
        "glass, slabs and leaves before a wall: transmission, volume, dispersion, diffuse transmission", TEST,
        builtin::transmission},
    Row{"cutout",
        "masked, normal-mapped, double-sided cards, some at grazing angles: alpha test in every pass", TEST,
        builtin::cutout},
    Row{"occlusion", "deep occlusion maps under direct light only, which they must not darken", TEST,
        builtin::occlusion},
    Row{"many_materials", "5000 tiles with 5000 materials: material ids beyond the packed bits", TEST,
        builtin::manyMaterials},
    Row{"vertex_colors", "varying vertex colours, with and without textures", TEST, builtin::vertexColors},
    Row{"unlit_materials",
        "KHR_materials_unlit beside the same lit materials: plain, textured, with vertex colours, "
        "alpha-masked",
        TEST, builtin::unlitMaterials},
    Row{"sixteen_bits", "16-bit textures beside 8-bit ones: dark colours, shallow normals, roughness", TEST,
        builtin::sixteenBits},
    Row{"lightmaps", "lightmaps on the second UV set, float and 8-bit, beside the same surfaces without",
        TEST, builtin::lightmaps},
    Row{"coplanar", "coincident triangles and intersecting bodies: depth ties", TEST, builtin::coplanar},
    Row{"deep", "0.2 m to 90 km in the corner of one view with far 1e5: position from depth", TEST,
        builtin::deep},
    Row{"glass", "blended panes, balls and textures, single and in 32 layers, before a wall and the sky",
        TEST, builtin::glass},
    Row{"crossed", "intersecting and coplanar blended panes: no draw order is correct", TEST,
        builtin::crossed},
    Row{"mirrored", "normal-mapped reliefs with mirroring transforms", TEST, builtin::mirrored},
    Row{"stretched", "non-uniform scales and shears in a node hierarchy", TEST, builtin::stretched},
    Row{"far_away", "spheres and a light a million metres from the origin", TEST, builtin::farAway},
    Row{"ortho", "an orthographic camera", TEST, builtin::ortho},
    Row{"triangle", "one triangle, one light", TEST, builtin::triangle},
    Row{"empty", "no meshes and no camera", TEST, builtin::empty},
    Row{"background", "a camera that looks past the only mesh: nothing but background", TEST,
        builtin::background},
    Row{"range_edge", "lights whose range ends inside the view: zero light beyond", TEST, builtin::rangeEdge},
    Row{"calibration", "charts for calibrate: how another renderer interprets its inputs", TEST,
        builtin::calibration},
    Row{"suns", "only directional lights", TEST, builtin::suns},
    Row{"points", "only point lights", TEST, builtin::points},
    Row{"spots", "only spot lights, cones of 0 to 90 degrees", TEST, builtin::spots},
    Row{"areas", "only rectangle, disc and tube lights, which occlude each other and meet the floor", TEST,
        builtin::areas},
    Row{"tangents", "normal maps rotated, mirrored and on the second UV set, on planes and columns", TEST,
        builtin::tangents},
    Row{"motion", "joints, morph targets, nodes and a light that move from 0 s to 2 s", TEST,
        builtin::motion},
    Row{"unlit", "no lights and no emission, with a camera", TEST, builtin::unlit},
    Row{"array", "any number of objects, triangles, meshes, materials and textures: growth of frame time",
        TEST, nullptr,
        [](Builder& b, Numbers n) {
            builtin::array(b, {n[0], n[1], n[2], n[3], n[4]});
        },
        arrayParameters, arrayBytes},
    Row{"covered", "a wall of tiles, N % of them coated, woven, brushed or glass: cost of layers", TEST,
        nullptr,
        [](Builder& b, Numbers n) {
            builtin::covered(b, {n[0], n[1], n[2], n[3]}, n[4]);
        },
        coveredParameters, [](Numbers n) { return lightBytes * n[4]; }},
};

std::vector<std::string> knownNames() {
    std::vector<std::string> names;
    for (const Row& row : ROWS) names.emplace_back(row.name);
    return names;
}

// Joins "lights=N" of each parameter.
std::string namesOf(std::span<const Parameter> parameters, std::string_view joined) {
    std::vector<std::string> names;
    for (const Parameter& parameter : parameters) names.push_back(fmt::format("{}=N", parameter.name));
    return fmt::format("{}", fmt::join(names, joined));
}

// Parses "lights=64", or several separated by &.
std::vector<std::uint32_t> numbersFrom(const std::string& name, const Row& row, std::string_view query) {
    if (row.makeWith == nullptr)
        throw std::runtime_error(fmt::format("builtin:{}: {} takes no parameters", name, row.name));
    std::vector<std::uint32_t> numbers;
    for (const Parameter& parameter : row.parameters) numbers.push_back(parameter.default_value);
    std::set<std::string_view> given;
    while (!query.empty()) {
        const std::string_view one = query.substr(0, query.find('&'));
        query.remove_prefix(std::min(query.size(), one.size() + 1));
        const std::string_view key = one.substr(0, one.find('='));
        const auto known = std::ranges::find(row.parameters, key, &Parameter::name);
        if (known == row.parameters.end() || key.size() == one.size())
            throw std::runtime_error(fmt::format("builtin:{}: unknown parameter '{}'; {} takes {}", name, one,
                                                 row.name, namesOf(row.parameters, ", ")));
        if (!given.insert(key).second)
            throw std::runtime_error(fmt::format("builtin:{}: {} is given twice", name, key));
        const std::string_view digits = one.substr(key.size() + 1);
        std::uint32_t& number = numbers[static_cast<std::size_t>(known - row.parameters.begin())];
        const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
        if (error != std::errc() || end != digits.data() + digits.size() || number > known->most)
            throw std::runtime_error(fmt::format("builtin:{}: '{}' is not a number of {}; it takes 0 to {}",
                                                 name, digits, known->name, known->most));
    }
    return numbers;
}

const Row& rowOf(const std::string& name) {
    const std::string_view base = std::string_view(name).substr(0, name.find('?'));
    const auto row = std::ranges::find(ROWS, base, &Row::name);
    if (row != ROWS.end()) return *row;
    const std::vector<std::string> names = knownNames();
    throw std::runtime_error(fmt::format("builtin:{}: no such scene{}; there are {}", name,
                                         didYouMean(base, names), fmt::join(names, ", ")));
}

// The parameters of "array?objects=5", or the defaults; none if the scene has none.
std::vector<std::uint32_t> numbersOf(const std::string& name, const Row& row) {
    const bool given = row.name.size() < name.size();
    if (given && row.name.size() + 1 == name.size())
        throw std::runtime_error(fmt::format("builtin:{}: a parameter is missing after the ?", name));
    if (!given && row.makeWith == nullptr) return {};
    return numbersFrom(name, row, std::string_view(name).substr(given ? row.name.size() + 1 : name.size()));
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
