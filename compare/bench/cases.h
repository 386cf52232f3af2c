// SPDX-License-Identifier: MIT
// Which Settings a benchmark times side by side, which it skips, and why.
#pragma once

#include "shared/frame/settings.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace diptych::bench {

// What the rows are: every mode; the paths with and without blended surfaces by samples a pixel; or the paths
// by how much there is of one thing.
enum class BenchTable { modes, msaa, growth };

// What grows in --table growth.
enum class GrowthAxis { triangles, draws, instances, textures, lights, pixels };

// How much there is of it: a number, of textures MiB.
struct GrowthPoint {
    GrowthAxis axis;
    double value;
};

// As asked for; an empty list is what its comment says.
struct BenchOptions {
    BenchTable table = BenchTable::modes;
    std::vector<GrowthAxis> axes;              // of --table growth; all
    std::vector<Path> paths;                   // both
    std::vector<Assignment> assign;            // all
    std::vector<Size> sizes;                   // --size
    std::vector<Transparency> transparencies;  // --transparency
    std::vector<Lighting> lightings;           // of deferred; --lighting
    std::vector<std::uint32_t> light_counts;   // the scene's own lights; ascending
    double max_ms = 2000;                      // a frame that takes longer is not repeated
    bool frames = true, kernels = true;
};

// Words of the command line, separated by commas. Throw std::runtime_error naming the option and the word.
std::vector<Path> benchPaths(const std::string& words);
std::vector<Assignment> benchAssignments(const std::string& words);
std::vector<Size> benchSizes(const std::string& words);
std::vector<Transparency> benchTransparencies(const std::string& words);
std::vector<Lighting> benchLightings(const std::string& words);
std::vector<std::uint32_t> benchLightCounts(const std::string& words);  // each once, ascending

BenchTable benchTableOf(const std::string& word);
std::vector<GrowthAxis> growthAxes(const std::string& words);
std::string_view nameOf(GrowthAxis axis);

// What of a mode is named because several were asked for.
struct ModeParts {
    std::optional<Transparency> transparency = {};
    std::optional<int> samples = {};        // a pixel
    std::optional<Lighting> lighting = {};  // of deferred
    bool operator==(const ModeParts&) const = default;
};

// Settings of one scene that are timed in turn, so that a device that slows down does so for all alike.
struct BenchGroup {
    std::optional<std::uint32_t> lights;  // as asked for
    std::string scene;                    // as loadScene() takes it
    std::vector<Settings> settings;
    std::optional<GrowthPoint> growth = {};
};

struct BenchSkip {
    Path path = Path::deferred;
    Assignment assign = Assignment::every;
    std::optional<Size> size;             // nothing: none
    std::optional<std::uint32_t> lights;  // nothing: none
    ModeParts parts;
    std::string reason;
    std::optional<GrowthPoint> growth = {};
};

struct BenchCases {
    std::vector<BenchGroup> groups;  // by light count
    std::vector<BenchSkip> skips;
};

// Light counts are put into a built-in scene that takes ?lights=N, into a `--lights` whose name holds {}, or
// else into a seeded rig of point lights. Throws std::runtime_error where both a count and other lights were
// asked for, and where nothing is left to time.
// Of BenchTable::growth `scene` is not used: builtin:array and builtin:spheres grow.
// Of BenchTable::msaa: each path without blended surfaces and with them, with 1, 4 and 8 samples a pixel, by
// one assignment.
BenchCases makeBenchCases(const std::string& scene, const Settings& given, const BenchOptions& options);

// What a frame will take with `lights`, ms: on the line through the last two of (lights, ms), ascending, and
// no less than the last. Nothing where there are not two.
std::optional<double> predictedMs(std::span<const std::pair<std::uint32_t, double>> measured,
                                  std::uint32_t lights);

// "forward_plus, clustered"; with all parts "forward_plus, clustered, list, 4 samples"
std::string modeName(Path path, Assignment assign, const ModeParts& parts = {});
// The parts of the Settings that these options have several of.
ModeParts partsOf(const BenchOptions& options, const Settings& settings);
// Whether the assignment shades fewer lights a pixel than there are, so that its time is of another picture.
bool drawsAnotherPicture(Assignment assign);
// Names with a star where that is so, and what the star means.
std::string assignLabel(Assignment assign, const ModeParts& parts = {});
std::string modeLabel(Path path, Assignment assign, const ModeParts& parts = {});
inline constexpr const char* starMeans =
    "* draws a different picture: only some lights are shaded per pixel, the others per object";
// "forward_plus, every, 640x360, 1024 lights"
std::string skipName(const BenchSkip& skip);

}  // namespace diptych::bench
