// SPDX-License-Identifier: MIT
#include "compare/bench/cases.h"

#include "shared/scene/builtin/builtin.h"

#include "compare/render/sample_counts.h"
#include "shared/text/counted.h"
#include "shared/text/joined_names.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <stdexcept>
#include <string_view>

namespace diptych::bench {
namespace {

std::vector<std::string> wordsOf(const std::string& list, std::string_view option) {
    std::vector<std::string> words;
    for (std::size_t begin = 0; begin <= list.size();) {
        const std::size_t end = std::min(list.find(',', begin), list.size());
        words.push_back(list.substr(begin, end - begin));
        if (words.back().empty())
            throw std::runtime_error(fmt::format("{} '{}': an empty value between commas", option, list));
        begin = end + 1;
    }
    return words;
}

// Distinct values of one Setting, in the given order.
template <class T>
std::vector<T> valuesOf(const std::string& list, std::string_view option, std::string_view setting,
                        T Settings::*member) {
    std::vector<T> values;
    for (const std::string& word : wordsOf(list, option)) {
        Settings settings;
        try {
            settings.set(setting, word);
        } catch (const std::runtime_error&) {
            throw std::runtime_error(
                fmt::format("{} {}: takes {}, separated by commas", option, word, acceptedValues(setting)));
        }
        if (std::ranges::find(values, settings.*member) == values.end()) values.push_back(settings.*member);
    }
    return values;
}

template <class T>
std::vector<T> all() {
    std::vector<T> values;
    for (const auto& [value, name] : enumNames<T>()) values.push_back(value);
    return values;
}

constexpr std::string_view prefix = "builtin:";

// "builtin:spheres?lights=64" becomes "builtin:spheres". Empty if the scene has no such parameter.
std::string sceneOfLights(const std::string& scene) {
    if (!scene.starts_with(prefix)) return {};
    const std::string name = scene.substr(prefix.size(), scene.find('?') - prefix.size());
    const std::vector<BuiltinName> names = builtinNames();
    const auto builtin = std::ranges::find(names, name, &BuiltinName::name);
    if (builtin == names.end() || !builtin->parameter.starts_with("lights=")) return {};
    return std::string(prefix) + name;
}

// Sets the light count in the scene's name or in the Settings.
void putLights(std::uint32_t count, std::string& scene, Settings& settings) {
    const std::string parametric = sceneOfLights(scene);
    if (!parametric.empty() && settings.lights.empty()) {
        scene = fmt::format("{}?lights={}", parametric, count);
        return;
    }
    if (const std::size_t braces = settings.lights.find("{}"); braces != std::string::npos)
        settings.lights.replace(braces, 2, fmt::format("{}", count));
    else if (settings.lights.empty())
        settings.lights = count > 0 ? fmt::format("point:{}", count) : "";
    else
        throw std::runtime_error(
            fmt::format("--lights {}: --light-counts sets the number; leave one out, or write {{}} in place "
                        "of the number",
                        settings.lights));
}

// Distinct, ascending.
std::vector<std::uint32_t> lightCounts(const std::string& words, std::string_view option) {
    std::vector<std::uint32_t> counts;
    for (const std::string& word : wordsOf(words, option)) {
        std::uint32_t count = 0;
        const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), count);
        if (error != std::errc() || end != word.data() + word.size() || count > 0x7fffffffu)
            throw std::runtime_error(
                fmt::format("{} {}: whole numbers from 0 to 2147483647, separated by commas", option, word));
        counts.push_back(count);
    }
    std::ranges::sort(counts);
    counts.erase(std::ranges::unique(counts).begin(), counts.end());
    return counts;
}

// Scene of one step of an axis. Only the pixel axis changes the size. All but the light axis use
// builtin:array, whose objects fill the view at any count.
struct GrowthRow {
    GrowthAxis axis;
    std::string_view name;
    std::vector<double> values;
    std::string (*scene)(std::uint64_t value);
};
const GrowthRow growthRows[] = {
    {GrowthAxis::triangles,
     "triangles",
     {1e4, 3e4, 1e5, 3e5, 1e6, 3e6, 1e7},
     [](std::uint64_t n) { return fmt::format("builtin:array?meshes=100&triangles={}", n); }},
    {GrowthAxis::draws,
     "draws",
     {10, 100, 1000, 1e4, 1e5},
     [](std::uint64_t n) {
         return fmt::format("builtin:array?objects={0}&materials={0}&triangles={1}", n, 2 * n);
     }},
    {GrowthAxis::instances,
     "instances",
     {10, 100, 1000, 1e4, 1e5, 1e6},
     [](std::uint64_t n) {
         return fmt::format("builtin:array?objects={}&materials=1&triangles={}", n, 2 * n);
     }},
    {GrowthAxis::textures,
     "textures",
     {4, 16, 64, 256, 1024, 4096},
     [](std::uint64_t n) {
         return fmt::format("builtin:array?objects={}&texture_mib={}", std::max<std::uint64_t>(n / 4, 1), n);
     }},
    {GrowthAxis::lights,
     "lights",
     {16, 64, 256, 1024, 4096, 16384, 65536},
     [](std::uint64_t n) { return fmt::format("builtin:spheres?lights={}", n); }},
    {GrowthAxis::pixels,
     "pixels",
     {320 * 180, 640 * 360, 1280 * 720, 2560 * 1440, 5312 * 2988},
     [](std::uint64_t) { return std::string("builtin:array"); }},
};

