// SPDX-License-Identifier: MIT
#include "compare/verdict/pair_reports.h"

#include "compare/frames/frame_facts.h"
#include "compare/reference/reference.h"
#include "compare/run/command_text.h"
#include "compare/verdict/encoding_bits.h"
#include "compare/verdict/encoding_use.h"
#include "compare/verdict/footprint.h"
#include "compare/verdict/neighbours.h"
#include "compare/verdict/surface_pixels.h"
#include "compare/verdict/tolerance.h"
#include "shared/contract/debug_mode.h"
#include "shared/text/counted.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <iterator>
#include <utility>

namespace diptych {

RenderOptions judgedOptions(RenderOptions render, std::span<const Settings> settings, bool traced,
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
        helpers.push_back(Channel::texcoords);
        helpers.push_back(Channel::lightmapped);
    }
    // The shadow filter's radius at a pixel depends on these.
    if (across)
        for (const Channel mode : {Channel::shadow_visibility, Channel::local_visibility})
            helpers.push_back(mode);
    // Light is compared by the fields from which it is computed (lightingFields()).
    const auto packed = [](const Settings& of) {
        return hasGBuffer(of.path) && of.gbuffer != GBufferEncoding::full;
    };
    const bool shadows =
        std::ranges::any_of(settings, [](const Settings& of) { return of.shadows != Shadows::off; });
    if (std::ranges::any_of(render.channels, isLit) && std::ranges::any_of(settings, packed))
        std::ranges::copy_if(lightingFields(), std::back_inserter(helpers),
                             [&](Channel mode) { return shadows || mode != Channel::geometric_normal; });
    render.every_sample.assign(lightingFields().begin(), lightingFields().end());
    if (shadows)
        for (const Channel mode : {Channel::depth, Channel::cascade, Channel::page_residency})
            helpers.push_back(mode);
    for (const Channel mode : helpers)
        if (std::ranges::count(render.channels, mode) == 0) render.channels.push_back(mode);
    return render;
}

Report makeReport(std::vector<Frame> frames, const std::vector<Requirements>& needs, ReportDevice device,
                  const CompareOptions& options, std::vector<std::vector<FeatureChecks>> checks) {
    const auto start = std::chrono::steady_clock::now();
    Report report;
    report.device = std::move(device);
    report.frames = std::move(frames);
    for (std::size_t i = 0; i + 1 < report.frames.size(); i += 2) {
        const bool swapped = report.frames[i + 1].settings.path == options.baseline;
        CompareOptions here = options;
        const auto all = static_cast<double>(report.frames.size() / 2 * 2), done = static_cast<double>(i);
        here.progress = options.progress.part(done / all, (done + 2) / all).about(report.frames[i].scene);
        report.comparisons.push_back(compareFrames(report, i + swapped, i + !swapped, needs.at(i), here));
        const Frame& left = report.baseline(report.comparisons.back());
        std::vector<std::string> command =
            withWords(commandWords("compare", left.scene, left.settings), options.words);
        if (!hasGBuffer(options.baseline))
            command = withOption(command, "--baseline", std::string(nameOf(options.baseline)));
        report.comparisons.back().command = std::move(command);
        if (!checks.empty()) report.comparisons.back().visual_checks = std::move(checks.at(i / 2));
    }
    report.diff_ms =
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    return report;
}

