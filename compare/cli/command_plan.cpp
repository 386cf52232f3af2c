// SPDX-License-Identifier: MIT
#include "compare/bench/estimate.h"
#include "compare/cli/commands.h"
#include "compare/cli/compiled_words.h"
#include "compare/frames/frame_facts.h"
#include "compare/render/path_plan.h"
#include "compare/run/print.h"
#include "shared/text/counted.h"
#include "shared/text/json_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <optional>

namespace diptych::cli {
namespace {

using Json = nlohmann::ordered_json;

struct ScenePlan {
    std::string scene;
    Requirements needs;
    std::vector<Requirements::Line> lines;
    std::vector<std::string> notes;  // deviations from the glTF file
    std::vector<std::string> variants;
    int variant = -1;  // the drawn one; -1: none
    std::vector<PathPlan> paths;
    std::vector<FrameWork> work;         // with --estimate
    std::vector<CompiledPath> compiled;  // with --compile-on
    const DeviceInfo* compiler = nullptr;
};

// Estimates for the compiler's GPU family, or for all GPUs without a compiler.
std::vector<bench::FrameEstimate> estimatesOf(const ScenePlan& plan, const FrameWork& work) {
    std::vector<bench::FrameEstimate> all;
    std::vector<bench::PassCycles> cycles;
    for (const CompiledPath& path : plan.compiled)
        if (path.path == work.path) cycles = bench::passCycles(path);
    for (const bench::GpuFigures& gpu : bench::estimatedGpus())
        if (plan.compiler == nullptr || bench::isOfFamily(gpu, plan.compiler->name))
            all.push_back(bench::estimate(work, gpu, {}, cycles));
    return all;
}

Json jsonOf(const ScenePlan& plan, const FrameWork& work) {
    Json passes = Json::array(), estimates = Json::array();
    for (const PassWork& pass : work.passes)
        passes.push_back({{"name", pass.counts.name},
                          {"vertices", pass.counts.vertices},
                          {"triangles", pass.counts.triangles},
                          {"samples", pass.counts.samples},
                          {"fragments", pass.counts.fragments},
                          {"outputs", pass.counts.outputs},
                          {"compute", pass.counts.compute},
                          {"texels", pass.texels},
                          {"lights", pass.lights},
                          {"bytes_read", pass.counts.read},
                          {"bytes_written", pass.counts.written},
                          {"vertex_bytes", pass.vertex_bytes}});
    for (const bench::FrameEstimate& estimate : estimatesOf(plan, work)) {
        Json each = Json::array();
        for (const bench::PassEstimate& pass : estimate.passes)
            each.push_back({{"name", pass.name}, {"ms", pass.ms}, {"bound", pass.bound}});
        estimates.push_back({{"gpu", estimate.gpu->name}, {"ms", estimate.ms}, {"passes", each}});
    }
    return {{"path", nameOf(work.path)}, {"passes", passes}, {"estimates", estimates}};
}

void print(const ScenePlan& plan, const FrameWork& work) {
    printOut("  workload of {}\n    {:<26} {:>10} {:>10} {:>10} {:>10} {:>10} {:>10} {:>9}\n",
             nameOf(work.path), "pass", "vertices", "triangles", "fragments", "texels", "lights", "compute",
             "MB");
    for (const PassWork& pass : work.passes)
        printOut("    {:<26} {:>10} {:>10} {:>10} {:>10.0f} {:>10.0f} {:>10} {:>9.2f}\n", pass.counts.name,
                 pass.counts.vertices, pass.counts.triangles, pass.counts.fragments, pass.texels, pass.lights,
                 pass.counts.compute,
                 (static_cast<double>(pass.counts.read + pass.counts.written) + pass.vertex_bytes) * 1e-6);
    for (const bench::FrameEstimate& estimate : estimatesOf(plan, work))
        printOut("    estimate, {}\n", bench::inWords(estimate));
}

bool isDrawn(const ScenePlan& plan, std::size_t variant) {
    return static_cast<int>(variant) == plan.variant;
}

Json variantsJson(const ScenePlan& plan) {
    Json variants = Json::array();
    for (std::size_t i = 0; i < plan.variants.size(); ++i)
        variants.push_back({{"name", plan.variants[i]}, {"drawn", isDrawn(plan, i)}});
    return variants;
}

Json jsonOf(const ScenePlan& plan) {
    Json modelled = Json::array(), leftOut = Json::array(), paths = Json::array();
    for (const auto& line : plan.lines)
        (line.modelled ? modelled : leftOut).push_back({{"what", line.what}, {"why", line.why}});
    Json work = Json::array();
    for (const FrameWork& frame : plan.work) work.push_back(jsonOf(plan, frame));
    for (const PathPlan& path : plan.paths) {
        Json samples = Json::array();
        for (const SampledBytes& bytes : path.bytes)
            samples.push_back({{"samples", bytes.samples},
                               {"bytes_per_pixel", bytes.geometry},
                               {"bytes_per_sample", bytes.geometry / static_cast<unsigned>(bytes.samples)},
                               {"image_bytes_per_pixel", bytes.all}});
        paths.push_back({{"path", path.path},
                         {"passes", path.passes},
                         {"bytes_per_pixel", path.bytes.front().geometry},
                         {"samples", samples},
                         {"shared_bytes_per_pixel", path.shared_bytes_per_pixel},
                         {"triangles_in_view", path.drawn.in_view},
                         {"triangles_drawn", path.drawn.drawn},
                         {"vertices_drawn", path.drawn.vertices},
                         {"instances_drawn", path.drawn.instances},
                         {"draws", path.drawn.draws},
                         {"notes", path.notes}});
    }
    Json json{{"scene", plan.scene},
              {"draws", plan.needs.draws},
              {"triangles", plan.needs.triangles},
              {"materials", plan.needs.materials},
              {"textures", plan.needs.textures},
              {"lights", plan.needs.lights()},
              {"modelled", modelled},
              {"left_out", leftOut},
              {"notes", plan.notes},
              {"variants", variantsJson(plan)},
              {"paths", paths},
              {"work", work}};
    if (plan.compiler != nullptr) json["compiled"] = compiledJson(plan.compiled, *plan.compiler);
    return json;
}

// "16 bytes per pixel, 48 with lit; with --msaa 4 96 and 176"
std::string bytesInWords(const PathPlan& path) {
    const SampledBytes& planned = path.bytes.front();
    std::string words = fmt::format("{} bytes per pixel, {} with lighting", planned.geometry, planned.all);
    for (const SampledBytes& other : path.bytes)
        if (other.samples != planned.samples)
            words += fmt::format("; {} and {} with --msaa {}", other.geometry, other.all, other.samples);
    return words;
}

void print(const ScenePlan& plan) {
    const Requirements& needs = plan.needs;
    printOut("{}: {}, {}, {}, {}, {}\n", plan.scene, counted(needs.draws, "draw"),
             counted(needs.triangles, "triangle"), counted(needs.materials, "material"),
             counted(needs.textures, "texture"), counted(needs.lights(), "light"));
    for (const bool modelled : {true, false}) {
        printOut("  {}\n", modelled ? "modelled" : "left out");
        for (const auto& line : plan.lines)
            if (line.modelled == modelled) printOut("    {:<26} {}\n", line.what, line.why);
    }
    if (!plan.variants.empty())
        printOut("  material variants{}\n",
                 plan.variant < 0 ? "; none is drawn: primitives have their own materials" : "");
    for (std::size_t i = 0; i < plan.variants.size(); ++i)
        printOut("    {:<26} {}\n", fmt::format("{} {}", i, plan.variants[i]),
                 isDrawn(plan, i) ? "drawn" : fmt::format("--variant {} draws it", i));
    for (const PathPlan& path : plan.paths) {
        printOut("  {}: {}; {}{}\n", path.path, fmt::join(path.passes, " > "), bytesInWords(path),
                 path.shared_bytes_per_pixel > 0
                     ? fmt::format("; images that share memory save {} more", path.shared_bytes_per_pixel)
                     : "");
        printOut("    {} of {} triangles are in view; {} are drawn with {} and {}; vertices: {}\n",
                 path.drawn.in_view, needs.triangles, path.drawn.drawn, counted(path.drawn.draws, "draw"),
                 counted(path.drawn.instances, "instance"), path.drawn.vertices);
        for (const std::string& line : path.notes) printOut("    {}\n", line);
    }
    if (plan.compiler != nullptr) printOut("{}", compiledText(plan.compiled, *plan.compiler));
    for (const FrameWork& work : plan.work) print(plan, work);
    for (const std::string& line : plan.notes) printOut("  note: {}\n", line);
}

}  // namespace

int runPlan(const Options& options) {
    refuseOut(options);
    std::vector<Path> paths(drawn_paths.begin(), drawn_paths.end());
    if (options.path_given) paths = {options.settings.path};
    if (isReference(paths.front()))
        throw std::runtime_error("--path reference: has no passes to plan; use deferred or forward_plus");
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
        const Scene scene = loadShown(name, options.settings, Stage(progress, name));
        SceneViews views(scene);
        const SceneView& view = views.at(viewRequest(settings.front()));
        const ScenePlan result{
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
            scenes.push_back(jsonOf(result));
        else if (!options.quiet)
            print(result);
    }
    checkValidation(device);
    if (options.json) printOut("{}\n", jsonText(Json{{"schema", 1}, {"scenes", scenes}}));
    return compiles ? 0 : 1;
}

}  // namespace diptych::cli