// 16:9 aspect ratio.
Size sizeOfPixels(double pixels) {
    const int height = static_cast<int>(std::lround(std::sqrt(pixels * 9 / 16)));
    return {static_cast<int>(std::lround(pixels / height)), height};
}

std::vector<GrowthAxis> growthAxes(const std::string& words, std::string_view option) {
    std::vector<GrowthAxis> axes;
    for (const std::string& word : wordsOf(words, option)) {
        const auto row = std::ranges::find(growthRows, word, &GrowthRow::name);
        if (row == std::end(growthRows))
            throw std::runtime_error(
                fmt::format("{} {}: takes {}, separated by commas", option, word, growthAxisNames()));
        if (std::ranges::find(axes, row->axis) == axes.end()) axes.push_back(row->axis);
    }
    return axes;
}

// Columns of --table msaa. checkSampleTable() throws for options that conflict with its rows.
constexpr int tableSamples[] = {1, 4, 8};
void checkSampleTable(const BenchOptions& options) {
    if (options.table != BenchTable::msaa) return;
    if (options.assign.size() > 1)
        throw std::runtime_error("--table msaa: takes one --assign; run it once for each");
    if (!options.transparencies.empty())
        throw std::runtime_error(
            "--transparencies: --table msaa has rows with and without --transparency already; leave it out");
    if (!options.lightings.empty())
        throw std::runtime_error("--lightings: --table msaa takes one --lighting; run it once for each");
}

std::vector<Assignment> assignmentsOf(const Settings& requested, const BenchOptions& options) {
    if (!options.assign.empty()) return options.assign;
    return options.table == BenchTable::msaa ? std::vector{requested.assign} : all<Assignment>();
}

std::vector<Transparency> transparenciesOf(const Settings& requested, const BenchOptions& options) {
    if (options.table == BenchTable::msaa && requested.transparency != Transparency::off)
        return {Transparency::off, requested.transparency};
    return options.transparencies.empty() ? std::vector{requested.transparency} : options.transparencies;
}

// Only deferred has several lighting modes.
std::vector<Lighting> lightingsOf(Path path, const Settings& requested, const BenchOptions& options) {
    return hasGBuffer(path) && !options.lightings.empty() ? options.lightings
                                                          : std::vector{requested.lighting};
}

std::vector<Settings> bySamples(const Settings& settings, const BenchOptions& options) {
    if (options.table != BenchTable::msaa) return {settings};
    std::vector<Settings> columns;
    for (const int samples : tableSamples) columns.push_back(withSamples(settings, samples));
    return columns;
}

std::vector<Path> pathsOf(const BenchOptions& options) {
    return options.paths.empty() ? std::vector(drawn_paths.begin(), drawn_paths.end()) : options.paths;
}

// Throws if options name several values of a Setting: the table takes one.
void refuseLists(std::string_view table, const BenchOptions& options) {
    if (options.assign.size() > 1)
        throw std::runtime_error(fmt::format("--table {}: takes one --assign; run it once for each", table));
    if (!options.sizes.empty() || !options.transparencies.empty() || !options.lightings.empty())
        throw std::runtime_error(fmt::format(
            "--table {}: takes no --sizes, --transparencies or --lightings; run it once for each", table));
}

// Throws if they cannot be drawn.
Settings tableSettings(const Settings& requested, const BenchOptions& options, Path path) {
    Settings settings = requested;
    settings.path = path;
    if (!options.assign.empty()) settings.assign = options.assign.front();
    if (const auto problem = settings.problem()) throw std::runtime_error(*problem);
    return settings;
}