Report makeReferenceReport(std::vector<Frame> frames, const std::vector<Requirements>& needs,
                           ReportDevice device, const CompareOptions& options,
                           std::vector<std::vector<FeatureChecks>> checks,
                           const std::vector<std::vector<std::string>>& materials) {
    const auto start = std::chrono::steady_clock::now();
    Report report;
    report.device = std::move(device);
    report.frames = std::move(frames);
    for (std::size_t i = 0; i + 2 < report.frames.size(); i += 3) {
        const auto all = static_cast<double>(report.frames.size());
        int pairs = 0;
        for (const auto& [left, right] : {std::pair{i, i + 1}, {i, i + 2}, {i + 1, i + 2}}) {
            CompareOptions here = options;
            const double done = static_cast<double>(i) + pairs++;
            here.progress = options.progress.part(done / all, (done + 1) / all).about(report.frames[i].scene);
            report.comparisons.push_back(compareFrames(report, left, right, needs.at(i), here));
            const Frame& reference = report.frames[i];
            const Settings settings = withReferenceOf(report.frames[right].settings, reference.settings);
            report.comparisons.back().command =
                withOption(withWords(commandWords("compare", reference.scene, settings), options.words),
                           "--baseline", "reference");
        }
        Comparison& between = report.comparisons.back();
        if (!checks.empty()) between.visual_checks = std::move(checks.at(i / 3));
        report.closer_paths.push_back(
            closerPathOf(report.frames, i, {i + 1, i + 2}, between.coverage, materials.at(i / 3)));
    }
    report.diff_ms =
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    return report;
}

Report makeDeviceReport(std::vector<Frame> frames, const std::vector<Requirements>& needs,
                        std::array<ReportDevice, 2> devices, const CompareOptions& options,
                        std::vector<AcrossDevices> across, std::vector<std::vector<FeatureChecks>> checks) {
    const auto start = std::chrono::steady_clock::now();
    Report report;
    report.device = std::move(devices[0]);
    report.against = std::move(devices[1]);
    report.frames = std::move(frames);
    const auto all = static_cast<double>(report.frames.size());
    double done = 0;
    for (std::size_t i = 0; i + 3 < report.frames.size(); i += 4) {
        const std::size_t view = i / 4;
        const std::size_t left = shadesFragments(options.baseline) ? 1 : 0;
        for (std::size_t path = 0; path < 2; ++path)
            across.at(2 * view + path).texcoords = {findChannel(report.frames[i + 1], Channel::texcoords),
                                                    findChannel(report.frames[i + 3], Channel::texcoords)};
        struct Pair {
            std::size_t baseline, test;
            const AcrossDevices* across;
        };
        for (const Pair& pair : {Pair{i + left, i + 1 - left, nullptr},
                                 {i, i + 2, &across.at(2 * view)},
                                 {i + 1, i + 3, &across.at(2 * view + 1)},
                                 {i + 2 + left, i + 3 - left, nullptr}}) {
            CompareOptions here = options;
            here.across = pair.across;
            here.progress = options.progress.part(done / all, (done + 1) / all).about(report.frames[i].scene);
            ++done;
            report.comparisons.push_back(
                compareFrames(report, pair.baseline, pair.test, needs.at(2 * view), here));
            const Frame& of = report.frames[i];
            report.comparisons.back().command =
                withWords(commandWords("compare", of.scene, of.settings), options.words);
            if (!hasGBuffer(options.baseline))
                report.comparisons.back().command = withOption(
                    report.comparisons.back().command, "--baseline", std::string(nameOf(options.baseline)));
        }
        if (!checks.empty())
            report.comparisons.at(report.comparisons.size() - 4).visual_checks = std::move(checks.at(view));
    }
    report.diff_ms =
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    return report;
}

namespace {

// An earlier Frame of forward+ has no images through the G-buffer. The new forward+ Frame's images replace
// them, but only in channels where forward+ still renders the same image. In other channels no difference
// is explained.
void explainAsNow(Frame& baseline, const std::vector<Frame>& frames, bool cpu) {
    if (!shadesFragments(baseline.settings.path)) return;
    for (const Frame& frame : frames)
        for (const auto& [mode, through] : frame.through_gbuffer) {
            const auto then = std::as_const(baseline).channels.find(mode), now = frame.channels.find(mode);
            if (then != baseline.channels.end() && now != frame.channels.end() &&
                then->second.width == now->second.width && then->second.height == now->second.height &&
                unequalPixels(then->second, now->second, cpu ? 0 : gpuUlps) == 0) {
                baseline.through_gbuffer[mode] = through;
            }
        }
}

}  // namespace

