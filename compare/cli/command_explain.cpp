// SPDX-License-Identifier: MIT
#include "compare/cli/commands.h"
#include "compare/explain/words.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

namespace diptych::cli {

namespace {

// Settings that choose what is seen.
constexpr std::string_view ofTheView[] = {"size", "camera", "time", "animation", "env", "lights", "seed"};

// The other path, and what --test names.
Settings testOf(const Options& options, std::string& name) {
    Settings test = options.settings;
    if (options.test.empty())
        test.path = options.baseline == Path::deferred ? Path::forward_plus : Path::deferred;
    else
        test.path = options.baseline;
    for (const auto& [option, value] : options.test) {
        if (std::ranges::find(ofTheView, option) != std::end(ofTheView))
            throw std::runtime_error(
                fmt::format("--test {}={}: both pictures are of one view of one scene", option, value));
        test.set(option, value);
        if (option != "path") name += fmt::format(" --{} {}", option, value);
    }
    name = fmt::format("{}{}", nameOf(test.path), name);
    if (test.path == Path::reference)
        throw std::runtime_error(
            "--test path=reference: explain swaps what the two paths share; use deferred or "
            "forward_plus");
    if (const auto problem = test.problem()) throw std::runtime_error(*problem);
    return test;
}

}  // namespace

int runExplain(const Options& options) {
    if (options.scenes.size() != 1)
        throw std::runtime_error(
            fmt::format("{}: an explanation is of one scene; run it once for each", options.scenes[1]));
    if (options.cameras.size() != 1)
        throw std::runtime_error(fmt::format(
            "--camera {}: an explanation is of one view; run it once for each", options.cameras[1]));
    if (options.baseline == Path::reference || !options.baseline_file.empty())
        throw std::runtime_error(
            "--baseline reference or FILE.exr: explain swaps what the two paths share; use deferred or "
            "forward_plus");
    refuseOut(options);
    ExplainedPictures of{options.scenes.front(), std::string(nameOf(options.baseline)), ""};
    Settings baseline = options.settings;
    baseline.path = options.baseline;
    if (const auto problem = baseline.problem()) throw std::runtime_error(*problem);
    const Settings test = testOf(options, of.test);
    Progress progress(progressOutput(options));
    const Stage stage(progress, of.scene);
    const Scene scene = loadShown(of.scene, options.settings, stage.part(0, 0.1));
    Device device(deviceOptions(options));
    say(options, "on " + device.info().name);
    SceneViews views(scene);
    Renderer renderer(device, views);
    RenderOptions drawing = renderOptions(options);
    drawing.channels = explainedChannels();
    drawing.runs = 0;
    drawing.progress = stage.part(0.1, 0.25);
    const Frame a = renderer.draw(baseline, drawing);
    drawing.progress = stage.part(0.25, 0.4);
    const Frame b = renderer.draw(test, drawing);
    const Explanation explanation = explain(device, renderer, scene, a, b, stage.part(0.4, 1));
    checkValidation(device);
    progress.wipe();
    if (options.json)
        fmt::print("{}\n", toJson(explanation, of).dump(2));
    else if (!options.quiet)
        printColored(options, inWords(explanation, of));
    return 0;
}

}  // namespace diptych::cli