BenchCases growthCases(const Settings& requested, const BenchOptions& options) {
    refuseLists("growth", options);
    if (!options.light_counts.empty())
        throw std::runtime_error("--table growth: takes no --light-counts: lights are an axis");
    BenchCases cases;
    for (const GrowthRow& row : growthRows) {
        if (!options.axes.empty() && std::ranges::count(options.axes, row.axis) == 0) continue;
        for (const double value : row.values) {
            BenchGroup group{
                std::nullopt, row.scene(static_cast<std::uint64_t>(value)), {}, GrowthPoint{row.axis, value}};
            for (const Path path : pathsOf(options)) {
                Settings settings = tableSettings(requested, options, path);
                if (row.axis == GrowthAxis::pixels) settings.size = sizeOfPixels(value);
                group.settings.push_back(settings);
            }
            cases.groups.push_back(std::move(group));
        }
    }
    return cases;
}

// No layers, then each kind by the fraction that it covers.
std::vector<Cover> tableCovers() {
    std::vector<Cover> covers{Cover()};
    for (const std::string_view kind : {"coated", "woven", "brushed", "glass"})
        for (const int percent : {5, 25, 100}) covers.push_back({kind, percent});
    return covers;
}

BenchCases layerCases(const Settings& requested, const BenchOptions& options) {
    refuseLists("layers", options);
    const std::vector<std::uint32_t> counts =
        options.light_counts.empty() ? std::vector<std::uint32_t>{1, 64, 1024} : options.light_counts;
    BenchCases cases;
    for (const Cover& cover : tableCovers())
        for (const std::uint32_t lights : counts) {
            const std::string fraction =
                cover.kind.empty() ? "" : fmt::format("{}={}&", cover.kind, cover.percent);
            BenchGroup group{
                lights, fmt::format("builtin:covered?{}lights={}", fraction, lights), {}, {}, cover};
            for (const Path path : pathsOf(options)) {
                Settings settings = tableSettings(requested, options, path);
                for (const Layers layers : hasGBuffer(path) ? all<Layers>() : std::vector{requested.layers}) {
                    settings.layers = layers;
                    group.settings.push_back(settings);
                }
            }
            cases.groups.push_back(std::move(group));
        }
    return cases;
}

std::string ending(const ModeParts& parts) {
    std::string words;
    if (parts.transparency) words += fmt::format(", {}", nameOf(*parts.transparency));
    if (parts.lighting) words += fmt::format(", {}", nameOf(*parts.lighting));
    if (parts.layers) words += fmt::format(", layers {}", nameOf(*parts.layers));
    if (parts.samples) words += ", " + counted(static_cast<std::uint64_t>(*parts.samples), "sample");
    return words;
}

}  // namespace

void readList(BenchOptions& options, std::string_view option, const std::string& words) {
    if (words.empty()) return;
    if (option == "--axes") options.axes = growthAxes(words, option);
    if (option == "--paths") options.paths = valuesOf(words, option, "path", &Settings::path);
    if (std::ranges::count(options.paths, Path::reference) > 0)
        throw std::runtime_error("--paths reference: bench does not time it; use deferred, forward_plus");
    if (option == "--assign") options.assign = valuesOf(words, option, "assign", &Settings::assign);
    if (option == "--sizes") options.sizes = valuesOf(words, option, "size", &Settings::size);
    if (option == "--transparencies")
        options.transparencies = valuesOf(words, option, "transparency", &Settings::transparency);
    if (option == "--lightings") options.lightings = valuesOf(words, option, "lighting", &Settings::lighting);
    if (option == "--light-counts") options.light_counts = lightCounts(words, option);
}

BenchTable benchTableOf(const std::string& word) {
    if (word == "modes") return BenchTable::modes;
    if (word == "msaa") return BenchTable::msaa;
    if (word == "growth") return BenchTable::growth;
    if (word == "layers") return BenchTable::layers;
    throw std::runtime_error(fmt::format("--table {}: takes modes, msaa, growth or layers", word));
}

std::string_view nameOf(GrowthAxis axis) {
    return std::ranges::find(growthRows, axis, &GrowthRow::axis)->name;
}

std::string growthAxisNames() {
    return joinedNames(growthRows);
}

