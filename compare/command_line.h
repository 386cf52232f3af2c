// SPDX-License-Identifier: MIT
// From the words of the command line to what is asked for.
#pragma once

#include "compare/bench/plan.h"
#include "compare/picture_diff.h"
#include "compare/selection.h"
#include "shared/frame/debug_modes.h"
#include "shared/frame/settings.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace diptych {

// How a picture is made from radiance; an EXR never changes with it.
struct PictureChoice {
    std::optional<double> exposure;  // factor
    std::optional<double> ev100;     // or exposure value at ISO 100
    bool tonemap = true;
};

struct Options {
    std::string help;     // what to print instead of doing anything: --help, --version
    std::string command;  // "compare"
    std::vector<std::string> scenes{"builtin:gallery"};
    Settings settings;                     // settings.camera is the first of cameras
    std::vector<std::string> cameras{""};  // one Frame each, of every scene and path
    bool path_given = false;               // --path stood on the command line
    Path baseline = Path::deferred;        // compare: the left panel
    int shown = 0;                         // debug mode of the picture
    bool debug_given = false;              // --debug stood on the command line
    bool heat = false;                     // --heat: shown is the light count, whatever --debug says
    std::vector<int> channels;             // debug modes, ascending; empty: all that can be made
    int runs = 5;                          // timed frames
    PictureChoice picture;
    std::string device;  // index or part of a name
    bool validate = false;
    std::filesystem::path out;  // empty: the command's own default
    bool force = false, json = false, quiet = false, verbose = false;
    bool single_file = false, list_scenes = false;
    SelectionOptions selection;           // compare: pixels
    bool allow_noise = false;             // compare
    std::filesystem::path baseline_file;  // compare: instead of a path; empty: none
    bool update_baseline = false;
    std::filesystem::path tolerances;  // compare, diff: a file of rules; empty: none
    PictureDiffOptions diff;           // diff; without rules
    BenchOptions bench;
    std::string grid;  // tradeoff: a file or JSON; empty: what is usual
};

// `words` as the shell gives them, without the program's name. Every option of the tool's contract parses;
// throws std::runtime_error, one line, for a usage error and for what is not built yet.
Options parseCommandLine(const std::vector<std::string>& words);

}  // namespace diptych
