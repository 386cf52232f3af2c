// SPDX-License-Identifier: MIT
#include "compare/commands.h"
#include "compare/report/report.h"
#include "shared/contract/debug_mode.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <stdexcept>
#include <utility>

namespace diptych {
namespace {

std::filesystem::path reportFolder(const Options& options) {
    const Output output = outputOf(options.out.empty() ? "diptych-report" : options.out);
    if (output.kind != OutputKind::folder)
        throw std::runtime_error(
            fmt::format("-o {}: a report is a folder; give a name without ending", output.path.string()));
    checkReplaceable(output, "report.json", options.force);
    return output.path;
}

}  // namespace

int runCompare(const Options& options) {
    const std::vector<Settings> settings = plan(options, {Path::deferred, Path::forward_plus});
    const std::filesystem::path folder = reportFolder(options);
    if (options.path_given) note(options, "--path is not used: compare draws both");
    if (options.debug_given) note(options, "--debug is not used: the report shows every channel");
    RenderOptions render = renderOptions(options);
    render.through_gbuffer = true;

    // which tells the background, and that is outside every mean
    constexpr auto background = static_cast<int>(gpu::DEBUG_material_id);
    if (std::ranges::count(render.channels, background) == 0) render.channels.push_back(background);

    Device device(deviceOptions(options));
    say(options, "on " + device.info().name);
    std::vector<Frame> frames;
    std::vector<Requirements> needs;
    std::vector<std::vector<FeatureMarks>> marks;  // per pair of frames
    for (const std::string& name : options.scenes) {
        say(options, name);
        const Scene scene = loadShown(options, name);
        needs.insert(needs.end(), settings.size(), needsOf(scene, options.settings));
        std::vector<Frame> drawn = renderAll(device, scene, settings, render);
        for (std::size_t i = 0; i < drawn.size(); i += 2) marks.push_back(marksOf(scene, drawn[i]));
        std::ranges::move(drawn, std::back_inserter(frames));
    }
    checkValidation(device);

    const Report report =
        makeReport(std::move(frames), needs, reportDevice(device), options.baseline, std::move(marks));
    const std::string json =
        writeReport(report, folder, {options.picture, options.single_file, options.force});
    if (options.json)
        fmt::print("{}", json);
    else if (!options.quiet)
        fmt::print("{}report: {}\n", reportTable(report), (folder / "index.html").string());
    return report.passed() ? 0 : 1;
}

}  // namespace diptych
