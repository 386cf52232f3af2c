// SPDX-License-Identifier: MIT
// A channel on one side only is reported by name, and fails if both sides must have the same channels.
#include "compare/cli/command_compare.h"
#include "compare/cli/command_diff.h"
#include "compare/files/frame_exr.h"
#include "compare/report/image_diff_json.h"
#include "compare/report/image_diff_report.h"
#include "compare/report/json.h"
#include "compare/report/report.h"
#include "compare/verdict/image_diff.h"
#include "shared/image/exr.h"
#include "tests/support/command_lines.h"
#include "tests/support/errors.h"
#include "tests/support/files.h"
#include "tests/support/report_builder.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace diptych {
namespace {

using Lines = std::vector<std::string>;
const ReportDevice strictDevice{"a CPU", "1.0", "cpu"};

// Both paths with a few channels of every type.
std::vector<Frame> fewChannels() {
    std::set<Channel> kept{Channel::lit, Channel::albedo, Channel::metallic, Channel::material_id};
    for (const DebugMode& mode : debugModes())
        if (mode.supported_by != SupportedBy::both) kept.insert(mode.channel);
    return withOnly(kept, bothFrames());
}

// An earlier deferred Frame.
Frame earlierFrame() {
    Frame baseline = fewChannels()[0];
    baseline.name = "baseline";
    baseline.origin = {"b.exr", "a CPU", "1.0", "abc"};
    return baseline;
}

CompareOptions strictly(bool strict) {
    CompareOptions options;
    options.strict = strict;
    return options;
}

// Both paths against an earlier deferred Frame without the channels `without`, and with an additional one
// if `more` names it.
Report againstBaseline(const std::vector<Channel>& without, const std::string& more, bool strict) {
    Frame baseline = earlierFrame();
    if (!more.empty()) baseline.origin.omitted_channels = {more};
    for (const Channel mode : without) baseline.channels.erase(mode);
    return makeReport({{fewChannels()}}, strictDevice, strictly(strict), baseline);
}

TEST(Strict, AChannelOfOneSideIsSaidAndFailsOnlyWhereAsked) {
    for (const bool strict : {false, true}) {
        const Report report = againstBaseline({Channel::albedo}, "", strict);
        EXPECT_EQ(report.passed(), !strict);
        for (const std::size_t pair : {0u, 1u}) {
            const Comparison& c = report.comparisons.at(pair);
            const std::string name = pair == 0 ? "deferred" : "forward_plus";
            const Lines said{"albedo is in " + name +
                             (strict ? " only, but --strict requires the same channels on both sides"
                                     : " only: not compared")};
            EXPECT_EQ(c.failures, strict ? said : Lines{}) << pair;
            EXPECT_EQ(c.notes, strict ? Lines{} : said) << pair;
        }
        EXPECT_TRUE(report.comparisons.at(2).passed()) << "the paths have the same channels";
        const std::string table = reportTable(report), file = report.frames[0].name,
                          pairs = file + "/deferred, builtin:one " + file + "/forward_plus";
        const std::string line = strict ? "  FAIL builtin:one: albedo is in forward_plus only, but --strict"
                                        : "\nnote: albedo is in forward_plus only: not compared\n";
        EXPECT_NE(table.find(line), std::string::npos) << table;
        EXPECT_EQ(countOf(table, "albedo is in forward_plus only"), 1u) << table;
        EXPECT_EQ(table.find("\nFAIL: 2 of 3 comparisons failed: builtin:one " + pairs +
                             " (albedo is in deferred only, but --strict requires the same channels on both "
                             "sides), and 1 more\n") != table.npos,
                  strict)
            << table;
        const auto json = nlohmann::json::parse(reportJson(report, nullptr));
        EXPECT_EQ(json["verdict"], strict ? "fail" : "pass");
        EXPECT_EQ(json["comparisons"][0][strict ? "failures" : "notes"].size(), 1u);
        const std::string junit = reportJunit(report, layoutOf(report, {}), "out");
        EXPECT_EQ(countOf(junit, "<failure "), strict ? 2u : 0u);
        EXPECT_EQ(countOf(junit, "message=\"albedo is in deferred only, but --strict requires"),
                  strict ? 1u : 0u);
        EXPECT_NE(junit.find("albedo is in deferred only"), std::string::npos) << junit;
    }
}

TEST(Strict, EitherSideMayLackIt) {
    std::vector<Frame> frames = fewChannels();
    frames[1].channels.erase(Channel::metallic);
    const Report report = makeReport({{frames}}, strictDevice, strictly(true));
    EXPECT_EQ(report.comparisons[0].failures,
              Lines{"metallic is in deferred only, but --strict requires the same channels on both sides"});
    EXPECT_FALSE(report.passed());
}

// Channels that only forward+ supports are not a difference between the paths.
TEST(Strict, ForwardOnlyIsNoFailure) {
    const Report report = makeReport({{fewChannels()}}, strictDevice, strictly(true));
    EXPECT_TRUE(report.passed());
    EXPECT_TRUE(againstBaseline({}, "", true).passed()) << "an earlier deferred Frame lacks it by nature";
}

// Our reference never has light lists; another renderer's file lacks them like any other channel.
TEST(Strict, WhatOurReferenceCannotHaveIsNoFailure) {
    for (const bool ours : {true, false}) {
        Frame baseline = earlierFrame();
        baseline.settings.path = Path::reference;
        baseline.origin = {"b.exr", ours ? "a CPU" : "", "", ""};
        for (const DebugMode& mode : debugModes())
            if (mode.supported_by == SupportedBy::paths_only) baseline.channels.erase(mode.channel);
        const Report report = makeReport({{fewChannels()}}, strictDevice, strictly(true), baseline);
        Lines said, pathsOnly;
        for (const DebugMode& mode : debugModes())
            if (mode.supported_by == SupportedBy::paths_only) pathsOnly.emplace_back(mode.name);
        EXPECT_GT(pathsOnly.size(), 1u);
        for (const DebugMode& mode : debugModes()) {
            const std::string line =
                std::string(mode.name) +
                " is in deferred only, but --strict requires the same channels on both sides";
            if (std::ranges::count(report.comparisons[0].failures, line) > 0) said.emplace_back(mode.name);
        }
        EXPECT_EQ(said, ours ? Lines{} : pathsOnly) << nlohmann::json(report.comparisons[0].failures);
    }
}

TEST(Strict, OnlyChannelsThatWereAskedForCount) {
    for (const bool asked : {false, true}) {
        Frame baseline = earlierFrame();
        baseline.origin.omitted_channels = {"mystery"};
        baseline.channels.erase(Channel::albedo);
        std::vector<Frame> frames = fewChannels();
        baseline.requested = frames[0].requested = frames[1].requested = {Channel::lit};
        if (asked)
            for (Frame* frame : {&baseline, &frames[0], &frames[1]})
                frame->requested.push_back(Channel::albedo);
        const Report report = makeReport({{frames}}, strictDevice, strictly(true), baseline);
        EXPECT_EQ(report.passed(), !asked);
    }
}

// A baseline's unknown channels are read and named.
TEST(Strict, AChannelOfTheBaselineThatWeDoNotKnowIsSaid) {
    const std::filesystem::path file = folder() / "b.exr";
    const Image lit(4, 3, 3, 0.5f), other(4, 3, 1, 1.0f);
    writeExr(file, {{{"R", "G", "B"}, &lit}, {{"mystery.Y"}, &other}});
    Frame baseline = frameFromExr(file);
    EXPECT_EQ(baseline.origin.omitted_channels, Lines{"mystery"});
    for (const bool strict : {false, true}) {
        const Report report = makeReport({{fewChannels()}}, strictDevice, strictly(strict), baseline);
        const Comparison& c = report.comparisons[0];
        EXPECT_EQ(std::ranges::count(strict ? c.failures : c.notes,
                                     "mystery of baseline: not compared, Diptych has no such channel"),
                  1);
    }
    EXPECT_FALSE(againstBaseline({}, "mystery", true).passed());
    EXPECT_TRUE(againstBaseline({}, "mystery", false).passed());
}

// ---- Two files ----

ImageDiff diffOf(const std::vector<std::string>& left, const std::vector<std::string>& right, bool strict,
                 const std::vector<std::string>& channels = {}) {
    const std::filesystem::path here = folder();
    const Image grey(4, 3, 1, 0.5f);
    for (const auto& [file, names] : {std::pair{"a.exr", left}, {"b.exr", right}}) {
        std::vector<ExrLayerView> layers;
        for (const std::string& name : names) layers.push_back({{name + ".Y"}, &grey});
        writeExr(here / file, layers);
    }
    ImageDiffOptions options;
    options.strict = strict;
    options.channels = channels;
    return diffImages((here / "a.exr").string(), (here / "b.exr").string(), options);
}

TEST(Strict, DiffSaysWhichFileLacksWhat) {
    for (const bool strict : {false, true}) {
        const ImageDiff diff = diffOf({"metallic", "one"}, {"metallic", "other"}, strict);
        const std::string ending =
            strict ? ", but --strict requires the same channels on both sides" : ": not compared";
        const Lines said{"one is in the reference only" + ending, "other is in the test only" + ending};
        EXPECT_EQ(diff.passed(), !strict);
        EXPECT_EQ(strict ? diff.failures : Lines{}, strict ? said : Lines{});
        EXPECT_TRUE((strict ? diff.failures : diff.notes).size() >= 2);
        const std::string table = diffTable({&diff, 1});
        for (const std::string& line : said)
            EXPECT_NE(table.find((strict ? "  FAIL a.exr: " : "\nnote: ") + line + "\n"), std::string::npos)
                << table;
        EXPECT_EQ(table.ends_with("FAIL: " + said[0] + " and 1 more\n"), strict) << table;
        const auto json = nlohmann::json::parse(imageDiffJson(diff));
        EXPECT_EQ(json["verdict"], strict ? "fail" : "pass");
        EXPECT_EQ(json["failures"].size(), strict ? 2u : 0u);
    }
    EXPECT_TRUE(diffOf({"metallic"}, {"metallic"}, true).passed());
    EXPECT_TRUE(diffOf({"metallic", "one"}, {"metallic"}, true, {"metallic"}).passed())
        << "one was not asked for";
    EXPECT_FALSE(diffOf({"metallic", "one"}, {"metallic"}, true).passed());
    EXPECT_FALSE(diffOf({"metallic"}, {"metallic", "one"}, true).passed());
}

// A rule or --channels that names a channel requires it on both sides; a rule for all channels does not.
TEST(Strict, WhatIsNamedIsDemanded) {
    const auto failures = [](const std::string& pattern, std::vector<Channel> required) {
        Frame baseline = earlierFrame();
        baseline.channels.erase(Channel::albedo);
        CompareOptions options;
        options.required = std::move(required);
        if (!pattern.empty())
            options.rules = rulesFromJson(
                R"({"rules": [{"channel": ")" + pattern + R"(", "max": 9, "because": "any"}]})", "t.json");
        const Report report = makeReport({{fewChannels()}}, strictDevice, options, baseline);
        return report.comparisons[0].failures;
    };
    EXPECT_EQ(failures("", {}), Lines{});
    EXPECT_EQ(failures("*", {}), Lines{});
    EXPECT_EQ(failures("lit", {}), Lines{});
    EXPECT_EQ(failures("albedo", {}),
              Lines{"albedo is in deferred only, but t.json, rule 1 needs both sides"});
    EXPECT_EQ(failures("alb*", {}).size(), 1u);
    EXPECT_EQ(failures("", {Channel::lit}), Lines{});
    EXPECT_EQ(failures("", {Channel::albedo}),
              Lines{"albedo is in deferred only, but --channels requests it"});
}

// A rule on a channel that only forward+ supports fails, because nothing can be judged.
TEST(Strict, ARuleOnWhatForwardAloneHasIsNeverMet) {
    CompareOptions options;
    options.rules =
        rulesFromJson(R"({"rules": [{"channel": "texcoords", "max": 9, "because": "any"}]})", "t.json");
    const Report report = makeReport({{fewChannels()}}, strictDevice, options);
    EXPECT_EQ(report.comparisons[0].failures,
              Lines{"texcoords is in forward_plus only, but t.json, rule 1 needs both sides"});
}

TEST(Strict, DiffDemandsWhatARuleNames) {
    const std::filesystem::path here = folder();
    const Image grey(4, 3, 1, 0.5f);
    writeExr(here / "a.exr", {{{"one.Y"}, &grey}, {{"two.Y"}, &grey}});
    writeExr(here / "b.exr", {{{"one.Y"}, &grey}});
    ImageDiffOptions options;
    options.rules = rulesFromJson(R"({"rules": [{"channel": "two", "max": 1, "because": "any"}]})", "t.json");
    const ImageDiff diff = diffImages((here / "a.exr").string(), (here / "b.exr").string(), options);
    EXPECT_EQ(diff.failures, Lines{"two is in the reference only, but t.json, rule 1 needs both sides"});
}

// Empty images pass with a note, and fail with --strict.
TEST(Strict, FailsADiffOfBlackImages) {
    const std::filesystem::path here = folder();
    const Image none(4, 3, 3);
    writeExr(here / "a.exr", {{{"R", "G", "B"}, &none}});
    const auto diff = [&](bool strict, bool allowed) {
        ImageDiffOptions options;
        options.strict = strict;
        options.allow_empty = allowed;
        return diffImages((here / "a.exr").string(), (here / "a.exr").string(), options);
    };
    const std::string line = "both images are black: every compared value is 0";
    EXPECT_TRUE(diff(false, false).passed());
    EXPECT_EQ(diff(false, false).emptiness, line);
    EXPECT_EQ(diff(true, false).failures, Lines{line + "; --allow-empty accepts that"});
    EXPECT_FALSE(diff(true, false).passed());
    EXPECT_TRUE(diff(true, true).passed());
}

// A property that a file declares and nothing applies: non-square pixels. If both files declare it, it
// does not matter.
TEST(Strict, FailsADiffOfPixelsOfTwoShapes) {
    const std::filesystem::path here = folder();
    const std::string pixel("\x80\x80\x80\x81");
    for (const auto& [name, variables] : {std::pair{"a.hdr", ""}, {"b.hdr", "PIXASPECT=2\n"}})
        std::ofstream(here / name, std::ios::binary)
            << ("#?RADIANCE\n" + std::string(variables) + "FORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 1\n" + pixel);
    const auto diff = [&](const char* a, const char* b, bool strict) {
        ImageDiffOptions options;
        options.strict = strict;
        return diffImages((here / a).string(), (here / b).string(), options);
    };
    const std::string line =
        (here / "b.hdr").string() + ": its pixels are not square (aspect 2) but are shown square";
    for (const auto& [a, b] : {std::pair{"a.hdr", "b.hdr"}, {"b.hdr", "a.hdr"}}) {
        EXPECT_EQ(diff(a, b, false).notes, Lines{line});
        EXPECT_EQ(diff(a, b, true).failures, Lines{line});
    }
    EXPECT_TRUE(diff("b.hdr", "b.hdr", true).passed());
}

// The same for a baseline in compare.
TEST(Strict, FailsOverWhatABaselineSaysOfItsPixels) {
    for (const bool strict : {false, true}) {
        Frame baseline = earlierFrame();
        baseline.origin.not_applied = {"its white luminance of 100 cd/m2 is not applied"};
        const Comparison c =
            makeReport({{fewChannels()}}, strictDevice, strictly(strict), baseline).comparisons.at(0);
        EXPECT_EQ(std::ranges::count(strict ? c.failures : c.notes,
                                     baseline.name + ": " + baseline.origin.not_applied[0]),
                  1);
    }
}

// A rule for a channel that neither side has judges nothing, which is a mistake. A pattern without matches
// is not, and neither is a channel that --channels omits.
TEST(Strict, ARuleForAChannelOfNeitherFileFails) {
    const std::filesystem::path here = folder();
    const Image grey(4, 3, 1, 0.5f);
    writeExr(here / "a.exr", {{{"one.Y"}, &grey}, {{"two.Y"}, &grey}});
    ImageDiffOptions options;
    options.channels = {"one"};
    options.rules = rulesFromJson(R"({"rules": [{"channel": "tow", "max": 1, "because": "any"},
                                                {"channel": "three*", "max": 1, "because": "any"},
                                                {"channel": "two", "max": 1, "because": "any"}]})",
                                  "t.json");
    const ImageDiff diff = diffImages((here / "a.exr").string(), (here / "a.exr").string(), options);
    EXPECT_EQ(diff.failures, Lines{"t.json, rule 1: no channel here is called tow; did you mean two?"});
    EXPECT_EQ(diff.notes.back(), "t.json, rule 2: no channel here is called three*");
}

