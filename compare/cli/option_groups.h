// SPDX-License-Identifier: MIT
// Smaller groups of options that some commands share. addX() adds a group to the parser, resolveX() checks
// its words and throws std::runtime_error, one line.
#pragma once

#include "compare/cli/scene_group.h"
#include "compare/external/renderer_file.h"
#include "compare/report/report_options.h"
#include "compare/report/trends.h"
#include "compare/verdict/selection.h"

namespace diptych::cli {

// --baseline: compare, view, explain
struct BaselineGroup {
    Path baseline = Path::deferred;       // the left panel
    std::filesystem::path baseline_file;  // replaces the path; empty: none
    std::string baseline_text = "deferred";
};
void addBaseline(CLI::App& app, BaselineGroup& options, const char* help, const char* type);
void resolveBaseline(BaselineGroup& options);

// --renderer: compare, explain, tradeoff
struct RendererGroup {
    std::vector<external::ExternalRenderer> renderers;
    std::vector<std::string> renderer_texts;  // words of the command line that name them
    std::vector<std::string> renderer_files;  // NAME=FILE.json
};
// `does`: what the command does with an external renderer.
void addRenderers(CLI::App& app, RendererGroup& options, const char* does);
void resolveRenderers(RendererGroup& options);

// The pixels that count: compare, view, diff
struct SelectionGroup {
    SelectionOptions selection;
    std::string crop_text;
};
void addSelection(CLI::App& app, SelectionGroup& options);
void resolveSelection(SelectionGroup& options);

// --strict, --allow-empty, --tolerances: compare, view, diff
struct RulesGroup {
    bool strict = false, allow_empty = false;
    std::filesystem::path tolerances;  // a file of rules; empty: none
};
void addTolerances(CLI::App& app, RulesGroup& options);

// --keep, --single-file: compare, view, diff
struct KeepGroup {
    Keep keep = Keep::all;  // comparisons with kept images, EXRs
    bool single_file = false;
    std::string keep_text = "all";
};
void addReport(CLI::App& app, KeepGroup& options);
void resolveKeep(KeepGroup& options);

// Commands of many scenes, which programs share by --shard and --timings: compare, tradeoff
struct ShardedGroup : SceneGroup {
    std::string shard;              // as given; empty: all scenes
    std::filesystem::path timings;  // an earlier report; empty: none
    const char* folder = "";        // of the output, without -o
};
void addShard(CLI::App& app, ShardedGroup& options, const char* folder);

// --since: compare, merge
struct SinceGroup {
    std::filesystem::path since;  // an earlier report; empty: none
};
void addSince(CLI::App& app, SinceGroup& options);
// Throws std::runtime_error if the file is not a report. Call it before any long work.
void checkSince(const SinceGroup& options);
// Changes since the report, for comparisons with these rows; nullptr without --since.
std::shared_ptr<const Trends> sinceOf(const SinceGroup& options, const Report& report,
                                      const std::vector<IndexRow>& rows);
std::string sinceText(const Trends* since, const Report& report);  // lines for the terminal

// --grid: tradeoff, choose
struct GridGroup {
    std::string grid;  // a file or JSON; empty: defaultGrids()
};
// `defaults`: what a sweep tries without --grid.
void addGrid(CLI::App& app, GridGroup& options, const char* defaults);

}  // namespace diptych::cli