BenchCases makeBenchCases(const std::string& scene, const Settings& requested, const BenchOptions& options) {
    if (options.table == BenchTable::growth) return growthCases(requested, options);
    if (!options.axes.empty()) throw std::runtime_error("--axes: needs --table growth");
    if (options.table == BenchTable::layers) return layerCases(requested, options);
    checkSampleTable(options);
    const std::vector<Path> paths = pathsOf(options);
    const std::vector<Assignment> assignments = assignmentsOf(requested, options);
    const std::vector<Size> sizes = options.sizes.empty() ? std::vector{requested.size} : options.sizes;
    const std::vector<Transparency> transparencies = transparenciesOf(requested, options);
    std::vector<std::optional<std::uint32_t>> counts(options.light_counts.begin(),
                                                     options.light_counts.end());
    if (counts.empty()) counts.emplace_back();

    BenchCases cases;
    const auto skip = [&](Settings settings, const std::string& reason) {
        const auto same = [&](const BenchRow& s) {
            return s.settings.path == settings.path && s.settings.assign == settings.assign &&
                   s.failed == reason;
        };
        if (std::ranges::any_of(cases.skips, same)) return;
        settings.size = {0, 0};
        cases.skips.push_back({{.scene = scene, .settings = settings, .failed = reason}});
    };
    for (const std::optional<std::uint32_t>& count : counts) {
        BenchGroup group{count, scene, {}};
        Settings lit = requested;
        if (count) putLights(*count, group.scene, lit);
        for (const Size& size : sizes)
            for (const Assignment assign : assignments)
                for (const Path path : paths)
                    for (const Transparency transparency : transparencies)
                        for (const Lighting lighting : lightingsOf(path, lit, options)) {
                            Settings settings = lit;
                            settings.path = path;
                            settings.assign = assign;
                            settings.size = size;
                            settings.transparency = transparency;
                            settings.lighting = lighting;
                            for (const Settings& sampled : bySamples(settings, options))
                                if (const auto problem = sampled.problem())
                                    skip(sampled, *problem);
                                else
                                    group.settings.push_back(sampled);
                        }
        if (!group.settings.empty()) cases.groups.push_back(std::move(group));
    }
    if (cases.groups.empty())
        throw std::runtime_error(fmt::format("nothing to time: {}: {}", skipName(cases.skips.front()),
                                             cases.skips.front().failed));
    return cases;
}

std::optional<double> predictedMs(std::span<const std::pair<std::uint32_t, double>> measured,
                                  std::uint32_t lights) {
    if (measured.size() < 2) return std::nullopt;
    const auto& [n0, ms0] = measured[measured.size() - 2];
    const auto& [n1, ms1] = measured[measured.size() - 1];
    const double slope = std::max(0.0, (ms1 - ms0) / (static_cast<double>(n1) - static_cast<double>(n0)));
    return ms1 + slope * (static_cast<double>(lights) - static_cast<double>(n1));
}

ModeParts partsOf(const BenchOptions& options, const Settings& settings) {
    const bool by_samples = options.table == BenchTable::msaa;
    ModeParts parts;
    if (by_samples || options.transparencies.size() > 1) parts.transparency = settings.transparency;
    if (by_samples) parts.samples = settings.msaa;
    if (options.lightings.size() > 1 && hasGBuffer(settings.path)) parts.lighting = settings.lighting;
    if (options.table == BenchTable::layers && hasGBuffer(settings.path)) parts.layers = settings.layers;
    return parts;
}

std::string modeName(const Settings& settings, const ModeParts& parts) {
    return fmt::format("{}, {}{}", nameOf(settings.path), nameOf(settings.assign), ending(parts));
}

bool drawsAnotherImage(Assignment assign) {
    return assign == Assignment::per_object;
}

std::string BenchRow::name() const {
    return modeName(settings, parts);
}

std::string BenchRow::assignLabel() const {
    return fmt::format("{}{}{}", nameOf(settings.assign), drawsAnotherImage(settings.assign) ? " *" : "",
                       ending(parts));
}

std::string BenchRow::label() const {
    return fmt::format("{}, {}", nameOf(settings.path), assignLabel());
}

std::string BenchRow::point() const {
    if (cover) return coverName(*cover);
    return growth ? fmt::format("{:.6g} {}", growth->value, nameOf(growth->axis)) : "";
}

std::string BenchRow::lightsText() const {
    return counted(whole(Measure::lights), "light");
}

std::string skipName(const BenchRow& skip) {
    std::string name = skip.name();
    const Size& size = skip.settings.size;
    if (size.width > 0) name += fmt::format(", {}x{}", size.width, size.height);
    if (skip.requested_lights) name += ", " + counted(*skip.requested_lights, "light");
    if (skip.growth || skip.cover) name += ", " + skip.point();
    return name;
}

std::string coverName(const Cover& cover) {
    return cover.kind.empty() ? "no layers" : fmt::format("{} % {}", cover.percent, cover.kind);
}

}  // namespace diptych::bench
