// SPDX-License-Identifier: MIT
// Settings that a benchmark times together, and those it skips, with reasons.
#pragma once

#include "compare/experiment/row.h"
#include "shared/frame/settings.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace diptych::bench {

using experiment::Measure;

// Rows of the benchmark: all modes; both paths with and without transparency, by samples per pixel; both
// paths by an increasing quantity; or both paths and --layers, by the fraction that layered materials cover.
enum class BenchTable { modes, msaa, growth, layers };

// The increasing quantity of --table growth.
enum class GrowthAxis { triangles, draws, instances, textures, lights, pixels };

// A value of the quantity: a count, or MiB of textures.
struct GrowthPoint {
    GrowthAxis axis;
    double value;
};

// A material's layer and the fraction of the image that it covers: --table layers.
struct Cover {
    std::string_view kind;  // parameter of builtin:covered; empty: no layer
    int percent = 0;
    bool operator==(const Cover&) const = default;
};
std::string coverName(const Cover& cover);  // "25 % coated", "no layers"

// Options as given. Comments name the default of an empty list.
struct BenchOptions {
    BenchTable table = BenchTable::modes;
    std::vector<GrowthAxis> axes;              // --table growth; all axes
    std::vector<Path> paths;                   // both paths
    std::vector<Assignment> assign;            // all assignments
    std::vector<Size> sizes;                   // --size
    std::vector<Transparency> transparencies;  // --transparency
    std::vector<Lighting> lightings;           // deferred only; --lighting
    std::vector<std::uint32_t> light_counts;   // ascending; the scene's own lights, or the table's
    double max_ms = 2000;                      // slower frames are not repeated
};

// Reads an option's comma-separated words; no words: keeps the default. Throws std::runtime_error naming the
// option and the word.
void readList(BenchOptions& options, std::string_view option, const std::string& text);
BenchTable benchTableOf(const std::string& word);
std::string_view nameOf(GrowthAxis axis);
std::string growthAxisNames();  // "triangles, draws, ..."

// Parts of a mode's name that are shown because the options vary them.
struct ModeParts {
    std::optional<Transparency> transparency = {};
    std::optional<int> samples = {};        // per pixel
    std::optional<Lighting> lighting = {};  // deferred only
    std::optional<Layers> layers = {};      // deferred only
    bool operator==(const ModeParts&) const = default;
};

// Settings of one scene, timed interleaved, so that a slowdown of the device affects all alike.
struct BenchGroup {
    std::optional<std::uint32_t> lights;  // requested count
    std::string scene;                    // argument of loadScene()
    std::vector<Settings> settings;
    std::optional<GrowthPoint> growth = {};
    std::optional<Cover> cover = {};
};

// Vector registers, per lane, of the pipelines with which a pass shades.
struct PassRegisters {
    std::string pass;
    double min = 0, max = 0;
};

// One Settings. Row::scene includes the light count, Row::warnings are caveats for the reader. `failed` if
// it is skipped; its size is then 0x0 if it is skipped at every size.
struct BenchRow : experiment::Row {
    std::optional<std::uint32_t> requested_lights{};  // skipped: empty for all counts
    ModeParts parts{};
    std::optional<GrowthPoint> growth{};
    std::optional<Cover> cover{};
    std::vector<PassRegisters> registers{};  // --compile-on

    std::string name() const;         // "forward_plus, clustered, list, 4 samples"
    std::string assignLabel() const;  // without the path; with a star if it draws another image
    std::string label() const;        // name() with the star
    std::string point() const;        // "1e+06 triangles", "5 % coated"; empty: --table modes or msaa
    std::string lightsText() const;
};

struct BenchCases {
    std::vector<BenchGroup> groups;  // by light count
    std::vector<BenchRow> skips;
};

// Light counts apply to a built-in scene that takes ?lights=N, to {} in --lights, or else to a seeded rig
// of point lights. Throws std::runtime_error if other lights are given as well, and if nothing is left to
// time. BenchTable::growth ignores `scene` and uses builtin:array and builtin:spheres, BenchTable::layers
// builtin:covered. BenchTable::msaa: each path with and without transparency, at 1, 4 and 8 samples per
// pixel, with one assignment.
BenchCases makeBenchCases(const std::string& scene, const Settings& requested, const BenchOptions& options);

// Predicted frame time with `lights`, ms: linear through the last two of (lights, ms), never less than the
// last. `measured` ascends. Empty with fewer than two points.
std::optional<double> predictedMs(std::span<const std::pair<std::uint32_t, double>> measured,
                                  std::uint32_t lights);

std::string modeName(const Settings& settings, const ModeParts& parts);
// Parts of the Settings that the options vary.
ModeParts partsOf(const BenchOptions& options, const Settings& settings);
// Whether the assignment evaluates only some lights per pixel, so that its image differs.
bool drawsAnotherImage(Assignment assign);
// "forward_plus, every, 640x360, 1024 lights"
std::string skipName(const BenchRow& skip);

}  // namespace diptych::bench
