// SPDX-License-Identifier: MIT
#include "compare/cli/command_compare.h"
#include "compare/explain/pixel_breakdown.h"
#include "compare/output/writers.h"
#include "shared/text/json_text.h"

#include <fmt/format.h>

namespace diptych::cli {

namespace {

// Throws for options that a pixel breakdown does not support.
void checkOnePixel(const CompareLine& options) {
    const auto [x, y] = *options.pixel;
    const std::string pixel = fmt::format("--pixel {},{}", x, y);
    if (options.scenes.size() != 1)
        refuse("{}: takes one scene, and {} are given; run it once for each", pixel, options.scenes.size());
    if (options.cameras.size() != 1 || options.times.size() != 1)
        refuse("{}: takes one view; give one --camera and one --time, or run it once for each", pixel);
    if (isReference(options.baseline) || !options.baseline_file.empty())
        refuse(
            "--baseline {}: {} compares the two paths and shows the reference beside them; use "
            "deferred or forward_plus",
            options.baseline_file.empty() ? "reference" : options.baseline_file.string(), pixel);
    const Size& size = options.settings.size;
    if (x >= size.width || y >= size.height)
        refuse("{}: is outside the image (pixels 0,0 to {},{}); --size sets its size", pixel, size.width - 1,
               size.height - 1);
    if (!options.out.empty())
        refuse("-o {}: --pixel writes no file; use compare --pixel {},{} --json > FILE", options.out.string(),
               x, y);
}

}  // namespace

int runPixel(const CompareLine& options) {
    checkOnePixel(options);
    const Path test = otherPath(options.baseline);
    const std::vector<Settings> settings = settingsOf(options, {Path::reference, options.baseline, test});
    const CompareOptions compare = compareOptions(options);
    if (options.selection.any())
        note(options, "--mask, --ids, --ignore-edges and --crop are not used: --pixel selects the pixel");
    if (!options.channels.empty()) note(options, "--channels is not used: --pixel prints every channel");
    const std::string& where = options.scenes.front();
    Progress progress(progressOutput(options));
    const Stage stage(progress, where);
    const Scene scene = loadSceneWithSettings(where, options.settings, stage.part(0, 0.1));
    Device device(deviceOptions(options));
    logVerbose(options, "on " + device.info().name);
    SceneViews views(scene);
    Renderer renderer(device, views);
    const std::vector<Rule> rules = rulesOfScene(compare.rules, where);
    const PixelBreakdown breakdown = pixelBreakdown(renderer, views,
                                                    {.x = options.pixel->x,
                                                     .y = options.pixel->y,
                                                     .baseline = settings[1],
                                                     .test = settings[2],
                                                     .reference = settings[0],
                                                     .device = reportDevice(device),
                                                     .rules = rules,
                                                     .light_differs = compare.light_differs,
                                                     .progress = stage.part(0.1, 1)});
    checkValidation(device);
    wipeProgress();
    printResult(options, jsonText(toJson(breakdown)) + "\n", inText(blocksOf(breakdown)));
    return 0;
}

}  // namespace diptych::cli
