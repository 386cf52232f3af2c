// SPDX-License-Identifier: MIT
#include "shared/scene/builtin/builtin.h"

#include "shared/scene/builtin/scenes.h"
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

// A number that may follow the name: "spheres?lights=64".
struct Parameter {
    std::string_view name;
    std::uint32_t usual, most;  // where none is given, and the largest that is taken
};
using Numbers = std::span<const std::uint32_t>;  // of the parameters, in their order

struct Row {
    std::string_view name, shows;
    bool for_tests;
    Scene (*make)();
    Scene (*makeWith)(Numbers) = nullptr;
    std::span<const Parameter> parameters = {};
};

constexpr std::array sphereParameters{Parameter{"lights", 256, 0x7fffffffu}};
// Their product stays within what indices of 32 bits reach.
constexpr std::array arrayParameters{
    Parameter{"objects", 100, 10'000'000}, Parameter{"triangles", 20'000, 1'000'000'000},
    Parameter{"meshes", 1, 10'000'000}, Parameter{"materials", 4, 10'000'000},
    Parameter{"texture_mib", 0, 65'536}};

constexpr bool PICTURE = false, TEST = true;
constexpr std::array ROWS{
    Row{"gallery",
        "an evening in a sculpture hall: every kind of material, some seventy lights (the default)", PICTURE,
        builtin::gallery},
    Row{"spheres", "400 spheres under a sun and N point lights, the many-light benchmark", PICTURE, nullptr,
        [](Numbers n) { return builtin::spheres(n[0]); }, sphereParameters},
    Row{"furnace", "white spheres, metallic by roughness, in light that is the same from everywhere", PICTURE,
        builtin::furnace},
    Row{"normals", "every direction of normal under sharp highlights: seams of normal encodings", TEST,
        builtin::normals},
    Row{"emission", "emitters from 1e-6 to 1e6 W/(sr m^2), grey and saturated: packed HDR ranges", TEST,
        builtin::emission},
    Row{"dark_albedo", "ramps of base colour from 0 to 0.05 and to 1: albedo packed with a gamma", TEST,
        builtin::darkAlbedo},
    Row{"dielectrics", "ior 1 to 2.4 and 0, specular 0 to 1, tinted: what a plain G-buffer lacks", TEST,
        builtin::dielectrics},
    Row{"cutout", "masked, normal-mapped, double-sided cards, some at grazing angles: alpha tests per pass",
        TEST, builtin::cutout},
    Row{"occlusion", "deep occlusion maps under direct light alone, which they must not touch", TEST,
        builtin::occlusion},
    Row{"many_materials", "5000 tiles of 5000 materials: ids beyond the packed bits", TEST,
        builtin::manyMaterials},
    Row{"vertex_colors", "vertex colours that vary, textured and plain", TEST, builtin::vertexColors},
    Row{"unlit_materials",
        "KHR_materials_unlit beside the same materials lit: plain, textured, painted, cut out", TEST,
        builtin::unlitMaterials},
    Row{"sixteen_bits", "textures of 16 bits beside the same in 8: dark colours, shallow normals, roughness",
        TEST, builtin::sixteenBits},
    Row{"lightmaps", "baked light on the second UV set, of floats and of 8 bits, beside the same without",
        TEST, builtin::lightmaps},
    Row{"coplanar", "coincident triangles and bodies that pass through each other: depth ties", TEST,
        builtin::coplanar},
    Row{"deep", "0.2 m to 90 km in one view with far 1e5, seen through its corner: position from depth", TEST,
        builtin::deep},
    Row{"glass", "panes, balls and textures that blend, alone and in 32 layers, against a wall and the sky",
        TEST, builtin::glass},
    Row{"crossed", "blended panes through each other and in one plane: no order of draws is right", TEST,
        builtin::crossed},
    Row{"mirrored", "normal-mapped reliefs under mirroring transforms", TEST, builtin::mirrored},
    Row{"stretched", "non-uniform scales and shears in a tree of nodes", TEST, builtin::stretched},
    Row{"far_away", "spheres and a light a million metres from the origin", TEST, builtin::farAway},
    Row{"ortho", "an orthographic camera", TEST, builtin::ortho},
    Row{"triangle", "one triangle, one light", TEST, builtin::triangle},
    Row{"empty", "no meshes at all, and no camera", TEST, builtin::empty},
    Row{"background", "a camera that looks past the only mesh: nothing but background", TEST,
        builtin::background},
    Row{"range_edge", "lights whose range ends inside the view: falloff must be zero there", TEST,
        builtin::rangeEdge},
    Row{"calibration", "charts that tell how a renderer of others means what it is told", TEST,
        builtin::calibration},
    Row{"suns", "directional lights alone", TEST, builtin::suns},
    Row{"points", "point lights alone", TEST, builtin::points},
    Row{"spots", "spot lights alone, cones of 0 to 90 degrees", TEST, builtin::spots},
    Row{"areas", "rectangles, discs and tubes alone, in each other's way and the floor's", TEST,
        builtin::areas},
    Row{"tangents", "normal maps read turned, mirrored and from the second UV set, on planes and columns",
        TEST, builtin::tangents},
    Row{"motion", "joints, morph targets, nodes and a lamp that move from 0 s to 2 s", TEST, builtin::motion},
    Row{"unlit", "no lights and nothing that emits, with a camera", TEST, builtin::unlit},
    Row{"array", "any number of objects, triangles, meshes, materials and textures: how a frame grows", TEST,
        nullptr,
        [](Numbers n) {
            return builtin::array({n[0], n[1], n[2], n[3], n[4]});
        },
        arrayParameters},
};

std::vector<std::string> knownNames() {
    std::vector<std::string> names;
    for (const Row& row : ROWS) names.emplace_back(row.name);
    return names;
}

// "lights=N" of each, joined.
std::string namesOf(std::span<const Parameter> parameters, std::string_view joined) {
    std::vector<std::string> names;
    for (const Parameter& parameter : parameters) names.push_back(fmt::format("{}=N", parameter.name));
    return fmt::format("{}", fmt::join(names, joined));
}

// Parses "lights=64", or several with & between them.
std::vector<std::uint32_t> numbersFrom(const std::string& name, const Row& row, std::string_view query) {
    if (row.makeWith == nullptr)
        throw std::runtime_error(fmt::format("builtin:{}: {} takes no parameters", name, row.name));
    std::vector<std::uint32_t> numbers;
    for (const Parameter& parameter : row.parameters) numbers.push_back(parameter.usual);
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
            throw std::runtime_error(fmt::format("builtin:{}: '{}' is no number of {}; it takes 0 to {}",
                                                 name, digits, known->name, known->most));
    }
    return numbers;
}

}  // namespace

