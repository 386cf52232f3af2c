// SPDX-License-Identifier: MIT
#include "compare/bench/scene_plan.h"
#include "compare/cli/add_option.h"
#include "compare/cli/command.h"
#include "compare/cli/exit_code.h"
#include "compare/frames/frame_properties.h"
#include "compare/run/print.h"
#include "shared/text/json_text.h"

#include <nlohmann/json.hpp>

#include <algorithm>

namespace diptych::cli {
namespace {

using Json = nlohmann::ordered_json;

struct PlanLine : SceneGroup {
    bool estimate = false;   // estimates times on other GPUs
    std::string compile_on;  // a device or GPU family; empty: none
};

void describePlan(CLI::App& app, PlanLine& options) {
    addScene(app, options, one_scene_help);
    addFiles(app, options, "not accepted: plan writes no file; use --json");
    app.add_flag("--estimate", options.estimate,
                 "render the frames, count their workload, and estimate their time on some GPUs")
        ->group("Plan");
    addCompileOn(app, options.compile_on,
                 "compile each pipeline for this device and print the compiler's statistics", "Plan");
    addOutput(app, options);
    acceptUnread(app, {"--out", "--force", "--runs"});
    acceptUnread(app, image_group);
}

int runPlan(const PlanLine& options) {
    refuseOut(options, "plan");
    std::vector<Path> paths(drawn_paths.begin(), drawn_paths.end());
    if (options.path_requested) paths = {options.settings.path};
    if (isReference(paths.front()))
        refuse("--path reference: has no passes to plan; use deferred or forward_plus");
    const std::vector<Settings> settings = settingsOf(options, paths);
    std::optional<DeviceCompiler> compiler;
    if (!options.compile_on.empty()) compiler.emplace(options.compile_on);
    DeviceOptions drawing = deviceOptions(options);
    if (compiler) drawing.compiler = &*compiler;
    Device device(drawing);
    Progress progress(progressOutput(options));
    Json scenes = Json::array();
    bool compiles = true;
    for (const std::string& name : options.scenes) {
        const Scene scene = loadSceneWithSettings(name, options.settings, Stage(progress, name));
        SceneViews views(scene);
        const SceneView& view = views.at(viewRequest(settings.front()));
        const bench::ScenePlan result{
            scene.name,
            view.needs,
            planLines(view, settings.front()),
            describedFrame(scene, view, settings.front()).notes,
            scene.variants,
            scene.variant,
            planPaths(device, views, settings),
            options.estimate ? countWork(device, views, settings) : std::vector<FrameWork>{},
            compiler ? compilePaths(device, *compiler, views, settings) : std::vector<CompiledPath>{},
            compiler ? &compiler->info() : nullptr};
        compiles &=
            std::ranges::all_of(result.compiled, [](const CompiledPath& p) { return p.errors.empty(); });
        progress.wipe();
        if (options.json)
            scenes.push_back(toJson(result));
        else if (!options.quiet)
            printText(describe(result));
    }
    checkValidation(device);
    if (options.json) printOut("{}\n", jsonText(Json{{"schema", 1}, {"scenes", scenes}}));
    return exitCode(compiles);
}

}  // namespace

Command planCommand() {
    return makeCommand<PlanLine>(
        {"plan", "Lists the features a scene needs and those left out, with reasons; passes and bytes",
         "diptych plan helmet.glb --gbuffer compact",
         "estimate compile-on gbuffer assign lights shadows msaa device json verbose"},
        describePlan, resolveScene, runPlan);
}

}  // namespace diptych::cli
