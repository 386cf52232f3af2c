// SPDX-License-Identifier: MIT
// The report on a terminal.
#include "compare/report/report.h"
#include "compare/report/titles.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

namespace diptych {

using page::cameraTitle;
using page::number;

namespace {

using TableRow = std::array<std::string, 7>;

// Where the encoding's effect is bounded for each pixel, the tolerance is the largest bound, and the error at
// another pixel says little beside it, so the outcome is shown instead.
std::string toleranceOf(const ChannelDiff& channel) {
    if (!channel.rule.empty() && !std::isfinite(channel.tolerance.max)) return "rule";
    if (const auto& f = channel.footprints) {
        const auto all = static_cast<double>(f->smooth + f->detailed + f->edges);
        return fmt::format("tight {:.0f} %", all > 0 ? 100 * static_cast<double>(f->smooth) / all : 100);
    }
    if (!channel.unexplained_pixels) return number(channel.tolerance.max);
    if (*channel.unexplained_pixels > 0) return fmt::format("{} px left", *channel.unexplained_pixels);
    if (const auto& use = channel.encoding_use; use && use->beyond > 0)
        return fmt::format("{:.3g} x bits", use->used);
    return "explained";
}

TableRow rowOf(const ChannelDiff& channel) {
    const std::string verdict(channel.verdict == Verdict::fail ? "FAIL" : nameOf(channel.verdict));
    const std::string name(channel.mode->name), metric(nameOf(channel.mode->metric));
    if (channel.verdict == Verdict::forward_only) return {name, metric, "-", "-", "-", "-", verdict};
    const ChannelStats& s = channel.stats;
    return {name, metric, number(s.max), number(s.mean), number(s.p999), toleranceOf(channel), verdict};
}

std::string frameLine(const Frame& frame) {
    if (!frame.origin.file.empty()) return fmt::format("  {}: {}\n", frame.name, frame.origin.file);
    if (frame.settings.path == Path::reference)
        return fmt::format("  {}: double precision, mode {}, made in {:.3g} s\n", frame.name,
                           nameOf(frame.settings.reference_mode), frame.made_in_ms / 1000);
    std::string line = "  " + frame.name;
    if (frame.time.runs > 0)
        line += fmt::format(": {:.4g} ms ({:.4g} to {:.4g}, {} runs)", frame.time.median, frame.time.min,
                            frame.time.max, frame.time.runs);
    if (frame.time.object_lists > 0)
        line += fmt::format(", {:.3g} ms on the host for each object's lights", frame.time.object_lists);
    return line + fmt::format(", {} bytes a pixel of {}\n", frame.bytes.gbuffer_per_pixel,
                              frame.settings.path == Path::deferred ? "G-buffer and depth" : "depth");
}

}  // namespace

std::string reportTable(const Report& report) {
    std::string out;
    for (const std::string& line : report.first_notes) out += line + "\n";
    std::set<std::string> printed;  // several comparisons of one scene share their notes
    for (const Comparison& comparison : report.comparisons) {
        const Frame &baseline = report.baseline(comparison), &test = report.test(comparison);
        out += fmt::format("{}, {}, {}x{}: {}\n", baseline.scene, cameraTitle(baseline),
                           baseline.settings.size.width, baseline.settings.size.height,
                           pairTitle(report, comparison));
        out += frameLine(baseline) + frameLine(test);

        std::vector<TableRow> rows{{"channel", "metric", "max", "mean", "p99.9", "tolerance", "verdict"}};
        for (const ChannelDiff* channel : failuresFirst(comparison)) rows.push_back(rowOf(*channel));
        std::array<std::size_t, 7> widths{};
        for (const TableRow& row : rows)
            for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
        for (const TableRow& row : rows) {
            std::string line = fmt::format("  {:<{}}  {:<{}}", row[0], widths[0], row[1], widths[1]);
            for (std::size_t i = 2; i < 6; ++i) line += fmt::format("  {:>{}}", row[i], widths[i]);
            out += line + "  " + row[6] + "\n";
        }
        for (const std::string& failure : comparison.failures) out += "  FAIL " + failure + "\n";
        for (const ChannelDiff& channel : comparison.channels)
            if (channel.verdict == Verdict::fail) {
                out += fmt::format("  FAIL {}: {}", channel.mode->name, channel.reason);
                if (channel.stats.worst_x >= 0)
                    out += fmt::format(", worst at {},{}", channel.stats.worst_x, channel.stats.worst_y);
                out += fmt::format(" ({}{}{})\n", channel.rule, channel.rule.empty() ? "" : ", because ",
                                   channel.tolerance.because);
            }
        for (const ChannelDiff& channel : comparison.channels)
            if (!channel.rule.empty() && channel.verdict == Verdict::pass)
                out += fmt::format("  {}: {}\n", channel.mode->name, channel.rule);
        for (const ChannelDiff& channel : comparison.channels)
            if (!channel.warning.empty())
                out +=
                    fmt::format("  warning {}: {} ({})\n", channel.mode->name, channel.warning, channel.rule);
        if (const std::string checks = checksLine(comparison); !checks.empty()) out += "  " + checks + "\n";
        for (const std::string& note : notesOf(report, comparison))
            if (printed.insert(note).second) out += "  note: " + note + "\n";
    }
    for (const CloserPath& closer : report.closer_paths) {
        if (report.closer_paths.size() > 1)
            out += fmt::format("{}, {}:\n", report.frames[closer.reference].scene,
                               cameraTitle(report.frames[closer.reference]));
        for (const CloserPathChannel& channel : closer.channels)
            out += closerPathLine(closer, channel, report.frames) + "\n";
    }
    return out + verdictLine(report) + "\n";
}

}  // namespace diptych
