// SPDX-License-Identifier: MIT
// The parsed command line.
#pragma once

#include "compare/bench/cases.h"
#include "compare/external/renderer_file.h"
#include "compare/frames/render_options.h"
#include "compare/picture/picture.h"
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
    std::string figure = "flip";  // name in experiment::errorFigures
    bool explain = false;         // --explain-choice
};

// audit
struct AuditOptions {
    std::vector<std::string> quantities;  // names; empty: all
    // --require: magnitudes that must pass, by quantity.
    std::vector<std::pair<std::string, double>> required;
    bool relations = false;                     // --relations: test relations instead of quantities
    std::vector<std::string> chosen_relations;  // --relation: names; empty: all
};

// view
struct ViewOptions {
    std::filesystem::path report;  // --report: folder of a compare report; empty: none
    bool watch = false;            // --watch
};

// accept
struct AcceptOptions {
    std::string channel;  // empty: all failing channels
    std::string because;  // empty: names the report
};

// submit
struct SubmitOptions {
    std::string engine;                // "slurm"
    std::vector<std::string> words;    // of the submitted command, after --
    std::vector<std::string> options;  // --sbatch
    int shards = 0, at_once = 0;       // 0: one per scene, at most 16; 0: no limit
    bool dry_run = false;
};

struct Options {
    std::string help;     // text to print instead of running: --help, --version
    std::string command;  // "compare"
    std::vector<std::string> scenes{"builtin:gallery"};
    Settings settings;                               // camera and time are the first of cameras and times
    SideSettings sides;                              // compare, explain, view: Settings of one path only
    std::vector<std::string> cameras{""};            // one Frame per camera, scene and path
    std::vector<double> times{0.0};                  // compare: s; one Frame per time, camera, path, scene
    int frames = 1;                                  // render: image count, first at settings.time
    double fps = 30;                                 // images per second
    bool camera_given = false;                       // by --camera or --settings
    bool path_given = false;                         // by --path
    bool scene_given = false;                        // by a scene argument
    bool size_given = false, shadows_given = false;  // also by --settings
    Path baseline = Path::deferred;                  // compare: the left panel
    Channel shown = Channel::lit;                    // of the image
    bool debug_given = false;                        // by --debug
    bool heat = false;                               // --heat: shows the light count, overriding --debug
    std::vector<Channel> channels;                   // debug modes, ascending; empty: all supported
    int runs = 5;                                    // timed frames; default: defaultRuns()
    Twice twice = Twice::lit;                        // compare
    PictureChoice picture;
    std::filesystem::path match_exposure;  // image that sets the exposure; empty: none
    std::string device;                    // index or part of a name
    std::string against_device;            // compare, explain: the second device; empty: none
    bool validate = false;
    std::filesystem::path out;  // empty: the command's default
    bool force = false, json = false, quiet = false, verbose = false;
    ColorChoice color = ColorChoice::automatic;
    bool single_file = false, list_scenes = false, list_channels = false;
    Keep keep = Keep::all;                      // compare, diff: comparisons with kept images, EXRs
    SelectionOptions selection;                 // compare: pixels
    bool allow_noise = false;                   // compare
    bool estimate = false;                      // plan: estimates times on other GPUs
    std::string compile_on;                     // plan, bench: a device or GPU family; empty: none
    bool explain = false;                       // compare: explains lit even where it passes
    std::vector<external::Renderer> renderers;  // compare, explain, tradeoff: --renderer
    std::vector<std::string> renderer_words;    // words of the command line that name them
    std::filesystem::path baseline_file;        // compare: replaces the baseline path; empty: none
    std::string scene_file;                     // explain: scene of two EXR files; empty: as declared
    // explain: Settings in which the test differs from the baseline, as words of Settings::set().
    std::vector<std::pair<std::string, std::string>> test;
    struct Pixel {
        int x = 0, y = 0;
    };
    std::optional<Pixel> pixel;  // compare: pixel to break down, from the top left
    bool update_baseline = false;
    std::string shard;                 // --shard as given; empty: all scenes
    std::filesystem::path timings;     // --timings: an earlier report; empty: none
    bool strict = false;               // compare, diff
    bool allow_empty = false;          // compare, diff
    std::filesystem::path tolerances;  // compare, diff: a file of rules; empty: none
    PictureDiffOptions diff;           // diff: all but the rules
    bench::BenchOptions bench;
    ChooseOptions choose;
    AuditOptions audit;
    ViewOptions view;
    AcceptOptions accept;
    SubmitOptions submit;
    std::filesystem::path since;  // compare, merge: an earlier report; empty: none
    bool probe = false;           // devices: run the probes of compare/probe
    std::string grid;             // tradeoff, choose: a file or JSON; empty: defaultGrids()
};

// Animation time, s, of image `frame` of --frames, counted from 0.
inline double timeOfFrame(const Options& options, int frame) {
    return options.settings.time + frame / options.fps;
}

}  // namespace diptych::cli
