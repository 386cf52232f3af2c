// SPDX-License-Identifier: MIT
// The format that Jenkins, GitLab and GitHub's test reporters read: only elements and attributes of
// junit-10.xsd of Jenkins' xUnit plugin.
#include "compare/report/json.h"
#include "compare/report/titles.h"
#include "compare/run/command_text.h"
#include "shared/text/digits.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <set>

namespace diptych {

using page::cameraTitle;
using page::markup;
using page::number;

namespace {

std::string failure(const std::string& type, const std::string& message, const std::string& text) {
    return fmt::format("      <failure type=\"{}\" message=\"{}\">{}</failure>\n", type, markup(message),
                       markup(text));
}

// Servers split a class name at its last dot into package and class.
std::string classNameOf(std::string title) {
    std::ranges::replace(title, '.', '_');
    return markup(title);
}

std::string nowInUtc() {
    return fmt::format("{:%Y-%m-%dT%H:%M:%S}", fmt::gmtime(std::time(nullptr)));
}

// A scene without a comparison: a suite of one case with an "error" or a "failure".
std::string unpairedSuite(const SceneError& of, std::string_view outcome) {
    return fmt::format(
        "  <testsuite name=\"{}\" tests=\"1\" failures=\"{}\" errors=\"{}\" skipped=\"0\" time=\"0.000\">\n"
        "    <testcase classname=\"{}\" name=\"{}\" time=\"0.000\">\n"
        "      <{} type=\"scene\" message=\"{}\"/>\n{}    </testcase>\n  </testsuite>\n",
        markup(of.scene), outcome == "failure" ? 1 : 0, outcome == "error" ? 1 : 0, classNameOf(of.scene),
        of.renderer.empty() ? "scene" : of.renderer, outcome, markup(errorText(of)),
        of.output.empty() ? "" : fmt::format("      <system-err>{}</system-err>\n", markup(of.output)));
}

class Suite {
public:
    Suite(const Report& report, const ReportLayout& layout, const std::string& folder, std::size_t index)
        : report_(report),
          comparison_(report.comparisons[index]),
          images_(layout.images.at(index)),
          folder_(folder),
          left_(report.baseline(comparison_)),
          right_(report.test(comparison_)),
          title_(fmt::format("{} | {} | {}", left_.scene, viewTitle(report, left_),
                             pairTitle(report, comparison_))) {}

    std::size_t count(bool (*of)(Verdict)) const {
        return static_cast<std::size_t>(std::ranges::count_if(
            comparison_.channels, [&](const ChannelDiff& channel) { return of(channel.verdict); }));
    }
    bool broken() const { return !comparison_.failures.empty(); }
    std::size_t tests() const { return comparison_.channels.size() + broken(); }
    std::size_t failures() const {
        return count([](Verdict v) { return v == Verdict::fail; }) + broken();
    }
    double seconds() const { return (left_.made_in_ms + right_.made_in_ms) / 1000; }

    std::string xml() const {
        std::string out = fmt::format(
            "  <testsuite name=\"{}\" tests=\"{}\" failures=\"{}\" errors=\"0\" skipped=\"{}\" "
            "time=\"{:.3f}\" timestamp=\"{}\">\n",
            markup(title_), tests(), failures(), count([](Verdict v) { return !isCompared(v); }), seconds(),
            nowInUtc());
        out += properties();
        for (std::size_t i = 0; i < comparison_.channels.size(); ++i)
            out += testCase(comparison_.channels[i].mode->name, outcome(comparison_.channels[i], images_[i]));
        std::string whole;
        for (const std::string& text : comparison_.failures) whole += text + "\n";
        if (broken()) out += testCase("frames", failure("frames", comparison_.failures.front(), whole));
        return out + notes() + "  </testsuite>\n";
    }

private:
    // All channels come from the same two Frames, so each case gets an equal part of their time.
    std::string testCase(std::string_view name, const std::string& outcome) const {
        const std::string open =
            fmt::format("    <testcase classname=\"{}\" name=\"{}\" time=\"{:.3f}\"", classNameOf(title_),
                        markup(name), seconds() / static_cast<double>(tests()));
        return open + (outcome.empty() ? "/>\n" : ">\n" + outcome + "    </testcase>\n");
    }

    std::string properties() const {
        std::string out = "    <properties>\n";
        const auto add = [&](const char* name, const std::string& value) {
            out += fmt::format("      <property name=\"{}\" value=\"{}\"/>\n", name, markup(value));
        };
        add("scene", left_.scene);
        add("camera", cameraTitle(left_));
        if (namesTime(report_, left_)) add("time", left_.settings.valueOf("time"));
        add("size", left_.settings.valueOf("size"));
        if (left_.origin.file.empty()) add("gbuffer", left_.settings.valueOf("gbuffer"));
        add("baseline", left_.name);
        add("test", right_.name);
        const ReportDevice &drew = deviceOf(report_, left_), &drew_test = deviceOf(report_, right_);
        add("device", drew.name);
        add("driver", drew.driver);
        if (!left_.origin.device.empty() && left_.origin.file.empty()) {
            add("test_device", drew_test.name);
            add("test_driver", drew_test.driver);
        }
        if (!comparison_.command.empty()) add("command", shellLine(comparison_.command));
        return out + "    </properties>\n";
    }

