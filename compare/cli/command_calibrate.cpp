// SPDX-License-Identifier: MIT
#include "compare/cli/add_option.h"
#include "compare/cli/command.h"
#include "compare/cli/exit_code.h"
#include "compare/external/calibration.h"
#include "compare/external/external_frame.h"
#include "shared/contract/debug_mode.h"
#include "shared/scene/load.h"
#include "shared/text/json_text.h"

#include <fmt/format.h>

namespace diptych::cli {

namespace {

struct CalibrateLine : OutputGroup {
    std::vector<std::string> renderer;  // its file
};

void describeCalibrate(CLI::App& app, CalibrateLine& options) {
    addOption(app, "renderer", options.renderer, "FILE.json", "file that gives the renderer's command")
        ->expected(1)
        ->required();
    addFiles(app, options, "not accepted: calibrate writes no file; use --json");
    addOutput(app, options);
}

// The renderer's image of the charts under one lamp type. A missing image is an error without a lamp;
// under a lamp it means that the renderer does not support that type.
external::LampFrame shownUnder(const Scene& charts, external::Lamp lamp,
                               const external::ExternalRenderer& renderer) {
    external::LampFrame shown{lamp, external::referenceUnder(charts, lamp), {}, {}};
    const Scene scene = external::chartsUnder(charts, lamp);
    Settings settings = external::chartSettings(lamp);
    SceneViews views(scene);
    external::Attempt attempt =
        external::drawExternally(renderer, scene, views.at(viewRequest(settings)), settings);
    if (attempt.frame && attempt.frame->channels.contains(Channel::lit))
        shown.image = std::move(attempt.frame->channels.at(Channel::lit));
    else
        shown.problem = attempt.frame ? "its picture has no R, G, B" : attempt.problem;
    if (lamp == external::Lamp::none && shown.image.empty())
        refuse("renderer {}: {}", renderer.file.string(), shown.problem);
    return shown;
}

int runCalibrate(const CalibrateLine& options) {
    refuseOut(options, "calibrate");
    const external::ExternalRenderer renderer = external::readRendererFile(options.renderer.front());
    Progress progress(progressOutput(options));
    const Stage stage(progress, "calibrate");
    const Scene charts = loadScene("builtin:calibration");
    std::vector<external::LampFrame> images;
    for (const external::Lamp lamp : external::lamps) {
        const double done =
            static_cast<double>(images.size()) / static_cast<double>(std::size(external::lamps));
        stage.at(done, fmt::format("charts under {}", external::nameOf(lamp)));
        images.push_back(shownUnder(charts, lamp, renderer));
    }
    const std::vector<external::Deviation> deviations = external::deviationsOf(charts, images);
    progress.wipe();
    printResult(options, jsonText(external::toJson(renderer, deviations)) + "\n",
                external::describe(renderer, deviations));
    return exitCode(deviations.empty());
}

}  // namespace

Command calibrateCommand() {
    return makeCommand<CalibrateLine>(
        {"calibrate", "Finds how another renderer interprets its inputs, from charts with a known result",
         "diptych calibrate three.json"},
        describeCalibrate, [](CalibrateLine& options) { refuseLineBreaks(options.renderer); }, runCalibrate);
}

}  // namespace diptych::cli