// A rule for a channel of one side is judged there and does not count as unused.
TEST(Strict, ARuleOnAOneSidedChannelIsNotIdle) {
    CompareOptions options;
    options.rules =
        rulesFromJson(R"({"rules": [{"channel": "albedo", "max": 1, "because": "any"}]})", "t.json");
    std::vector<Frame> frames = fewChannels();
    frames[0].channels.erase(Channel::albedo);
    Report report;
    report.device = strictDevice;
    report.frames = std::move(frames);
    const Comparison comparison = compareFrames(report, 0, 1, {}, options);
    EXPECT_EQ(comparison.failures,
              Lines{"albedo is in forward_plus only, but t.json, rule 1 needs both sides"});
    EXPECT_EQ(comparison.notes, Lines{});
}

// compare knows all possible channels.
TEST(Rules, AreRefusedForAChannelThatIsNone) {
    const std::vector<Rule> rules =
        rulesFromJson(R"({"rules": [{"channel": "lit*", "max": 1, "because": "any"},
                                    {"channel": "albdeo", "max": 1, "because": "any"}]})",
                      "t.json");
    const std::vector<std::string> known{"lit", "albedo"};
    EXPECT_NO_THROW(checkChannels(std::span(rules).first(1), known));
    EXPECT_NO_THROW(checkChannels(std::span(rules).first(1), {"other"})) << "a pattern may match nothing";
    const std::string refusal = faultOf([&] { checkChannels(rules, known); });
    EXPECT_EQ(refusal, "t.json, rule 2: no channel is called albdeo; did you mean albedo?");
}

// Both commands have the option, and so does the command that a report prints.
TEST(Strict, IsAnOptionOfCompareAndDiff) {
    const auto check = [](const auto& options) {
        EXPECT_TRUE(options.strict);
        EXPECT_EQ(cli::verdictOptions(options).back(), "--strict");
        EXPECT_FALSE(options.allow_empty);
    };
    check(parsedAs<cli::CompareLine>({"compare", "builtin:points", "--strict"}));
    check(parsedAs<cli::DiffLine>({"diff", "a.exr", "b.exr", "--strict"}));
    for (const char* command : {"compare", "diff"})
        EXPECT_NE(cli::parseCommandLine({command, "--help", "all"}).help.find("--strict"), std::string::npos);
    EXPECT_FALSE(parsedAs<cli::CompareLine>({"compare"}).strict);
    EXPECT_THROW(cli::parseCommandLine({"render", "--strict"}), std::runtime_error);
}

}  // namespace
}  // namespace diptych
