// SPDX-License-Identifier: MIT
#include "compare/report/json.h"
#include "compare/report/text.h"

#include <fmt/format.h>

#include <algorithm>

namespace diptych {
namespace {

std::string testCase(const std::string& suite, std::string_view name, const std::string& outcome) {
    return fmt::format("    <testcase classname=\"{}\" name=\"{}\"{}", suite, markup(name),
                       outcome.empty() ? "/>\n" : ">" + outcome + "</testcase>\n");
}

std::string failure(const std::string& message, const std::string& text) {
    return fmt::format("<failure message=\"{}\">{}</failure>", markup(message), markup(text));
}

std::string systemOut(const std::vector<std::string>& notes) {
    std::string lines;
    for (const std::string& note : notes) lines += markup("note: " + note) + "\n";
    return lines.empty() ? "" : fmt::format("    <system-out>{}</system-out>\n", lines);
}

std::string outcomeOf(const ChannelDiff& channel) {
    if (channel.verdict == Verdict::forward_only)
        return fmt::format("<skipped message=\"forward-only: {}\"/>", markup(channel.tolerance.because));
    if (channel.verdict == Verdict::pass) return {};
    const ChannelStats& s = channel.stats;
    return failure(
        channel.reason,
        fmt::format("max {} mean {} p99.9 {} ({}), worst at {},{}; tolerance {}: {}", number(s.max),
                    number(s.mean), number(s.p999), nameOf(channel.mode->metric), s.worst_x, s.worst_y,
                    number(channel.tolerance.max), channel.tolerance.because));
}

}  // namespace

std::string reportJunit(const Report& report) {
    std::string suites;
    std::size_t allTests = 0, allFailures = 0, allSkipped = 0;
    for (const Comparison& comparison : report.comparisons) {
        const Frame& baseline = report.baseline(comparison);
        const std::string suite = markup(fmt::format("{} | {} | {}", baseline.scene, cameraTitle(baseline),
                                                     pairTitle(report, comparison)));
        std::string cases;
        for (const ChannelDiff& channel : comparison.channels)
            cases += testCase(suite, channel.mode->name, outcomeOf(channel));
        std::string whole;
        for (const std::string& text : comparison.failures) whole += text + "\n";
        if (!whole.empty()) cases += testCase(suite, "frames", failure("a Frame cannot be trusted", whole));

        const auto count = [&](Verdict verdict) {
            return static_cast<std::size_t>(
                std::ranges::count(comparison.channels, verdict, &ChannelDiff::verdict));
        };
        const std::size_t tests = comparison.channels.size() + !whole.empty(),
                          failures = count(Verdict::fail) + !whole.empty(),
                          skipped = count(Verdict::forward_only);
        suites += fmt::format(
            "  <testsuite name=\"{}\" tests=\"{}\" failures=\"{}\" errors=\"0\" skipped=\"{}\">\n{}"
            "  </testsuite>\n",
            suite, tests, failures, skipped, cases + systemOut(notesOf(report, comparison)));
        allTests += tests;
        allFailures += failures;
        allSkipped += skipped;
    }
    return fmt::format(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"diptych compare\" tests=\"{}\" "
        "failures=\"{}\" errors=\"0\" skipped=\"{}\">\n{}</testsuites>\n",
        allTests, allFailures, allSkipped, suites);
}

}  // namespace diptych