Report makeBaselineReport(Frame baseline, std::vector<Frame> frames, const Requirements& needs,
                          ReportDevice device, const CompareOptions& options,
                          const std::vector<std::string>& mismatches) {
    const auto start = std::chrono::steady_clock::now();
    Report report;
    report.device = std::move(device);
    report.frames.push_back(std::move(baseline));
    std::ranges::move(frames, std::back_inserter(report.frames));
    explainAsNow(report.frames[0], report.frames, report.device.bitExact());
    for (const auto& [left, right] : {std::pair<std::size_t, std::size_t>{0, 1}, {0, 2}, {1, 2}}) {
        CompareOptions here = options;
        const auto done = static_cast<double>(report.comparisons.size());
        here.progress = options.progress.part(done / 3, (done + 1) / 3);
        report.comparisons.push_back(compareFrames(report, left, right, needs, here));
        const Frame& drawn = report.test(report.comparisons.back());
        report.comparisons.back().command =
            withWords(commandWords("compare", drawn.scene, drawn.settings), options.words);
    }
    report.first_notes = mismatches;
    report.diff_ms =
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    return report;
}

void showOurBackground(Frame& external, const Frame& ours) {
    if (external.settings.size != ours.settings.size) return;
    const Coverage covered = coverage(ours, ours);
    if (!covered.known) return;
    for (const auto& [mode, image] : external.channels) external.requested.push_back(mode);
    std::size_t shown = 0;  // pixels of lit
    for (auto& [mode, image] : external.channels) {
        const auto other = ours.channels.find(mode);
        if (other == ours.channels.end() || other->second.pixels() != image.pixels() ||
            other->second.components != image.components)
            continue;
        for (std::size_t i = 0; i < image.pixels(); ++i) {
            if (covered.covered[i]) continue;
            float* const here = image.pixel(i);
            if (mode == Channel::lit)
                shown += std::any_of(here, here + image.components, [](float v) { return v != 0; });
            std::copy_n(other->second.pixel(i), image.components, here);
        }
    }
    for (const Channel mode : {Channel::material_id, Channel::depth})
        if (const auto found = ours.channels.find(mode); found != ours.channels.end())
            external.channels.try_emplace(mode, found->second);
    if (shown > 0)
        external.notes.push_back(
            fmt::format("{} is not black at {} where {} shows no surface: a background or shifted edges; "
                        "these pixels are not compared",
                        external.name, counted(shown, "pixel"), ours.name));
}

void addExternalPictures(Report& report, std::vector<ExternalPicture> pictures,
                         const CompareOptions& options) {
    const auto start = std::chrono::steady_clock::now();
    const auto all = static_cast<double>(pictures.size());
    double done = 0;
    for (ExternalPicture& picture : pictures) {
        CompareOptions here = options;
        here.progress = options.progress.part(done / all, (done + 1) / all).about(picture.frame.scene);
        ++done;
        showOurBackground(picture.frame, report.frames.at(picture.baseline));
        report.frames.push_back(std::move(picture.frame));
        report.comparisons.push_back(
            compareFrames(report, picture.baseline, report.frames.size() - 1, picture.needs, here));
        Comparison& comparison = report.comparisons.back();
        const Frame& left = report.baseline(comparison);
        Settings settings = report.test(comparison).settings;
        settings.path = Settings().path;
        if (isReferenceFrame(left)) settings = withReferenceOf(settings, left.settings);
        comparison.command = withWords(
            withWords(commandWords("compare", report.test(comparison).scene, settings), picture.words),
            options.words);
        if (!left.origin.file.empty())
            comparison.command = withOption(comparison.command, "--baseline", left.origin.file);
        else if (!hasGBuffer(left.settings.path))
            comparison.command =
                withOption(comparison.command, "--baseline", std::string(nameOf(left.settings.path)));
    }
    report.diff_ms +=
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace diptych
