// SPDX-License-Identifier: MIT
#include "compare/cli/commands.h"
#include "compare/render/frame_facts.h"
#include "compare/render/path_plan.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

namespace diptych::cli {
namespace {

using Json = nlohmann::ordered_json;

struct ScenePlan {
    std::string scene;
    Requirements needs;
    std::vector<Requirements::Line> lines;
    std::vector<std::string> notes;  // what was read otherwise than the file says
    std::vector<PathPlan> paths;
};

Json jsonOf(const ScenePlan& plan) {
    Json modelled = Json::array(), leftOut = Json::array(), paths = Json::array();
    for (const auto& line : plan.lines)
        (line.modelled ? modelled : leftOut).push_back({{"what", line.what}, {"why", line.why}});
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
                         {"notes", path.notes}});
    }
    return {{"scene", plan.scene},
            {"draws", plan.needs.draws},
            {"triangles", plan.needs.triangles},
            {"materials", plan.needs.materials},
            {"textures", plan.needs.textures},
            {"lights", plan.needs.lights()},
            {"modelled", modelled},
            {"left_out", leftOut},
            {"notes", plan.notes},
            {"paths", paths}};
}

// "16 bytes per pixel, 48 with lit; with --msaa 4 96 and 176"
std::string bytesInWords(const PathPlan& path) {
    const SampledBytes& planned = path.bytes.front();
    std::string words = fmt::format("{} bytes per pixel, {} with light", planned.geometry, planned.all);
    for (const SampledBytes& other : path.bytes)
        if (other.samples != planned.samples)
            words += fmt::format("; {} and {} with --msaa {}", other.geometry, other.all, other.samples);
    return words;
}

void print(const ScenePlan& plan) {
    const Requirements& needs = plan.needs;
    fmt::print("{}: {} draws, {} triangles, {} materials, {} textures, {} lights\n", plan.scene, needs.draws,
               needs.triangles, needs.materials, needs.textures, needs.lights());
    for (const bool modelled : {true, false}) {
        fmt::print("  {}\n", modelled ? "modelled" : "left out");
        for (const auto& line : plan.lines)
            if (line.modelled == modelled) fmt::print("    {:<26} {}\n", line.what, line.why);
    }
    for (const PathPlan& path : plan.paths) {
        fmt::print(
            "  {}: {}; {}{}\n", path.path, fmt::join(path.passes, " > "), bytesInWords(path),
            path.shared_bytes_per_pixel > 0
                ? fmt::format("; {} more are saved by images that share memory", path.shared_bytes_per_pixel)
                : "");
        fmt::print("    {} of {} triangles are in view and {} drawn, with {} vertices\n", path.drawn.in_view,
                   needs.triangles, path.drawn.drawn, path.drawn.vertices);
        for (const std::string& line : path.notes) fmt::print("    {}\n", line);
    }
    for (const std::string& line : plan.notes) fmt::print("  note: {}\n", line);
}

}  // namespace

int runPlan(const Options& options) {
    refuseOut(options);
    std::vector<Path> paths(drawn_paths.begin(), drawn_paths.end());
    if (options.path_given) paths = {options.settings.path};
    if (paths.front() == Path::reference)
        throw std::runtime_error("--path reference: has no passes; plan tells of deferred and forward_plus");
    const std::vector<Settings> settings = settingsOf(options, paths);
    Device device(deviceOptions(options));
    Progress progress(progressOutput(options));
    Json scenes = Json::array();
    for (const std::string& name : options.scenes) {
        const Scene scene = loadShown(name, options.settings, Stage(progress, name));
        SceneViews views(scene);
        const SceneView& view = views.at(viewRequest(settings.front()));
        const ScenePlan result{scene.name, view.needs, planLines(view, settings.front().skinning),
                               describedFrame(scene, view, settings.front()).notes,
                               planPaths(device, views, settings)};
        progress.wipe();
        if (options.json)
            scenes.push_back(jsonOf(result));
        else if (!options.quiet)
            print(result);
    }
    checkValidation(device);
    if (options.json)
        fmt::print("{}\n", Json{{"schema", 1}, {"scenes", scenes}}.dump(2, ' ', false,
                                                                        Json::error_handler_t::replace));
    return 0;
}

}  // namespace diptych::cli
