// SPDX-License-Identifier: MIT
#include "compare/cli/commands.h"
#include "compare/external/calibration.h"
#include "compare/external/external_frame.h"
#include "compare/run/print.h"
#include "shared/contract/debug_mode.h"
#include "shared/scene/load.h"
#include "shared/text/json_text.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <stdexcept>

namespace diptych::cli {

namespace {

using Json = nlohmann::ordered_json;

// The renderer's image of the charts under one lamp type. A missing image is an error without a lamp;
// under a lamp it means that the renderer does not support that type.
external::Shown shownUnder(const Scene& charts, external::Lamp lamp, const external::Renderer& renderer) {
    external::Shown shown{lamp, external::referenceUnder(charts, lamp), {}, {}};
    const Scene scene = external::chartsUnder(charts, lamp);
    Settings settings = external::chartSettings(lamp);
    SceneViews views(scene);
    external::Attempt attempt =
        external::drawExternally(renderer, scene, views.at(viewRequest(settings)), settings);
    if (attempt.frame && attempt.frame->channels.contains(Channel::lit))
        shown.picture = std::move(attempt.frame->channels.at(Channel::lit));
    else
        shown.problem = attempt.frame ? "its picture has no R, G, B" : attempt.problem;
    if (lamp == external::Lamp::none && shown.picture.empty())
        throw std::runtime_error(fmt::format("renderer {}: {}", renderer.file.string(), shown.problem));
    return shown;
}

Json correctionsOf(const std::vector<external::Deviation>& deviations) {
    Json corrections = Json::object();
    for (const external::Deviation& deviation : deviations) corrections.update(deviation.correction);
    return corrections;
}

}  // namespace

int runCalibrate(const Options& options) {
    refuseOut(options);
    const external::Renderer renderer = external::readRendererFile(options.scenes.front());
    const std::vector<std::string> corrections = external::inWords(renderer.corrections);
    Progress progress(progressOutput(options));
    const Stage stage(progress, "calibrate");
    const Scene charts = loadScene("builtin:calibration");
    std::vector<external::Shown> pictures;
    for (const external::Lamp lamp : external::lamps) {
        const double done =
            static_cast<double>(pictures.size()) / static_cast<double>(std::size(external::lamps));
        stage.at(done, fmt::format("charts under {}", external::nameOf(lamp)));
        pictures.push_back(shownUnder(charts, lamp, renderer));
    }
    const std::vector<external::Deviation> deviations = external::deviationsOf(charts, pictures);
    progress.wipe();
    const Json corrections_found = correctionsOf(deviations);
    if (options.json) {
        Json json{{"schema", 1},
                  {"renderer", renderer.file.string()},
                  {"verdict", deviations.empty() ? "pass" : "fail"},
                  {"granted_already", corrections},
                  {"deviations", Json::array()},
                  {"granted", corrections_found}};
        for (const external::Deviation& one : deviations)
            json["deviations"].push_back(
                {{"name", one.name}, {"words", one.words}, {"grant", one.correction}});
        printOut("{}\n", jsonText(json));
    } else if (!options.quiet) {
        std::string out;
        for (const std::string& line : corrections) out += fmt::format("granted {}\n", line);
        for (const external::Deviation& one : deviations)
            out += fmt::format("FAIL {}: {}{}\n", one.name, one.words,
                               one.correction.empty() ? "; no input correction exists for it" : "");
        if (deviations.empty()) out += "pass: it interprets its inputs as Diptych does\n";
        if (!corrections_found.empty())
            out += fmt::format(
                "to correct its inputs, add to {}{}: \"granted\": {}\n", renderer.file.string(),
                corrections.empty() ? ""
                                    : ", on top of the present \"granted\" (factors multiply, offsets add)",
                corrections_found.dump());
        printColored(options, out);
    }
    return deviations.empty() ? 0 : 1;
}

}  // namespace diptych::cli
