// SPDX-License-Identifier: MIT
// junit.xml is stated whole: a suite with each outcome, and the document around suites.
#include "compare/report/json.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <regex>

namespace diptych {
namespace {

// Two Frames with one channel of two pixels.
Report suiteReport() {
    Report report;
    report.device = {"a CPU", "1.0", "cpu"};
    for (const char* name : {"deferred", "forward_plus"}) {
        Frame& frame = report.frames.emplace_back();
        frame.name = name;
        frame.scene = "<a>.glb";
        frame.settings.size = {2, 1};
        frame.made_in_ms = 750;
    }
    Comparison& one = report.comparisons.emplace_back();
    one.test = 1;
    one.channels.emplace_back().mode = &debugMode(Channel::texcoords);
    return report;
}

std::string withoutTimestamp(const std::string& xml) {
    return std::regex_replace(xml, std::regex(" timestamp=\"[0-9]{4}-[0-9]{2}-[0-9]{2}T[0-9:]{8}\""), "");
}

TEST(ReportJunitText, ASuiteIsWhole) {
    Report report = suiteReport();
    Comparison& one = report.comparisons[0];
    report.frames[0].name = "<d>";
    report.frames[0].camera.name = "door.1";
    report.frames[1].made_in_ms = 1500;
    one.command = {"compare", "a b"};
    one.notes = {"a <note>"};
    one.visual_checks = {{"skins", 3, {}}};
    one.failures = {"first <", "second"};
    ChannelDiff& fails = one.channels[0];
    fails.verdict = Verdict::fail;
    fails.reason = "<much>";
    fails.stats = {
        .max = 1.23456, .mean = 0.25, .rmse = 7, .p99 = 8, .p999 = 0.5, .worst_x = 1, .worst_y = 2};
    fails.criterion = {.metric = "max<", .measured = 1.0001, .limit = 1};
    fails.tolerance.because = "of <bits>";
    ChannelDiff passes = fails;
    passes.mode = &debugMode(Channel::albedo);
    passes.verdict = Verdict::pass;
    passes.criterion.reset();
    ChannelDiff alone = passes;
    alone.mode = &debugMode(Channel::normals);
    alone.verdict = Verdict::forward_only;
    one.channels.insert(one.channels.begin() + 1, {passes, alone});
    ReportLayout layout;
    layout.images = {std::vector<ChannelImages>(3)};
    ChannelImages& images = layout.images[0][0];
    images.baseline = "a&.png";
    images.test = "b.png";
    const std::string title = "&lt;a&gt;.glb | door.1 | forward_plus against &lt;d&gt;",
                      dotless = "&lt;a&gt;_glb | door_1 | forward_plus against &lt;d&gt;";
    const auto property = [](const std::string& name, const std::string& value) {
        return "      <property name=\"" + name + "\" value=\"" + value + "\"/>\n";
    };
    const auto test = [&](const std::string& name, const std::string& outcome) {
        return "    <testcase classname=\"" + dotless + "\" name=\"" + name + "\" time=\"0.562\">\n      " +
               outcome + "\n    </testcase>\n";
    };
    const std::string scene = property("scene", "&lt;a&gt;.glb") + property("camera", "door.1"),
                      size = property("size", "2x1"), gbuffer = property("gbuffer", "standard"),
                      names = property("baseline", "&lt;d&gt;") + property("test", "forward_plus") +
                              property("device", "a CPU") + property("driver", "1.0");
    const auto suite = [&](const std::string& properties, const std::string& limit,
                           const std::string& passing, const std::string& attachments) {
        return "  <testsuite name=\"" + title +
               "\" tests=\"4\" failures=\"2\" errors=\"0\" skipped=\"1\" "
               "time=\"2.250\">\n    <properties>\n" +
               properties + "    </properties>\n" +
               test("texcoords",
                    "<failure type=\"difference\" message=\"&lt;much&gt;\">max 1.23 mean 0.25 p99.9 0.5 "
                    "(absolute), "
                    "worst at 1,2; " +
                        limit + ": of &lt;bits&gt;</failure>\n      <system-out>" + attachments +
                        "</system-out>") +
               test("albedo", "<system-out>" + passing + "no limit\n</system-out>") +
               test("normals", "<skipped message=\"forward-only: of &lt;bits&gt;\"/>") +
               test("frames",
                    "<failure type=\"frames\" message=\"first &lt;\">first &lt;\nsecond\n</failure>") +
               "    <system-out>note: a &lt;note&gt;\n3 places to check by eye: skins 3\n</system-out>\n"
               "  </testsuite>\n";
    };
    const auto xml = [&] { return withoutTimestamp(junitSuite(report, layout, "out/", 0).xml); };
    const std::string again = "reproduce: diptych compare --channels texcoords &#39;a b&#39;\n",
                      measured = "max&lt; 1.0001, limit 1";
    EXPECT_EQ(xml(),
              suite(scene + size + gbuffer + names + property("command", "diptych compare &#39;a b&#39;"),
                    measured, "", "[[ATTACHMENT|out/a&amp;.png]]\n[[ATTACHMENT|out/b.png]]\n" + again));
    // By rules, with warnings, of several times, on two devices, without a command.
    one.channels[0].rule = one.channels[1].rule = "rule <1>";
    one.channels[1].warning = "near <";
    images.difference = "d.png";
    images.test = images.baseline;
    one.command.clear();
    report.frames[0].settings.time = 0.5;
    report.frames[0].origin.device = "old";
    report.frames[1].origin.device = report.against.name = "b <GPU>";
    report.against.driver = "2.0";
    std::string later = suite(scene + property("time", "0.5") + size + gbuffer + names +
                                  property("test_device", "b &lt;GPU&gt;") + property("test_driver", "2.0"),
                              "rule &lt;1&gt;, " + measured, "warning: near &lt; (rule &lt;1&gt;)\n",
                              "[[ATTACHMENT|out/d.png]]\n[[ATTACHMENT|out/a&amp;.png]]\n");
    for (const auto& [camera, view] :
         {std::pair{"door\\.1 ", "door.1, 0.5 s "}, {"door_1 ", "door_1, 0_5 s "}})
        later = std::regex_replace(later, std::regex(camera), view);
    EXPECT_EQ(xml(), later);
    // A file has neither encoding nor second device here.
    report.frames[0].origin.file = "a.exr";
    EXPECT_EQ(xml().find("\"gbuffer\""), std::string::npos);
    EXPECT_EQ(xml().find("\"test_device\""), std::string::npos);
    const JunitSuite counts = junitSuite(report, layout, "out/", 0);
    EXPECT_EQ(counts.tests, 4u);
    EXPECT_EQ(counts.failures, 2u);
    EXPECT_EQ(counts.seconds, 2.25);
}

// Scenes without a comparison have a suite; totals are those of all.
TEST(ReportJunitText, ADocumentIsWhole) {
    Report report;
    report.errors = {{"a.<b>", "is short"}, {"c", "c: failed", "<cycles>", "said <this>"}};
    report.failures = {{"d", "is in A only"}};
    JunitSuite totals{"", 10, 3, 1.5};
    totals += {"more", 1, 2, 0.25};
    EXPECT_EQ(totals.xml, "more");
    std::string text;
    writeJunit(
        report, totals, [](const JsonSink& sink) { sink("[suites]\n"); },
        [&](std::string_view piece) { text += piece; });
    const auto suite = [](const std::string& scene, int failures, int errors, const std::string& dotless,
                          const std::string& name, const std::string& outcome) {
        return fmt::format(
            "  <testsuite name=\"{}\" tests=\"1\" failures=\"{}\" errors=\"{}\" skipped=\"0\" "
            "time=\"0.000\">\n    <testcase classname=\"{}\" name=\"{}\" time=\"0.000\">\n      {}\n"
            "    </testcase>\n  </testsuite>\n",
            scene, failures, errors, dotless, name, outcome);
    };
    EXPECT_EQ(text,
              "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"diptych\" tests=\"14\" "
              "failures=\"6\" "
              "errors=\"2\" time=\"1.750\">\n" +
                  suite("a.&lt;b&gt;", 0, 1, "a_&lt;b&gt;", "scene",
                        "<error type=\"scene\" message=\"a.&lt;b&gt;: is short\"/>") +
                  suite("c", 0, 1, "c", "<cycles>",
                        "<error type=\"scene\" message=\"c: failed\"/>\n      <system-err>said &lt;this&gt;"
                        "</system-err>") +
                  suite("d", 1, 0, "d", "scene", "<failure type=\"scene\" message=\"d: is in A only\"/>") +
                  "[suites]\n</testsuites>\n");
    EXPECT_EQ(junitFolder("a<b"), "a&lt;b/");
    EXPECT_EQ(junitFolder("a/b/"), "a/b/");
}

}  // namespace
}  // namespace diptych
