// SPDX-License-Identifier: MIT
#include "compare/external/renderer_file.h"

#include "shared/frame/setting_values.h"
#include "shared/image/file_bytes.h"
#include "shared/scene/lights/json_fields.h"
#include "shared/text/fail.h"
#include "shared/text/json.h"
#include "shared/text/named.h"
#include "shared/text/one_line.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

namespace diptych::external {
namespace {

constexpr std::pair<std::string_view, Transfer> transfers[] = {{"linear", Transfer::linear},
                                                               {"srgb", Transfer::srgb}};
constexpr std::pair<std::string_view, Primaries> primaries_names[] = {
    {"rec709", Primaries::rec709}, {"display_p3", Primaries::display_p3}, {"rec2020", Primaries::rec2020}};

template <class E, std::size_t N>
std::string_view wordOf(const std::pair<std::string_view, E> (&names)[N], E value) {
    for (const auto& [name, candidate] : names)
        if (candidate == value) return name;
    return "?";
}

// Input corrections: numbers and flags.
struct NumberCorrection {
    std::string_view name;
    double InputCorrections::*value;
    double neutral, min, max;
    std::string_view text;  // {}: the number
};
constexpr double largest_factor = 1e6;
constexpr NumberCorrection numbers[] = {
    {"point_factor", &InputCorrections::point_factor, 1, 0, largest_factor,
     "it receives point lights {} times as bright"},
    {"spot_factor", &InputCorrections::spot_factor, 1, 0, largest_factor,
     "it receives spot lights {} times as bright"},
    {"directional_factor", &InputCorrections::directional_factor, 1, 0, largest_factor,
     "it receives directional lights {} times as bright"},
    {"area_factor", &InputCorrections::area_factor, 1, 0, largest_factor,
     "it receives area lights {} times as bright"},
    {"environment_factor", &InputCorrections::environment_factor, 1, 0, largest_factor,
     "it receives an environment {} times as bright"},
    {"environment_rotation", &InputCorrections::environment_rotation, 0, -360, 360,
     "it receives an environment rotated by {} degrees more"},
    {"fov_offset", &InputCorrections::fov_offset, 0, -90, 90, "it receives a field of view {} degrees wider"},
    {"shift_x", &InputCorrections::shift_x, 0, -1e3, 1e3, "it receives a projection {} pixels further right"},
    {"shift_y", &InputCorrections::shift_y, 0, -1e3, 1e3, "it receives a projection {} pixels further down"}};

struct FlagCorrection {
    std::string_view name;
    bool InputCorrections::*value;
    std::string_view text;
};
constexpr FlagCorrection flags[] = {
    {"environment_mirrored", &InputCorrections::environment_mirrored,
     "it receives the environment mirrored, left for right"},
    {"upside_down", &InputCorrections::upside_down, "its picture is read from the bottom up"},
    {"mirrored", &InputCorrections::mirrored, "its picture is read from right to left"}};

constexpr std::string_view light_factor = "light_factor";  // for all light types

template <class E, std::size_t N>
E oneOf(const JsonFields& fields, std::string_view key, const std::pair<std::string_view, E> (&names)[N]) {
    const std::string word = fields.text(key, std::string(names[0].first));
    std::vector<std::string_view> all;
    for (const auto& [name, value] : names) {
        if (name == word) return value;
        all.push_back(name);
    }
    fields.fail(key, fmt::format("\"{}\" is not one of {}", oneLine(word), fmt::join(all, ", ")));
}

InputCorrections correctionsIn(const nlohmann::json& object, const std::string& who) {
    const JsonFields fields(object, who);
    fields.knownOnly(correctionNames(), "granted");
    InputCorrections corrections;
    const double all = fields.number(light_factor, 1, 0, largest_factor);
    for (const NumberCorrection& row : numbers) {
        const bool ofLights = row.name.ends_with("_factor") && row.name != "environment_factor";
        corrections.*row.value = fields.number(row.name, ofLights ? all : row.neutral, row.min, row.max);
    }
    for (const FlagCorrection& row : flags) corrections.*row.value = fields.flag(row.name, false);
    corrections.transfer = oneOf(fields, "transfer", transfers);
    corrections.primaries = oneOf(fields, "primaries", primaries_names);
    return corrections;
}

std::vector<std::string> commandIn(const JsonFields& fields) {
    const nlohmann::json* command = fields.find("command");
    std::vector<std::string> arguments;
    bool sound = command && command->is_array() && !command->empty();
    for (std::size_t i = 0; sound && i < command->size(); ++i) {
        sound = command->at(i).is_string();
        if (sound) arguments.push_back(command->at(i).get<std::string>());
        sound = sound && arguments.back().find('\0') == std::string::npos;
    }
    if (!sound || arguments.front().empty())
        fields.fail(
            "command",
            "must be the program and its arguments, e.g. [\"node\", \"three.mjs\"]; no shell is used");
    return arguments;
}

void checkName(const std::string& name, const std::string& argument) {
    const auto fits = [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' ||
               c == '_' || c == '.';
    };
    if (name.empty() || name.size() > 64 || name.front() == '.' || !std::ranges::all_of(name, fits))
        fail("--renderer " + oneLine(argument),
             "its name may have up to 64 letters, digits, \"-\", \"_\" and dots, e.g. three=three.json");
    for (const auto& [path, taken] : enumNames<Path>())
        if (name == taken)
            fail("--renderer " + oneLine(argument),
                 fmt::format("{} is the name of a path of diptych; choose another", name));
    if (name == "baseline")
        fail("--renderer " + oneLine(argument),
             "this name is reserved for the file of --baseline; choose another");
}

}  // namespace

std::vector<std::string> describe(const InputCorrections& corrections) {
    std::vector<std::string> lines;
    const auto& g = corrections;
    const bool alike = g.point_factor == g.spot_factor && g.point_factor == g.directional_factor &&
                       g.point_factor == g.area_factor;
    if (alike && g.point_factor != 1)
        lines.push_back(
            fmt::format("{0} {1}: it receives all lights {1} times as bright", light_factor, g.point_factor));
    for (const NumberCorrection& row : numbers) {
        const bool ofLights = row.name.ends_with("_factor") && row.name != "environment_factor";
        if (corrections.*row.value != row.neutral && !(alike && ofLights))
            lines.push_back(fmt::format("{} {}: {}", row.name, corrections.*row.value,
                                        fmt::format(fmt::runtime(row.text), corrections.*row.value)));
    }
    for (const FlagCorrection& row : flags)
        if (corrections.*row.value) lines.push_back(fmt::format("{}: {}", row.name, row.text));
    if (corrections.transfer != Transfer::linear)
        lines.push_back(fmt::format("transfer {}: its pixels are decoded from this curve",
                                    wordOf(transfers, corrections.transfer)));
    if (corrections.primaries != Primaries::rec709)
        lines.push_back(fmt::format("primaries {}: its pixels are converted from these",
                                    wordOf(primaries_names, corrections.primaries)));
    return lines;
}

std::vector<std::string_view> correctionNames() {
    std::vector<std::string_view> names{light_factor};
    for (const NumberCorrection& row : numbers) names.push_back(row.name);
    for (const FlagCorrection& row : flags) names.push_back(row.name);
    names.insert(names.end(), {"transfer", "primaries"});
    return names;
}

ExternalRenderer readRendererFile(const std::filesystem::path& file) {
    const std::vector<unsigned char> bytes = bytesOf(file);
    return named(oneLine(file.string()), [&] {
        const nlohmann::json json = parseJson({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
        const JsonFields fields(json, "the renderer");
        constexpr std::array<std::string_view, 6> known{"$schema", "schema", "command",
                                                        "timeout", "scene",  "granted"};
        fields.knownOnly(known, "a renderer");
        if (fields.number("schema", 1, 0, 1e6) != 1)
            fields.fail("schema", "must be 1, the only version that this diptych reads");
        ExternalRenderer renderer;
        renderer.file = file;
        renderer.folder = std::filesystem::absolute(file).parent_path();
        renderer.name = file.stem().string();
        renderer.command = commandIn(fields);
        renderer.timeout = fields.number("timeout", renderer.timeout, 0, 86400);
        if (!(renderer.timeout > 0)) fields.fail("timeout", "must be above 0 s");
        constexpr std::pair<std::string_view, bool> scenes[] = {{"file", false}, {"copy", true}};
        renderer.posed = oneOf(fields, "scene", scenes);
        if (const nlohmann::json* corrections = fields.find("granted"))
            renderer.corrections = correctionsIn(*corrections, "granted");
        return renderer;
    });
}

ExternalRenderer readRenderer(const std::string& argument) {
    const std::size_t at = argument.find('=');
    if (at == std::string::npos || at + 1 == argument.size())
        fail("--renderer " + oneLine(argument), "give NAME=FILE.json, e.g. three=three.json");
    const std::string name = argument.substr(0, at);
    checkName(name, argument);
    ExternalRenderer renderer = readRendererFile(argument.substr(at + 1));
    renderer.name = name;
    return renderer;
}

}  // namespace diptych::external