std::vector<BuiltinName> builtinNames() {
    std::vector<BuiltinName> names;
    for (const Row& row : ROWS) {
        std::vector<std::string> parameters;
        for (const Parameter& parameter : row.parameters)
            parameters.push_back(fmt::format("{}={}", parameter.name, parameter.usual));
        names.push_back({std::string(row.name), fmt::format("{}", fmt::join(parameters, "&")),
                         std::string(row.shows), row.for_tests});
    }
    return names;
}

Scene makeBuiltin(const std::string& name) {
    const std::string_view base = std::string_view(name).substr(0, name.find('?'));
    for (const Row& row : ROWS) {
        if (row.name != base) continue;
        const bool given = base.size() < name.size();
        if (given && base.size() + 1 == name.size())
            throw std::runtime_error(fmt::format("builtin:{}: nothing follows the ?", name));
        const auto query = std::string_view(name).substr(given ? base.size() + 1 : name.size());
        const bool takes = given || row.makeWith != nullptr;
        Scene scene = takes ? row.makeWith(numbersFrom(name, row, query)) : row.make();
        scene.name = "builtin:" + name;
        return scene;
    }
    const std::vector<std::string> names = knownNames();
    throw std::runtime_error(fmt::format("builtin:{}: there is no such scene{}; there are {}", name,
                                         didYouMean(base, names), fmt::join(names, ", ")));
}

}  // namespace diptych
