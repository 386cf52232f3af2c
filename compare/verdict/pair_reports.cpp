// SPDX-License-Identifier: MIT
#include "compare/verdict/pair_reports.h"

#include "compare/frames/frame_properties.h"
#include "compare/reference/reference.h"
#include "compare/run/command_text.h"
#include "compare/run/progress.h"
#include "compare/verdict/encoding_bits.h"
#include "compare/verdict/footprint.h"
#include "compare/verdict/surface_pixels.h"
#include "shared/contract/debug_mode.h"
#include "shared/text/counted.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <iterator>
#include <utility>

namespace diptych {

RenderOptions evaluatedOptions(RenderOptions render, std::span<const Settings> settings, bool traced,
                               bool across, Twice twice) {
    render.through_gbuffer = true;
    render.twice = twice;
    render.environment_errors = true;
    // Additional channels: material_id excludes the background from every mean; others decide how light is
    // compared.
    std::vector<Channel> helpers{Channel::material_id};
    if (traced) helpers = footprintChannels();
    if (across) {
        helpers = surfacePixelChannels();
        helpers.insert(helpers.end(), surfaceChannels().begin(), surfaceChannels().end());
        // The shadow filter's radius at a pixel depends on the last two.
        helpers.insert(helpers.end(), {Channel::texcoords, Channel::lightmapped, Channel::shadow_visibility,
                                       Channel::local_visibility});
    }
    // Light is compared by the fields from which it is computed (lightingFields()).
    const bool shadows =
        std::ranges::any_of(settings, [](const Settings& of) { return of.shadows != Shadows::off; });
    if (std::ranges::any_of(render.channels, isLit) && std::ranges::any_of(settings, isPacked))
        std::ranges::copy_if(lightingFields(), std::back_inserter(helpers), [&](Channel channel) {
            return shadows || channel != Channel::geometric_normal;
        });
    render.every_sample.assign(lightingFields().begin(), lightingFields().end());
    if (shadows) helpers.insert(helpers.end(), {Channel::depth, Channel::cascade, Channel::page_residency});
    for (const Channel channel : helpers)
        if (std::ranges::count(render.channels, channel) == 0) render.channels.push_back(channel);
    return render;
}

namespace {

// A stored Frame of forward+ lacks the images that show the G-buffer's encoding (`through_gbuffer`), which
// explain differences of deferred. It gets those of the forward+ Frame rendered now, in the channels where
// both show the same image. Differences in its other channels stay unexplained.
void explainAsNow(Frame& baseline, const std::vector<Frame>& frames, bool cpu) {
    if (!shadesFragments(baseline.settings.path)) return;
    for (const Frame& frame : frames)
        for (const auto& [channel, through] : frame.through_gbuffer) {
            const Image *then = findChannel(baseline, channel), *now = findChannel(frame, channel);
            if (then && now && then->width == now->width && then->height == now->height &&
                unequalPixels(*then, *now, cpu ? 0 : gpuUlps) == 0)
                baseline.through_gbuffer[channel] = through;
        }
}

using ByPath = std::map<Path, std::size_t>;  // indices of a view's Frames in Report::frames

std::size_t addFrame(Report& report, Frame& frame) {
    report.frames.push_back(std::move(frame));
    return report.frames.size() - 1;
}
ByPath addFrames(Report& report, std::vector<Frame>& frames) {
    ByPath indices;
    for (Frame& frame : frames) indices.emplace(frame.settings.path, addFrame(report, frame));
    return indices;
}

// A comparison to make, with indices in Report::frames.
struct Planned {
    ViewFrames* view;
    std::size_t baseline, test;
    std::size_t panel;  // the left panel: of a path, the reference or an earlier Frame
    std::size_t shown;  // the Frame with the Settings of the comparison's command
    const AcrossDevices* across = nullptr;
    bool inspected = false;  // whether it has the view's visual checks, and its closer path
};

// The command line that repeats a comparison.
std::vector<std::string> commandOf(const Frame& shown, const Frame& panel,
                                   const std::vector<std::string>& words) {
    const bool drawn = panel.origin.file.empty();  // else `words` have the file
    const Settings settings =
        drawn && isReferenceFrame(panel) ? withReferenceOf(shown.settings, panel.settings) : shown.settings;
    std::vector<std::string> command =
        withArguments(commandArguments("compare", shown.scene, settings), words);
    if (!drawn || hasGBuffer(panel.settings.path)) return command;
    return withOption(command, "--baseline", std::string(nameOf(panel.settings.path)));
}

void compareAll(Report& report, const std::vector<Planned>& pairs, const CompareOptions& options) {
    const auto start = std::chrono::steady_clock::now();
    const auto all = static_cast<double>(pairs.size());
    for (const Planned& pair : pairs) {
        CompareOptions here = options;
        here.across = pair.across;
        const auto done = static_cast<double>(report.comparisons.size());
        here.progress =
            options.progress.part(done / all, (done + 1) / all).about(report.frames[pair.shown].scene);
        Comparison& comparison = report.comparisons.emplace_back(
            compareFrames(report, pair.baseline, pair.test, pair.view->needs, here));
        const Frame &shown = report.frames[pair.shown], &panel = report.frames[pair.panel];
        std::vector<std::string> words = options.words;
        if (shown.origin.external)
            words.insert(words.end(), options.renderer_texts.begin(), options.renderer_texts.end());
        comparison.command = commandOf(shown, panel, words);
        if (!pair.inspected) continue;
        comparison.visual_checks = std::move(pair.view->checks);
        if (isReferenceFrame(panel))
            report.closer_paths.push_back(closerPathOf(report.frames, pair.panel, {pair.baseline, pair.test},
                                                       comparison.coverage, pair.view->materials));
    }
    report.diff_ms = msSince(start);
}

}  // namespace

const Frame* ViewFrames::by(Path path) const {
    const auto found =
        std::ranges::find(frames, path, [](const Frame& frame) { return frame.settings.path; });
    return found == frames.end() ? nullptr : &*found;
}

Report makeReport(std::vector<ViewFrames> views, ReportDevice device, const CompareOptions& options,
                  std::optional<Frame> earlier, ReportDevice against) {
    Report report;
    report.device = std::move(device);
    report.against = std::move(against);
    if (earlier) {
        explainAsNow(*earlier, views.front().frames, report.device.bitExact());
        report.frames.push_back(std::move(*earlier));
    }
    std::vector<std::array<ByPath, 2>> indices;  // of each view, here and on the other device
    for (ViewFrames& view : views)
        indices.push_back({addFrames(report, view.frames), addFrames(report, view.there)});
    std::vector<Planned> pairs, external;
    for (std::size_t i = 0; i < views.size(); ++i) {
        ViewFrames& view = views[i];
        const auto& [here, there] = indices[i];
        const auto reference = here.find(Path::reference);
        const bool byPath = !earlier && reference == here.end();  // whether a path is the left panel
        const Path left = byPath ? options.baseline : drawn_paths[0], right = otherPath(left);
        const std::size_t panel = earlier ? 0 : byPath ? here.at(left) : reference->second;
        if (!byPath)
            for (const Path path : drawn_paths)
                pairs.push_back({&view, panel, here.at(path), panel, here.at(path)});
        pairs.push_back({&view, here.at(left), here.at(right), panel, byPath ? panel : here.at(right),
                         nullptr, !earlier});
        for (const auto& [path, index] : there) {
            AcrossDevices& across = view.across.at(path);
            for (const std::size_t k : {0, 1})
                across.texcoords.at(k) =
                    findChannel(report.frames[indices[i][k].at(unencoded_path)], Channel::texcoords);
            pairs.push_back({&view, here.at(path), index, panel, panel, &across});
        }
        if (!there.empty()) pairs.push_back({&view, there.at(left), there.at(right), panel, panel});
        for (Frame& frame : view.external) {
            showOurBackground(frame, report.frames[panel]);
            const std::size_t index = addFrame(report, frame);
            external.push_back({&view, panel, index, panel, index});
        }
    }
    pairs.insert(pairs.end(), external.begin(), external.end());
    compareAll(report, pairs, options);
    return report;
}

void showOurBackground(Frame& external, const Frame& ours) {
    if (external.settings.size != ours.settings.size) return;
    const Coverage covered = coverage(ours, ours);
    if (!covered.known) return;
    for (const auto& [channel, image] : external.channels) external.requested.push_back(channel);
    std::size_t shown = 0;  // pixels of lit
    for (auto& [channel, image] : external.channels) {
        const Image* const other = findChannel(ours, channel);
        if (!other || other->pixels() != image.pixels() || other->components != image.components) continue;
        for (std::size_t i = 0; i < image.pixels(); ++i) {
            if (covered.covered[i]) continue;
            float* const here = image.pixel(i);
            if (channel == Channel::lit)
                shown += std::any_of(here, here + image.components, [](float v) { return v != 0; });
            std::copy_n(other->pixel(i), image.components, here);
        }
    }
    for (const Channel channel : {Channel::material_id, Channel::depth})
        if (const Image* const found = findChannel(ours, channel))
            external.channels.try_emplace(channel, *found);
    if (shown > 0)
        external.notes.push_back(
            fmt::format("{} is not black at {} where {} shows no surface: a background or shifted edges; "
                        "these pixels are not compared",
                        external.name, counted(shown, "pixel"), ours.name));
}

}  // namespace diptych
