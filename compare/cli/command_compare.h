// SPDX-License-Identifier: MIT
// Options of `compare`, which `view` shares.
#pragma once

#include "compare/cli/option_groups.h"
#include "compare/experiment/comparison.h"
#include "compare/explain/explanations.h"
#include "compare/report/whole_report.h"

namespace diptych::cli {

struct Pixel {
    int x = 0, y = 0;  // from the top left
};

struct CompareLine : ShardedGroup,
                     BaselineGroup,
                     RendererGroup,
                     SelectionGroup,
                     RulesGroup,
                     KeepGroup,
                     SinceGroup {
    bool update_baseline = false;
    Twice twice = Twice::lit;
    bool allow_noise = false;
    bool explain = false;        // explains lit even where it passes
    std::optional<Pixel> pixel;  // to break down
    std::string twice_text = "lit";
    std::optional<std::string> pixel_text;
};

// Options after those of the scene: first up to the files of a report, then the rest. `out`: help of --out.
void addCompared(CLI::App& app, CompareLine& options, const char* out);
void addEvaluated(CLI::App& app, CompareLine& options);
void resolveCompare(CompareLine& options);

int runPixel(const CompareLine& options);  // --pixel

// Words of options that influence the verdict, without scene, camera and Settings.
std::vector<std::string> verdictOptions(const CompareLine& options);

// Options of `compare` that influence a verdict. Reads the rules; throws std::runtime_error, one line, if
// they are invalid or name an unknown channel.
CompareOptions compareOptions(const CompareLine& options);

experiment::Compared comparedOf(const CompareLine& options);
ExplanationQuestion explanationOf(const CompareLine& options);
// Whether the baseline is a reference in mode scene, rendered now or read from a file.
bool isTraced(const std::vector<Settings>& settings, const std::optional<Frame>& baseline);

// compare for many scenes, or for a shard of them. Writes a report part beside `folder` after each scene,
// and the whole report at the end. An interrupted command resumes after its last part. The next scene
// loads while one is compared. A scene that cannot be read or rendered is an error of the report.
// `settings`: all cameras, times and paths.
int compareMany(const CompareLine& options, const std::vector<Settings>& settings,
                const std::filesystem::path& folder);

// Prints the results of a report of many scenes in `folder`. `all`: includes comparisons that pass.
void showWhole(const OutputGroup& options, const ReportPart& joined, const std::filesystem::path& folder,
               const Trends* since, bool all);

}  // namespace diptych::cli
