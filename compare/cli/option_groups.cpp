// SPDX-License-Identifier: MIT
#include "compare/cli/option_groups.h"

#include "compare/cli/add_option.h"
#include "shared/image/image_file.h"
#include "shared/text/did_you_mean.h"

#include <fmt/format.h>

#include <algorithm>

namespace diptych::cli {

void addBaseline(CLI::App& app, BaselineGroup& options, const char* help, const char* type) {
    addOption(app, "--baseline", options.baseline_text, type, help);
}

void resolveBaseline(BaselineGroup& options) {
    const std::string& word = options.baseline_text;
    std::vector<std::string> names;
    for (const auto& [path, name] : enumNames<Path>()) {
        if (name == word) {
            options.baseline = path;
            return;
        }
        names.emplace_back(name);
    }
    if (imageName(word).file.extension() != ".exr")
        refuse("--baseline {}: is not deferred, forward_plus, reference or an .exr file{}", word,
               didYouMean(word, names));
    options.baseline_file = word;
}

void addRenderers(CLI::App& app, RendererGroup& options, const char* does) {
    addEach(
        app, "--renderer", options.renderer_files, "NAME=FILE.json",
        fmt::format("{}; repeatable. The file gives its command, see compare/external/renderer.schema.json",
                    does))
        ->group(image_group);
}

void resolveRenderers(RendererGroup& options) {
    for (const std::string& sentence : options.renderer_files) {
        external::ExternalRenderer renderer = external::readRenderer(sentence);
        if (std::ranges::count(options.renderers, renderer.name, &external::ExternalRenderer::name) > 0)
            refuse("--renderer {}: two renderers have this name; give each its own", renderer.name);
        options.renderers.push_back(std::move(renderer));
        options.renderer_texts.insert(options.renderer_texts.end(), {"--renderer", sentence});
    }
}

void addSelection(CLI::App& app, SelectionGroup& options) {
    SelectionOptions& selection = options.selection;
    app.option_defaults()->group(selection_group);
    addOption(app, "--mask", selection.mask, "FILE",
              "compare only pixels that are white in this picture: a colour component is at least half (128 "
              "of 255, or 0.5), whatever the alpha");
    addList(app, "--ids", selection.ids, "ID,...",
            "compare only pixels with these material ids in the reference");
    addOption(app, "--ignore-edges", selection.ignore_edges, "N",
              "exclude pixels within N pixels of another object")
        ->check(CLI::Range(0, 1000));
    addOption(app, "--crop", options.crop_text, "X,Y,WxH",
              "compare only this rectangle; X,Y from the top left");
}

void resolveSelection(SelectionGroup& options) {
    if (!options.crop_text.empty()) options.selection.crop = cropOf(options.crop_text);
}

void addTolerances(CLI::App& app, RulesGroup& options) {
    app.option_defaults()->group(selection_group);
    app.add_flag(
        "--strict", options.strict,
        "make failures of these notes: a channel on only one side, a file that is read in part, a colour "
        "profile or pixel aspect that is not applied, an empty picture, a large error that is granted");
    app.add_flag(
        "--allow-empty", options.allow_empty,
        "no warning about pictures that are black, empty, or show the scene on less than 1 % of the pixels");
    addOption(app, "--tolerances", options.tolerances, "FILE.json",
              "rules for allowed differences, see compare/verdict/tolerances.schema.json");
}

void addReport(CLI::App& app, KeepGroup& options) {
    app.option_defaults()->group(output_group);
    addOption(app, "--keep", options.keep_text, "all|failing|none",
              "comparisons whose pictures and EXRs the report keeps (all)");
    app.add_flag("--single-file", options.single_file,
                 "embed the pictures in the page at half size; other files only for CI");
}

void resolveKeep(KeepGroup& options) {
    options.keep = valueNamed<Keep>("--keep", options.keep_text,
                                    {{{"all", Keep::all}, {"failing", Keep::failing}, {"none", Keep::none}}});
}

void addShard(CLI::App& app, ShardedGroup& options, const char* folder) {
    options.folder = folder;
    app.option_defaults()->group(output_group);
    addOption(app, "--shard", options.shard, "I/N|slurm[/N]",
              "render one part of the scenes: the I-th of N, from 1; slurm: the task of a Slurm array "
              "(slurm/N if its indices are irregular). merge joins the reports");
    addOption(app, "--timings", options.timings, "DIR|report.json",
              "earlier report with the scenes' times, to balance shards (by file size)");
}

void addSince(CLI::App& app, SinceGroup& options) {
    app.option_defaults()->group(output_group);
    addOption(app, "--since", options.since, "DIR|report.json",
              "earlier report to compare with: new failures, fixed failures, and metrics that changed by "
              "more than their noise");
}

void checkSince(const SinceGroup& options) {
    if (!options.since.empty()) trendsSince(options.since, {}, {});
}

std::shared_ptr<const Trends> sinceOf(const SinceGroup& options, const Report& report,
                                      const std::vector<IndexRow>& rows) {
    return options.since.empty() ? nullptr
                                 : std::make_shared<const Trends>(trendsSince(options.since, report, rows));
}

std::string sinceText(const Trends* since, const Report& report) {
    std::string text;
    if (since)
        for (const std::string& line : trendLines(*since, report))
            text += fmt::format("since {}: {}\n", since->report, line);
    return text;
}

void addGrid(CLI::App& app, GridGroup& options, const char* defaults) {
    addOption(
        app, "--grid", options.grid, "FILE.json|JSON",
        fmt::format("Settings to try: {{ \"settings\": {{ \"gbuffer\": [\"compact\", \"full\"], \"size\": "
                    "[\"1/2\"] }} }} tries every combination; a list of such objects tries each in turn ({})",
                    defaults));
}

}  // namespace diptych::cli
