// SPDX-License-Identifier: MIT
#include "compare/report/text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace diptych {
namespace {

// The code point that begins at text[at] and its length in bytes; U+FFFD and 1 where there is none.
std::pair<std::uint32_t, std::size_t> decodeUtf8(std::string_view text, std::size_t at) {
    const auto byte = [&](std::size_t i) {
        return static_cast<std::uint32_t>(static_cast<unsigned char>(text[i]));
    };
    constexpr std::pair<std::uint32_t, std::size_t> none{0xfffd, 1};
    const std::uint32_t first = byte(at);
    if (first < 0x80) return {first, 1};
    const std::size_t length = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
    if (first < 0xc2 || first > 0xf4 || at + length > text.size()) return none;
    std::uint32_t code = first & (0x7fu >> length);
    for (std::size_t i = 1; i < length; ++i) {
        if ((byte(at + i) & 0xc0) != 0x80) return none;
        code = code << 6 | (byte(at + i) & 0x3f);
    }
    const bool overlong = (length == 3 && code < 0x800) || (length == 4 && code < 0x10000);
    return overlong || code > 0x10ffff ? none : std::pair{code, length};
}

bool isXmlCharacter(std::uint32_t c) {
    return c == '\t' || c == '\n' || c == '\r' || (c >= 0x20 && c < 0xd800) || (c > 0xdfff && c < 0xfffe) ||
           c > 0xffff;
}

}  // namespace

std::string markup(std::string_view text) {
    std::string out;
    for (std::size_t i = 0; i < text.size();) {
        const auto [code, length] = decodeUtf8(text, i);
        if (code == '&')
            out += "&amp;";
        else if (code == '<')
            out += "&lt;";
        else if (code == '>')
            out += "&gt;";
        else if (code == '"')
            out += "&quot;";
        else if (code == '\'')
            out += "&#39;";
        else if (code == 0xfffd || !isXmlCharacter(code))
            out += "\xef\xbf\xbd";
        else
            out += text.substr(i, length);
        i += length;
    }
    return out;
}

std::string number(double value) {
    return fmt::format("{:.3g}", value);
}

std::string bytes(std::uint64_t count) {
    if (count < 1024) return fmt::format("{} B", count);
    double value = static_cast<double>(count);
    std::size_t unit = 0;
    for (; value >= 1024 && unit < 4; ++unit) value /= 1024;
    return fmt::format("{:.4g} {}iB", value, " KMGT"[unit]);
}

const char* unitOf(const DebugMode& mode) {
    return mode.metric == Metric::angular ? "\u00b0" : "";
}

std::string cameraTitle(const Frame& frame) {
    if (!frame.camera.name.empty()) return frame.camera.name;
    return frame.settings.camera.empty() ? "default view" : frame.settings.camera;
}

bool hasSeveralPairs(const Report& report) {
    return !report.nearer.empty() ||
           std::ranges::any_of(report.frames, [](const Frame& f) { return !f.origin.file.empty(); });
}

std::string pairTitle(const Report& report, const Comparison& comparison) {
    return fmt::format("{} against {}", report.test(comparison).name, report.baseline(comparison).name);
}

std::vector<std::size_t> failingFirst(const Report& report) {
    std::vector<std::size_t> order(report.comparisons.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, {}, [&](std::size_t i) { return report.comparisons[i].passed(); });
    return order;
}

std::vector<const ChannelDiff*> failuresFirst(const Comparison& comparison) {
    std::vector<const ChannelDiff*> channels;
    for (const ChannelDiff& channel : comparison.channels) channels.push_back(&channel);
    const auto rank = [](const ChannelDiff* c) {
        return c->verdict == Verdict::fail ? 0 : c->verdict == Verdict::pass ? 1 : 2;
    };
    std::ranges::stable_sort(channels, {}, rank);
    return channels;
}

std::vector<std::string> notesOf(const Report& report, const Comparison& comparison) {
    std::vector<std::string> notes;
    for (const auto* source :
         {&comparison.notes, &report.baseline(comparison).notes, &report.test(comparison).notes})
        for (const std::string& note : *source)
            if (std::ranges::count(notes, note) == 0) notes.push_back(note);
    return notes;
}

std::string marksLine(const Comparison& comparison) {
    std::uint64_t count = 0;
    std::vector<std::string> features;
    for (const FeatureMarks& feature : comparison.marks) {
        count += feature.found;
        features.push_back(fmt::format("{} {}", feature.feature, feature.found));
    }
    if (count == 0) return {};
    return fmt::format("{} place{} to check by eye: {}", count, count == 1 ? "" : "s",
                       fmt::join(features, ", "));
}

std::string verdictLine(const Report& report) {
    std::size_t compared = 0, failedFrames = 0;
    std::vector<std::string_view> failed;
    for (const Comparison& comparison : report.comparisons) {
        failedFrames += !comparison.failures.empty();
        for (const ChannelDiff& channel : comparison.channels) {
            compared += channel.verdict != Verdict::forward_only;
            if (channel.verdict == Verdict::fail && std::ranges::count(failed, channel.mode->name) == 0)
                failed.push_back(channel.mode->name);
        }
    }
    const std::string pictures =
        report.comparisons.size() == 1 ? "" : fmt::format(" of {} comparisons", report.comparisons.size());
    if (report.passed())
        return fmt::format("pass: all {} channels{} are within tolerance", compared, pictures);
    if (failed.empty())
        return fmt::format("FAIL: {} comparison(s) of Frames that cannot be trusted", failedFrames);
    return fmt::format("FAIL: {}{} beyond tolerance", fmt::join(failed, ", "), pictures);
}

}  // namespace diptych
