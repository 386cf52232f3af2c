// SPDX-License-Identifier: MIT
// Parts of a report: what is stored is read back, faults are named, and parts join to the whole report.
#include "compare/report/parts.h"
#include "compare/report/json.h"
#include "compare/report/report.h"
#include "compare/report/titles.h"
#include "compare/report/whole_report.h"
#include "tests/support/errors.h"
#include "tests/support/files.h"
#include "tests/support/report_builder.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <functional>
#include <regex>

namespace diptych {
namespace {

namespace fs = std::filesystem;
using PartJson = nlohmann::ordered_json;

// Path against the reference and path against path of two channels; one fails.
Report partReport(const std::string& scene) {
    std::vector<Frame> frames = withOnly({Channel::lit, Channel::material_id}, bothFrames(scene));
    for (Frame& frame : frames) frame.through_gbuffer.clear();
    frames[1].channels[Channel::lit].at(1, 2) = 0.75f;
    Frame reference = frames[0];
    reference.name = "reference";
    reference.settings.path = Path::reference;
    reference.notes = {"a note"};
    frames.insert(frames.begin(), reference);
    Report report = makeReport({{frames, {}, {}, {}}}, {"a CPU", "1.0", "cpu"});
    report.diff_ms = 1.5;
    report.comparisons[0].visual_checks = {{"skins", 3, {}}};
    report.comparisons[0].channels[0].warning = "near";
    report.comparisons[0].emptiness = "black";
    return report;
}

ReportOptions partOf(const std::string& folder) {
    ReportOptions options;
    options.scene_folder = folder;
    return options;
}

TEST(ReportPart, IsReadBackAsItWas) {
    const fs::path root = folder();
    const Report report = partReport("a.glb");
    const ReportPart made = writePart(report, root, partOf("a/"));
    EXPECT_TRUE(isPartThere(root, "a/"));
    EXPECT_FALSE(isPartThere(root, "b/"));
    const ReportPart read = readPart(root, "a/");
    for (const ReportPart* part : {&made, &read}) {
        const Report& of = part->report;
        EXPECT_EQ(part->scene_folder, "a/");
        EXPECT_EQ(of.device.name + of.device.driver + of.device.type, "a CPU1.0cpu");
        EXPECT_EQ(of.diff_ms, 1.5);
        ASSERT_EQ(of.frames.size(), 3u);
        ASSERT_EQ(of.comparisons.size(), report.comparisons.size());
        for (std::size_t i = 0; i < of.frames.size(); ++i) {
            EXPECT_EQ(of.frames[i].name, report.frames[i].name);
            EXPECT_EQ(of.frames[i].scene, "a.glb");
            EXPECT_EQ(of.frames[i].notes, report.frames[i].notes);
            EXPECT_EQ(of.frames[i].settings.size, (Size{4, 3}));
        }
        for (std::size_t i = 0; i < of.comparisons.size(); ++i) {
            const Comparison &one = of.comparisons[i], &was = report.comparisons[i];
            EXPECT_EQ(one.baseline, was.baseline);
            EXPECT_EQ(one.test, was.test);
            EXPECT_EQ(one.failures, was.failures);
            EXPECT_EQ(one.notes, was.notes);
            EXPECT_EQ(one.emptiness, was.emptiness);
            EXPECT_EQ(checksLine(one), checksLine(was));
            ASSERT_EQ(one.channels.size(), was.channels.size());
            for (std::size_t k = 0; k < one.channels.size(); ++k) {
                EXPECT_EQ(one.channels[k].mode, was.channels[k].mode);
                EXPECT_EQ(one.channels[k].verdict, was.channels[k].verdict);
                EXPECT_EQ(one.channels[k].reason, was.channels[k].reason);
                EXPECT_EQ(one.channels[k].warning, was.channels[k].warning);
            }
        }
        ASSERT_EQ(of.closer_paths.size(), 1u);
        EXPECT_EQ(of.closer_paths[0].reference, 0u);
        EXPECT_EQ(of.closer_paths[0].paths, (std::array<std::size_t, 2>{1, 2}));
        EXPECT_EQ(verdictLine(of), verdictLine(report));
        EXPECT_EQ(part->sections,
                  (std::vector<std::string>{"a/deferred-against-reference/comparison.section.js",
                                            "a/forward_plus-against-reference/comparison.section.js",
                                            "a/forward_plus-against-deferred/comparison.section.js"}));
        EXPECT_EQ(part->texts(),
                  (std::vector<std::string>{"a/part.json", "a/part-frames.json", "a/part-comparisons.json",
                                            "a/part-truth.json", "a/part-junit.xml"}));
        EXPECT_EQ(part->exposures.size(), 3u);
        EXPECT_GT(part->encode_ms, 0);
        EXPECT_EQ(part->junit.tests, 6u);
    }
    EXPECT_EQ(read.files, made.files);
    EXPECT_EQ(read.tables, made.tables);
    EXPECT_EQ(read.closer_tables, made.closer_tables);
    EXPECT_EQ(read.closer_boxes, made.closer_boxes);
    // Every file of the folder is listed once, apart from the part's own texts.
    std::vector<std::string> all = read.files, texts = read.texts();
    for (const std::vector<std::string>& more : {read.sections, texts})
        all.insert(all.end(), more.begin(), more.end());
    std::ranges::sort(all);
    EXPECT_EQ(all, filesIn(root));
}

// Edits of a part's file, and what is said of them.
TEST(ReportPart, FaultsAreNamed) {
    const fs::path root = folder(), file = root / "a/part.json";
    writePart(partReport("a.glb"), root, partOf("a/"));
    const PartJson whole = PartJson::parse(contentsOf(file));
    const auto fault = [&](const std::function<void(PartJson&)>& edit) {
        PartJson json = whole;
        edit(json);
        std::ofstream(file) << json.dump();
        const std::string said = faultOf([&] { readPart(root, "a/"); });
        return said.starts_with(file.string() + ": ") ? said.substr(file.string().size() + 2) : said;
    };
    EXPECT_EQ(fault([](PartJson&) {}), "");
    EXPECT_EQ(fault([](PartJson& j) { j["schema"] = 1; }),
              "schema: is that of another version of Diptych; compare the scene again");
    EXPECT_EQ(fault([](PartJson& j) { j["comparisons"][0]["frames"][1] = 3; }),
              "comparisons[0].frames[1]: is not a whole number from 0 to 2");
    EXPECT_EQ(fault([](PartJson& j) { j["closer"][0][2] = 3; }),
              "closer[0][2]: is not a whole number from 0 to 2");
    EXPECT_EQ(fault([](PartJson& j) { j["comparisons"][0]["channels"][0][1] = "good"; }),
              "comparisons[0].channels[0][1]: is not a verdict");
    constexpr std::uint64_t most = std::uint64_t{1} << 48;
    EXPECT_EQ(fault([&](PartJson& j) { j["comparisons"][0]["checks"][0][1] = most; }), "");
    EXPECT_EQ(fault([&](PartJson& j) { j["comparisons"][0]["checks"][0][1] = most + 1; }),
              "comparisons[0].checks[0][1]: is not a whole number from 0 to 281474976710656");
    EXPECT_EQ(fault([&](PartJson& j) { j["junit"][1] = most + 1; }),
              "junit[1]: is not a whole number from 0 to 281474976710656");
    for (const char* key : {"tables", "rows", "exposures"})
        EXPECT_EQ(fault([&](PartJson& j) { j[key].erase(0); }),
                  fmt::format("{}: has 2 elements, but there are 3 comparisons", key));
    EXPECT_EQ(fault([](PartJson& j) { j["sections"].erase(0); }),
              "sections: has 2 elements, but there are 3 comparisons");
    for (const char* key : {"closer_tables", "closer_boxes"})
        EXPECT_EQ(fault([&](PartJson& j) { j[key].push_back("x"); }),
                  fmt::format("{}: has 2 elements, but there are 1 paths compared with a reference", key));
    EXPECT_EQ(fault([](PartJson& j) { j["files"].push_back("b/lit.png"); }),
              fmt::format("files[{0}]: \"b/lit.png\" is not a file in the report folder \"a/\"",
                          whole["files"].size()));
    EXPECT_EQ(fault([](PartJson& j) { j["files"].push_back(j["files"][0]); }),
              fmt::format("files[{}]: {} is listed twice", whole["files"].size(), whole["files"][0].dump()));
    EXPECT_EQ(fault([](PartJson& j) { j["files"].push_back("a/part.json"); }),
              fmt::format("files[{}]: \"a/part.json\" is listed twice", whole["files"].size()));
    EXPECT_EQ(fault([](PartJson& j) { j["files"].push_back("a/x.json"); }),
              fmt::format("files[{}]: \"a/x.json\" is of a kind that a report does not list here",
                          whole["files"].size()));
}

TEST(ReportPart, ASectionIsReadFromItsScript) {
    const fs::path root = folder();
    const auto read = [&](const std::string& text) {
        std::ofstream(root / "a.section.js") << text;
        std::string section;
        const std::string fault = faultOf([&] { section = sectionIn(root, "a.section.js"); });
        return fault.empty() ? section : fault.substr((root / "a.section.js").string().size());
    };
    EXPECT_EQ(read("diptychSection(\"a.section.js\",\"<p>(x)</p>\");\n"), "<p>(x)</p>");
    for (const char* other : {"", "f", "f)(", "f(\"b.section.js\",\"x\")", "f(\"a.section.js\")",
                              "f(\"a.section.js\",\"x\",1)", "f(\"a.section.js\",1)"})
        EXPECT_EQ(read(other), ": is not a report section") << other;
}

// Two scenes in parts, and the same at once: equal but for times.
TEST(WholeReports, AreThoseOfOneCommand) {
    const fs::path here = folder();
    const std::vector<std::string> scenes{"x/a.glb", "x/b.glb"};
    WholeReport whole;
    Report at_once;
    for (std::size_t i = 0; i < scenes.size(); ++i) {
        Report one = partReport(scenes[i]);
        if (i == 1) one.device.name = "a GPU";
        const fs::path root = here / ("part-" + std::to_string(i));
        whole.parts.push_back({writePart(one, root, partOf(std::string(1, scenes[i][2]) + "/")), root});
    }
    whole.errors = {{"x/c.glb", "is short"}};
    const ReportPart joined = joinedOf(whole);
    ASSERT_EQ(joined.report.comparisons.size(), 6u);
    for (std::size_t i = 0; i < 6; ++i) {
        EXPECT_EQ(joined.report.baseline(joined.report.comparisons[i]).scene, scenes[i / 3]);
        EXPECT_EQ(joined.report.test(joined.report.comparisons[i]).scene, scenes[i / 3]);
    }
    ASSERT_EQ(joined.report.closer_paths.size(), 2u);
    EXPECT_EQ(joined.report.closer_paths[1].reference, 3u);
    EXPECT_EQ(joined.report.closer_paths[1].paths, (std::array<std::size_t, 2>{4, 5}));
    EXPECT_EQ(joined.report.device.name, "a CPU");
    EXPECT_EQ(joined.report.errors.size(), 1u);
    EXPECT_EQ(joined.rows.size(), 6u);
    EXPECT_EQ(joined.tables.size(), 6u);
    EXPECT_EQ(joined.exposures.size(), 6u);
    EXPECT_EQ(joined.sections.size(), 6u);
    EXPECT_EQ(joined.junit.tests, 12u);
    std::string failing, all;
    for (std::size_t i = 0; i < 6; ++i) {
        all += joined.tables[i];
        if (!joined.report.comparisons[i].passed()) failing += joined.tables[i];
    }
    ASSERT_NE(failing, all);
    EXPECT_EQ(tableOf(joined, false), failing + tableEnd(joined.report));
    for (const std::string& table : joined.closer_tables) all += table;
    EXPECT_EQ(tableOf(joined, true), all + tableEnd(joined.report));

    writeWhole(whole, joined, here / "out", {});
    const auto json = nlohmann::json::parse(contentsOf(here / "out/report.json"));
    EXPECT_EQ(json["verdict"], "fail");
    EXPECT_EQ(json["frames"].size(), 6u);
    EXPECT_EQ(json["comparisons"].size(), 6u);
    EXPECT_EQ(json["truth"].size(), 2u);
    EXPECT_EQ(filesIn(here / "out"), json["files"].get<std::vector<std::string>>());
    ASSERT_EQ(json["devices"].size(), 2u);
    for (const auto& device : json["devices"]) {
        EXPECT_EQ(device["compare_ms"], 1.5);
        EXPECT_GT(device["encode_ms"].get<double>(), 0);
    }
    EXPECT_TRUE(json["compare_ms"].is_null());
    const std::string junit = contentsOf(here / "out/junit.xml"), page = contentsOf(here / "out/index.html");
    EXPECT_EQ(junit.find('\x03'), std::string::npos);
    EXPECT_NE(junit.find("[[ATTACHMENT|" + (here / "out/b").string()), std::string::npos);
    EXPECT_EQ(page.find_first_of("\x01\x02"), std::string::npos);
    // Failing comparisons first; four sections stand in the page, with their titles.
    std::vector<std::size_t> order = failingFirst(joined.report);
    order.resize(4);
    for (std::size_t i = 0; i < 6; ++i) {
        EXPECT_EQ(countOf(page, fmt::format("<div class=\"comparison\" id=\"s{}\"><h2>", i)),
                  static_cast<std::size_t>(std::ranges::count(order, i)));
        EXPECT_EQ(countOf(page, "data-section=\"" + joined.sections[i] + "\""),
                  1u - std::ranges::count(order, i));
    }
    const Comparison& first = joined.report.comparisons[order[0]];
    EXPECT_NE(page.find(fmt::format("id=\"s{}\"><h2>{}.glb \u00b7 default view \u00b7 {}</h2>", order[0],
                                    order[0] < 3 ? "a" : "b", pairTitle(joined.report, first))),
              std::string::npos);
}

}  // namespace
}  // namespace diptych
