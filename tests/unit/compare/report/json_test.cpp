// SPDX-License-Identifier: MIT
// report.json is stated whole: every key of a comparison, of the closer path, and around them.
#include "compare/report/json.h"
#include "compare/files/frame_json.h"
#include "compare/report/trends.h"
#include "shared/text/json.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <limits>

namespace diptych {
namespace {

using OrderedJson = nlohmann::ordered_json;

constexpr double noLimit = std::numeric_limits<double>::infinity();

// Two Frames with one channel of two pixels.
Report statedReport() {
    Report report;
    report.device = {"a CPU", "1.0", "cpu"};
    for (const char* name : {"deferred", "forward_plus"}) {
        Frame& frame = report.frames.emplace_back();
        frame.name = name;
        frame.scene = "<a>.glb";
        frame.settings.size = {2, 1};
        frame.channels[Channel::texcoords] = Image(2, 1, 2, 0.5f);
    }
    report.frames[1].channels[Channel::texcoords].at(1, 0, 1) = std::numeric_limits<float>::infinity();
    Comparison& one = report.comparisons.emplace_back();
    one.test = 1;
    one.coverage.count = 2;
    ChannelDiff& channel = one.channels.emplace_back();
    channel.mode = &debugMode(Channel::texcoords);
    return report;
}

// The elements of an array of report.json.
OrderedJson elementsOf(const Report& report, std::size_t array) {
    return parseOrderedJson("[" + arrayText(report, nullptr, array) + "]");
}
std::string channelText(const Report& report) {
    return elementsOf(report, 1)[0]["channels"][0].dump();
}

TEST(ReportJson, AChannelIsWhole) {
    Report report = statedReport();
    ChannelDiff& c = report.comparisons[0].channels[0];
    const std::string name = R"({"number":9,"name":"texcoords","metric":"absolute",)";
    c.tolerance = {noLimit, "why"};
    EXPECT_EQ(channelText(report),
              name + R"("max":0.0,"mean":0.0,"rmse":0.0,"p99":0.0,"p999":0.0,"flip":null,"worst_pixel":null,)"
                     R"("tolerance":null,"because":"why","verdict":"pass","criterion":null,"figures":{},)"
                     R"("different_pixels":0,"infinite_pixels":0,"nonfinite_pixels":{"baseline":0,"test":0},)"
                     R"("unexplained_pixels":null})");
    c.stats = {.max = noLimit,
               .mean = 0.25,
               .rmse = 0.5,
               .p99 = 0.75,
               .p999 = 1.5,
               .worst_x = 1,
               .worst_y = 0,
               .different = 3,
               .infinite = 2,
               .nonfinite_baseline = 4,
               .nonfinite_test = 5};
    c.flip = 0.125;
    c.tolerance.max = 0.0625;
    c.verdict = Verdict::fail;
    c.rule = "rule 1";
    c.warning = "warned";
    c.reason = "too much";
    c.criterion = {.metric = "max", .measured = noLimit, .limit = 1, .pixels = 6, .fraction = 0.5};
    c.metrics = {{"max", noLimit}, {"psnr", 40}};
    c.unexplained_pixels = 7;
    c.certain_p999 = 0.375;
    c.approximation_errors = {{"split IBL", "--ibl sampled", 0.25, 0.5}, {"haze", "", 1, 2}};
    c.footprints = Footprints{.smooth = 11,
                              .glass = 12,
                              .beyond = 13,
                              .used = noLimit,
                              .x = 14,
                              .y = 15,
                              .max = 16,
                              .detailed = 17,
                              .flip = 18,
                              .edges = 19};
    c.encoding_use =
        BoundUse{.used = noLimit, .x = 20, .y = 21, .beyond = 22, .max = noLimit, .mean = noLimit};
    c.device_use = BoundUse{.used = 0.5, .x = 23, .y = 24, .beyond = 25, .max = 26, .mean = 27};
    const OrderedJson whole = elementsOf(report, 1)[0]["channels"][0];
    EXPECT_EQ(
        whole.dump(),
        name +
            R"("max":null,"mean":0.25,"rmse":0.5,"p99":0.75,"p999":1.5,"flip":0.125,"worst_pixel":[1,0],)"
            R"("tolerance":0.0625,"because":"why","verdict":"fail","rule":"rule 1","warning":"warned",)"
            R"("reason":"too much","criterion":{"figure":"max","measured":null,"limit":1.0,"pixels_beyond":6,)"
            R"("share_beyond":0.5},"figures":{"max":null,"psnr":40.0},"different_pixels":3,"infinite_pixels":2,)"
            R"("nonfinite_pixels":{"baseline":4,"test":5},"granted":[{"approximation":"split IBL","mean":0.25,)"
            R"("p999":0.5,"setting":"--ibl sampled"},{"approximation":"haze","mean":1.0,"p999":2.0,)"
            R"("setting":null}],"unexplained_pixels":7,)"
            R"("footprints":{"smooth":11,"beyond":13,"used":null,"pixel":[14,15],"most":16.0,"detailed":17,)"
            R"("flip":18.0,"edges":19},"encoding":{"used":null,"beyond_pixels":22,"most":null,"mean":null,)"
            R"("pixel":[20,21]},"across_devices":{"used":0.5,"beyond_pixels":25,"most":26.0,"mean":27.0,)"
            R"("pixel":[23,24]},"worst_values":{"baseline":[0.5,0.5],"test":[0.5,null]}})");
    // A limit from below, of a metric of all pixels.
    c.criterion = {.metric = "psnr",
                   .measured = 30,
                   .limit = noLimit,
                   .min = true,
                   .pixels = 6,
                   .fraction = 0.5,
                   .differing = true};
    EXPECT_EQ(elementsOf(report, 1)[0]["channels"][0]["criterion"].dump(),
              R"({"figure":"psnr","measured":30.0,"least":null,"differing_pixels":6,"differing_share":0.5})");
    // What only one side has.
    c.verdict = Verdict::forward_only;
    EXPECT_EQ(channelText(report),
              name + R"("max":null,"mean":null,"rmse":null,"p99":null,"p999":null,"flip":0.125,)"
                     R"("worst_pixel":null,"tolerance":null,"because":"why","verdict":"forward-only",)"
                     R"("rule":"rule 1","warning":"warned"})");
}

TEST(ReportJson, AComparisonIsWhole) {
    Report report = statedReport();
    Comparison& one = report.comparisons[0];
    one.channels.clear();
    const std::string camera = jsonOf(report.frames[0].camera).dump(),
                      start = R"({"scene":"<a>.glb","camera":)" + camera +
                              R"(,"baseline":"deferred","test":"forward_plus",)";
    EXPECT_EQ(elementsOf(report, 1)[0].dump(),
              start + R"("verdict":"pass","covered_pixels":2,"command":[],"differing_settings":{},)"
                      R"("emptiness":null,"after_blending":null,"failures":[],"notes":[],"channels":[],)"
                      R"("explanation":null,"marks":[],"marks_found":{}})");
    one.command = {"compare", "a b"};
    one.differing = {{"ibl", "split", "sampled"}, {"msaa", "1", "4"}};
    one.emptiness = "black";
    one.after_blending = AfterBlending{
        .covered = 1, .before = 2, .pixels = 4, .allowed = 3, .largest = noLimit, .x = 5, .y = 6};
    one.failures = {"one", "two"};
    one.notes = {"note"};
    one.explained = Explained{{}, R"({"causes": [1]})", {}};
    one.visual_checks = {{"skins", 9, {{"right", "name", "where", {1, 2, 3, 4}, 5}}}, {"masks", 0, {}}};
    const auto blended = [](int allowed, const char* largest, const char* verdict) {
        return fmt::format(R"({{"blended_pixels":1,"pixels_before":2,"pixels":4,"pixels_allowed":{},)"
                           R"("largest":{},"pixel":[5,6],"verdict":"{}"}})",
                           allowed, largest, verdict);
    };
    EXPECT_EQ(
        elementsOf(report, 1)[0].dump(),
        start +
            R"("verdict":"fail","covered_pixels":2,"command":["compare","a b"],"differing_settings":)"
            R"({"ibl":["split","sampled"],"msaa":["1","4"]},"emptiness":"black","after_blending":)" +
            blended(3, "null", "fail") +
            R"(,"failures":["one","two"],"notes":["note"],"channels":[],"explanation":{"causes":[1]},)"
            R"("marks":[{"feature":"skins","what":"right","where":"where","box":[1,2,3,4],"pixels":5}],)"
            R"("marks_found":{"skins":9,"masks":0}})");
    one.after_blending->allowed = 4;
    one.after_blending->largest = 0.5;
    EXPECT_EQ(elementsOf(report, 1)[0]["after_blending"].dump(), blended(4, "0.5", "pass"));
}

TEST(ReportJson, TheCloserPathIsWhole) {
    Report report = statedReport();
    report.frames.push_back(report.frames[0]);
    report.frames[2].name = "reference";
    report.frames[2].scene = "r";
    CloserPath& closer = report.closer_paths.emplace_back(CloserPath{2, {0, 1}, {}});
    const std::string start = R"({"scene":"r","camera":)" + jsonOf(report.frames[2].camera).dump();
    EXPECT_EQ(elementsOf(report, 2)[0].dump(), start + R"(,"channels":[]})");
    CloserPathChannel& channel = closer.channels.emplace_back();
    channel.mode = &debugMode(Channel::lit);
    int next = 1;
    for (PathError* error : {&channel.paths[0], &channel.paths[1], &channel.between}) {
        for (double* value : {&error->stats.mean, &error->stats.max, &error->stats.rmse, &error->stats.p99,
                              &error->stats.p999, &error->relative_rmse})
            *value = next++;
        error->flip = next++;
    }
    channel.between.flip.reset();
    channel.closer_pixels = {31, 32};
    channel.even_pixels = 33;
    channel.by = noLimit;
    channel.materials = {{4, "<gold>", 34, {0.25, noLimit}}};
    const auto errors = [](int first, const char* flip) {
        return fmt::format(
            R"({{"mean":{}.0,"max":{}.0,"rmse":{}.0,"p99":{}.0,"p999":{}.0,"relative_rmse":{}.0,)"
            R"("flip":{}}})",
            first, first + 1, first + 2, first + 3, first + 4, first + 5, flip);
    };
    const auto whole = [&](const std::string& nearer, const std::string& by) {
        return start + R"(,"channels":[{"name":"lit","nearer":)" + nearer + R"(,"by":)" + by +
               R"(,"error":{"deferred":)" + errors(1, "7.0") + R"(,"forward_plus":)" + errors(8, "14.0") +
               R"(},"between":)" + errors(15, "null") +
               R"(,"nearer_pixels":{"deferred":31,"forward_plus":32,"even":33},"materials":[{"id":4,)"
               R"("name":"<gold>","pixels":34,"mean":{"deferred":0.25,"forward_plus":null}}]}]})";
    };
    EXPECT_EQ(elementsOf(report, 2)[0].dump(), whole("null", "null"));
    channel.by = 2.5;
    for (const int closer_path : {0, 1}) {
        channel.closer = closer_path;
        EXPECT_EQ(elementsOf(report, 2)[0].dump(),
                  whole(closer_path == 0 ? R"("deferred")" : R"("forward_plus")", "2.5"));
    }
}

// The text around arrays, which come in pieces.
TEST(ReportJson, ItsHeadAndTailAreWhole) {
    Report report = statedReport();
    ReportLayout layout;
    std::vector<DrawnOn> devices{{{"a CPU", "1.0", "cpu"}, 3, 1.5, 2.5}};
    std::vector<std::vector<std::string>> pieces{{}, {"[1", "", "2]"}, {""}};
    const auto text = [&](const ReportLayout* of, const Trends* since = nullptr) {
        std::string all;
        writeReportJson(
            report, of, devices, since,
            [&](std::size_t array, const JsonSink& add) {
                for (const std::string& piece : pieces.at(array)) add(piece);
            },
            [&](std::string_view piece) { all += piece; });
        return all;
    };
    const auto device = [](const std::string& name, const std::string& times) {
        return "    {\n      \"name\": \"" + name +
               "\",\n      \"driver\": \"1.0\",\n      \"type\": \"cpu\",\n" + times + "\n    }";
    };
    const auto head = [&](const std::string& verdict, const std::string& drawn, const std::string& first,
                          const std::string& against = "") {
        return "{\n  \"schema\": 1,\n  \"software\": \"diptych\",\n  \"verdict\": \"" + verdict +
               "\",\n  \"device\": {\n    \"name\": \"a CPU\",\n    \"driver\": \"1.0\",\n    \"type\": "
               "\"cpu\"\n"
               "  },\n  \"devices\": [\n" +
               drawn + "\n  ],\n  \"said_first\": " + first + against +
               ",\n  \"frames\": [],\n  \"comparisons\": [\n[1,\n2]\n  ],\n  \"truth\": [],\n";
    };
    const std::string once = device("a CPU", "      \"comparisons\": 3,\n      \"compare_ms\": 1.5"),
                      timed = device("a CPU",
                                     "      \"comparisons\": 3,\n      \"compare_ms\": 1.5,\n"
                                     "      \"encode_ms\": 2.5");
    EXPECT_EQ(text(nullptr), head("pass", once, "[]") +
                                 "  \"compare_ms\": 1.5,\n  \"errors\": [],\n  \"failures\": []\n}\n");
    EXPECT_EQ(text(&layout),
              head("pass", timed, "[]") +
                  "  \"compare_ms\": 1.5,\n  \"errors\": [],\n  \"failures\": [],\n"
                  "  \"encode_ms\": 2.5,\n  \"files\": [\n    \"index.html\",\n    \"junit.xml\",\n"
                  "    \"report.json\"\n  ]\n}\n");
    // Times of several devices are not added.
    devices.push_back({{"b", "1.0", "cpu"}, 1, 8, 9});
    report.first_notes = {"first"};
    report.errors = {{"a", "is short"}, {"b", "failed", "cycles", "said"}};
    report.against = {"c", "2.0", "gpu"};
    const auto error = [](const std::string& members) { return "    {\n" + members + "\n    }"; };
    const std::string errors = "  \"errors\": [\n" +
                               error("      \"scene\": \"a\",\n      \"message\": \"is short\"") + ",\n" +
                               error(
                                   "      \"scene\": \"b\",\n      \"message\": \"failed\",\n"
                                   "      \"renderer\": \"cycles\",\n      \"output\": \"said\"") +
                               "\n  ],\n";
    EXPECT_EQ(
        text(&layout),
        head("fail",
             timed + ",\n" +
                 device("b",
                        "      \"comparisons\": 1,\n      \"compare_ms\": 8.0,\n      \"encode_ms\": 9.0"),
             "[\n    \"first\"\n  ]",
             ",\n  \"against_device\": {\n    \"name\": \"c\",\n    \"driver\": \"2.0\",\n    \"type\": "
             "\"gpu\"\n"
             "  }") +
            "  \"compare_ms\": null,\n" + errors +
            "  \"failures\": [],\n  \"encode_ms\": null,\n"
            "  \"files\": [\n    \"index.html\",\n    \"junit.xml\",\n    \"report.json\"\n  ]\n}\n");
    // A failure without a comparison; changes since then; pieces from elsewhere are escaped.
    report.errors.clear();
    report.against = {};
    report.first_notes.clear();
    devices.pop_back();
    report.failures = {{"d", "is in A only"}};
    const Trends since{"old", "", {}, {}};
    EXPECT_EQ(text(nullptr, &since),
              head("fail", once, "[]") + "  \"compare_ms\": 1.5,\n  \"errors\": [],\n  \"failures\": [\n" +
                  error("      \"scene\": \"d\",\n      \"message\": \"is in A only\"") +
                  "\n  ],\n  \"since\": {\n    \"report\": \"old\",\n    \"device\": null,\n    "
                  "\"comparisons\": [],\n"
                  "    \"gone\": []\n  }\n}\n");
    pieces[0] = {"\"\u009b\""};
    EXPECT_NE(text(nullptr).find("\"frames\": [\n\"\\u009b\"\n  ]"), std::string::npos);
    EXPECT_EQ(arrayText(report, nullptr, 2), "");
    EXPECT_TRUE(arrayText(report, nullptr, 1).starts_with("    {\n      \"scene\": \"<a>.glb\","))
        << "indented as in the whole";
}

}  // namespace
}  // namespace diptych
