// SPDX-License-Identifier: MIT
// The parsed command line.
#pragma once

#include "compare/bench/cases.h"
#include "compare/external/renderer_file.h"
#include "compare/picture/picture.h"
#include "compare/render/render_options.h"
#include "compare/report/report_options.h"
#include "compare/run/color.h"
#include "compare/verdict/picture_diff.h"
#include "compare/verdict/selection.h"
#include "shared/frame/debug_modes.h"
#include "shared/frame/settings.h"
#include "shared/frame/sides.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace diptych::cli {

// choose
struct ChooseOptions {
    std::optional<double> max_error, max_ms;
    std::optional<std::uint64_t> max_bytes;
    std::string figure = "flip";  // of tradeoff::errorFigures
    bool explain = false;         // --explain-choice
};

// audit
struct AuditOptions {
    std::vector<std::string> quantities;  // names; empty: all
    // Magnitudes that must be reached, by quantity: --require.
    std::vector<std::pair<std::string, double>> required;
    bool relations = false;                     // --relations: instead of pushing anything
    std::vector<std::string> chosen_relations;  // --relation: names; empty: all
};

// view
struct ViewOptions {
    std::filesystem::path report;  // --report: a folder that compare wrote; empty: none
    bool watch = false;            // --watch
};

// accept
struct AcceptOptions {
    std::string channel;  // empty: every one that fails
    std::string because;  // empty: what it was accepted from
};

// submit
struct SubmitOptions {
    std::string engine;                // "slurm"
    std::vector<std::string> words;    // of the command, behind --
    std::vector<std::string> options;  // --sbatch
    int shards = 0, at_once = 0;       // 0: as many as there are scenes, at most 16; no limit
    bool dry_run = false;
};

struct Options {
    std::string help;     // what to print instead of doing anything: --help, --version
    std::string command;  // "compare"
    std::vector<std::string> scenes{"builtin:gallery"};
    Settings settings;   // settings.camera is the first of cameras, settings.time that of times
    SideSettings sides;  // compare, explain, view: what one path has on top of these
    std::vector<std::string> cameras{""};  // one Frame each, of every scene and path
    std::vector<double> times{0.0};        // compare: s, one Frame each, of every scene, camera and path
    int frames = 1;                        // render: so many pictures, the first at settings.time,
    double fps = 30;                       // and so many a second
    bool camera_given = false;             // --camera stood on the command line or in --settings
    bool path_given = false;               // --path stood on the command line
    bool scene_given = false;              // a scene stood there
    bool size_given = false, shadows_given = false;  // likewise, or in --settings
    Path baseline = Path::deferred;                  // compare: the left panel
    int shown = 0;                                   // debug mode of the picture
    bool debug_given = false;                        // --debug stood on the command line
    bool heat = false;          // --heat: shown is the light count, whatever --debug says
    std::vector<int> channels;  // debug modes, ascending; empty: all that can be made
    int runs = 5;               // timed frames; usualRuns() of the command
    Twice twice = Twice::lit;   // compare
    PictureChoice picture;
    std::filesystem::path match_exposure;  // a picture whose exposure is taken over; empty: none
    std::string device;                    // index or part of a name
    std::string against_device;            // compare, explain: likewise, of the other device; empty: none
    bool validate = false;
    std::filesystem::path out;  // empty: the command's own default
    bool force = false, json = false, quiet = false, verbose = false;
    ColorChoice color = ColorChoice::automatic;
    bool single_file = false, list_scenes = false, list_channels = false;
    Keep keep = Keep::all;       // compare, diff: of which comparisons a report keeps pictures, EXRs
    SelectionOptions selection;  // compare: pixels
    bool allow_noise = false;    // compare
    bool estimate = false;       // plan: what the frames should take on GPUs that are not here
    std::string compile_on;      // plan: a device or a family of GPUs; empty: none
    bool explain = false;        // compare: why lit differs also where it passes
    std::vector<external::Renderer> renderers;  // compare, explain, tradeoff: --renderer
    std::vector<std::string> renderer_words;    // of the command line that name them
    std::filesystem::path baseline_file;        // compare: instead of a path; empty: none
    std::string scene_file;  // explain, of two EXR files: their scene; empty: the one that they name
    // explain: Settings of the test that are others than the baseline's, in the words of Settings::set().
    std::vector<std::pair<std::string, std::string>> test;
    struct Pixel {
        int x = 0, y = 0;
    };
    std::optional<Pixel> pixel;  // compare: that whose story is told, from the top left
    bool update_baseline = false;
    std::string shard;                 // --shard, as given; empty: the whole
    std::filesystem::path timings;     // --timings: an earlier report; empty: none
    bool strict = false;               // compare, diff
    bool allow_empty = false;          // compare, diff
    std::filesystem::path tolerances;  // compare, diff: a file of rules; empty: none
    PictureDiffOptions diff;           // diff; without rules
    bench::BenchOptions bench;
    ChooseOptions choose;
    AuditOptions audit;
    ViewOptions view;
    AcceptOptions accept;
    SubmitOptions submit;
    std::filesystem::path since;  // compare, merge: an earlier report; empty: none
    bool probe = false;           // devices: runs the probes of compare/probe
    std::string grid;             // tradeoff, choose: a file or JSON; empty: usualGrids()
};

// The animation time, s, of picture `frame` of --frames, from 0 on.
inline double timeOfFrame(const Options& options, int frame) {
    return options.settings.time + frame / options.fps;
}

}  // namespace diptych::cli