    std::string outcome(const ChannelDiff& channel, const ChannelImages& images) const {
        if (!isCompared(channel.verdict))
            return fmt::format("      <skipped message=\"{}: {}\"/>\n", nameOf(channel.verdict),
                               markup(channel.tolerance.because));
        const std::string warning =
            channel.warning.empty()
                ? ""
                : markup(fmt::format("warning: {} ({})", channel.warning, channel.rule)) + "\n";
        const std::string limit =
            channel.criterion
                ? fmt::format("{} {}, limit {}", channel.criterion->metric,
                              distinguishingDigits(channel.criterion->measured, channel.criterion->limit),
                              distinguishingDigits(channel.criterion->limit, channel.criterion->measured))
                : "no limit";
        if (channel.verdict != Verdict::fail)
            return fmt::format("      <system-out>{}{}\n</system-out>\n", warning, markup(limit));
        const ChannelStats& s = channel.stats;
        return failure("difference", channel.reason,
                       fmt::format("max {} mean {} p99.9 {} ({}), worst at {},{}; {}: {}", number(s.max),
                                   number(s.mean), number(s.p999), nameOf(channel.mode->error_kind),
                                   s.worst_x, s.worst_y,
                                   channel.rule.empty() ? limit : fmt::format("{}, {}", channel.rule, limit),
                                   channel.tolerance.because)) +
               attachments(channel, images);
    }

    // One per line, as GitLab and Jenkins' attachments plugin expect. GitLab shows the first: the
    // difference, if there is one.
    std::string attachments(const ChannelDiff& channel, const ChannelImages& images) const {
        std::string lines;
        std::set<std::string> attached;  // both sides of equal channels share an image
        for (const std::string* image : {&images.difference, &images.baseline, &images.test})
            if (!image->empty() && attached.insert(*image).second)
                lines += fmt::format("[[ATTACHMENT|{}]]\n", folder_ + markup(*image));
        if (!comparison_.command.empty())
            lines += markup("reproduce: " + shellLine(withOption(comparison_.command, "--channels",
                                                                 std::string(channel.mode->name)))) +
                     "\n";
        return "      <system-out>" + lines + "</system-out>\n";
    }

    std::string notes() const {
        std::string lines;
        for (const std::string& note : notesOf(report_, comparison_)) lines += markup("note: " + note) + "\n";
        if (const std::string line = checksLine(comparison_); !line.empty()) lines += markup(line) + "\n";
        return lines.empty() ? "" : fmt::format("    <system-out>{}</system-out>\n", lines);
    }

    const Report& report_;
    const Comparison& comparison_;
    const std::vector<ChannelImages>& images_;  // per channel
    const std::string& folder_;
    const Frame &left_, &right_;
    std::string title_;
};

}  // namespace

JunitSuite junitSuite(const Report& report, const ReportLayout& layout, const std::string& folder,
                      std::size_t index) {
    const Suite suite(report, layout, folder, index);
    return {suite.xml(), suite.tests(), suite.failures(), suite.seconds()};
}

std::string junitFolder(const std::filesystem::path& folder) {
    return markup((folder / "").generic_string());
}

void writeJunit(const Report& report, const JunitSuite& totals,
                const std::function<void(const JsonSink&)>& suites, const JsonSink& sink) {
    sink(
        fmt::format("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"diptych\" tests=\"{}\" "
                    "failures=\"{}\" errors=\"{}\" time=\"{:.3f}\">\n",
                    totals.tests + report.errors.size() + report.failures.size(),
                    totals.failures + report.failures.size(), report.errors.size(), totals.seconds));
    for (const SceneError& error : report.errors) sink(unpairedSuite(error, "error"));
    for (const SceneError& failure : report.failures) sink(unpairedSuite(failure, "failure"));
    suites(sink);
    sink("</testsuites>\n");
}

std::string reportJunit(const Report& report, const ReportLayout& layout,
                        const std::filesystem::path& folder) {
    JunitSuite all;
    for (std::size_t i = 0; i < report.comparisons.size(); ++i)
        all += junitSuite(report, layout, junitFolder(folder), i);
    std::string text;
    writeJunit(
        report, all, [&](const JsonSink& sink) { sink(all.xml); },
        [&](std::string_view piece) { text += piece; });
    return text;
}

}  // namespace diptych
