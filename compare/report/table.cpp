// SPDX-License-Identifier: MIT
// Terminal output of a report.
#include "compare/output/writers.h"
#include "compare/report/channel_table.h"
#include "compare/report/report.h"
#include "compare/report/titles.h"
#include "shared/text/counted.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace diptych {

using page::number;

namespace {

// How much the encoding explains, after a lit channel's criterion.
std::string explainedLine(const ChannelDiff& channel) {
    if (!channel.unexplained_pixels || channel.stats.max == 0 || channel.verdict == Verdict::fail) return {};
    std::string line = fmt::format("  {}: explained by the encoding: largest error {}, mean {}",
                                   channel.mode->name, number(channel.stats.max), number(channel.stats.mean));
    if (channel.flip) line += fmt::format(", FLIP {}", number(*channel.flip));
    if (channel.encoding_use)
        line += fmt::format(", at most {} of a pixel's bound", percentText(channel.encoding_use->used));
    return line + "\n";
}

std::string frameLine(const Frame& frame) {
    if (!frame.origin.file.empty()) return fmt::format("  {}: {}\n", frame.name, frame.origin.file);
    if (isReference(frame.settings.path))
        return fmt::format("  {}: double precision, mode {}, rendered in {:.3g} s\n", frame.name,
                           nameOf(frame.settings.reference_mode), frame.made_in_ms / 1000);
    std::string line = "  " + frame.name;
    if (frame.time.runs > 0)
        line += fmt::format(": {:.4g} ms ({:.4g} to {:.4g}, {})", frame.time.median, frame.time.min,
                            frame.time.max, counted(frame.time.runs, "run"));
    if (frame.time.object_lists > 0)
        line +=
            fmt::format(", {:.3g} ms on the host to choose each object's lights", frame.time.object_lists);
    if (!frame.origin.device.empty())
        line += fmt::format(", on {}, {}", frame.origin.device, frame.origin.driver);
    return line + fmt::format(", {} bytes per pixel of {}\n", frame.bytes.gbuffer_per_pixel,
                              hasGBuffer(frame.settings.path) ? "G-buffer and depth" : "depth");
}

// Notes below all tables, each once with its scenes.
std::string notesText(const Report& report) {
    std::set<std::string> scenes;
    for (const Comparison& comparison : report.comparisons) scenes.insert(report.baseline(comparison).scene);
    std::string out;
    for (const GroupedNote& note : groupedNotes(report)) {
        const std::string about = scenes.size() == 1 ? ""
                                  : note.scenes.size() == scenes.size()
                                      ? fmt::format(", {} scenes", scenes.size())
                                      : ", " + listed(note.scenes, 3);
        out += fmt::format("note{}{}: {}\n", about, note.varies ? ", with different numbers" : "", note.text);
    }
    return out;
}

}  // namespace

std::string comparisonTable(const Report& report, const Comparison& comparison) {
    std::string out;
    const Frame &baseline = report.baseline(comparison), &test = report.test(comparison);
    out += fmt::format("{}, {}, {}x{}: {}\n", baseline.scene, viewTitle(report, baseline),
                       baseline.settings.size.width, baseline.settings.size.height,
                       pairTitle(report, comparison));
    out += frameLine(baseline) + frameLine(test);
    out += inText(channelTable(comparison, ""));
    for (const ChannelDiff& channel : comparison.channels) out += explainedLine(channel);
    for (const auto& [figure, meaning] :
         {std::pair{"excess",
                    "the error minus the reference's uncertainty and the G-buffer's quantization bound"},
          {"pixels unexplained", "pixels whose difference the G-buffer's encoding does not explain"}})
        if (std::ranges::any_of(comparison.channels, [&, word = figure](const ChannelDiff& channel) {
                return channel.criterion && channel.criterion->figure.find(word) != std::string::npos;
            }))
            out += fmt::format("  {}: {}\n", figure, meaning);
    const std::string place = placeOf(report, comparison);
    for (const std::string& failure : comparison.failures)
        out += fmt::format("  FAIL {}: {}\n", place, failure);
    for (const ChannelDiff& channel : comparison.channels)
        if (channel.verdict == Verdict::fail) {
            out += fmt::format("  FAIL {}, {}: {}", place, channel.mode->name, channel.reason);
            if (channel.stats.worst_x >= 0)
                out += fmt::format(", worst at {},{}", channel.stats.worst_x, channel.stats.worst_y);
            out += fmt::format(" ({}{}{})\n", channel.rule, channel.rule.empty() ? "" : ", because ",
                               channel.tolerance.because);
        }
    if (comparison.explained) out += inText(comparison.explained->blocks);
    for (const ChannelDiff& channel : comparison.channels)
        if (!channel.rule.empty() && channel.verdict == Verdict::pass)
            out += fmt::format("  {}: {}\n", channel.mode->name, channel.rule);
    for (const ChannelDiff& channel : comparison.channels)
        if (!channel.warning.empty())
            out += fmt::format("  warning {}, {}: {} ({})\n", place, channel.mode->name, channel.warning,
                               channel.rule);
    if (const std::string checks = checksLine(comparison); !checks.empty()) out += "  " + checks + "\n";
    return out;
}

std::string closerTable(const Report& report, const CloserPath& closer, bool several) {
    std::string out;
    if (several)
        out += fmt::format("{}, {}:\n", report.frames[closer.reference].scene,
                           viewTitle(report, report.frames[closer.reference]));
    for (const CloserPathChannel& channel : closer.channels)
        out += closerPathLine(closer, channel, report.frames) + "\n";
    return out;
}

std::string tableEnd(const Report& report) {
    std::string out;
    for (const SceneError& error : report.errors) out += fmt::format("ERROR {}\n", errorText(error));
    return out + notesText(report) + verdictLine(report) + "\n";
}

std::string reportTable(const Report& report) {
    std::string out;
    for (const std::string& line : report.first_notes) out += line + "\n";
    for (const Comparison& comparison : report.comparisons) out += comparisonTable(report, comparison);
    for (const CloserPath& closer : report.closer_paths)
        out += closerTable(report, closer, report.closer_paths.size() > 1);
    return out + tableEnd(report);
}

}  // namespace diptych
