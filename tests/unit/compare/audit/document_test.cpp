// SPDX-License-Identifier: MIT
// What an audit says of made-up measurements: whole texts, tables, JSON and pages.
#include "compare/audit/audit.h"
#include "compare/audit/report.h"
#include "compare/output/writers.h"
#include "tests/support/files.h"
#include "tests/support/page_texts.h"
#include "tests/support/report_builder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <regex>
#include <string>
#include <vector>

namespace diptych::audit {

namespace {

// Deferred fails visibly from 100 m/s on; forward+ has NaN there, and is not drawn at 1000.
const Quantity& speed() {
    static const Quantity quantity{.name = "speed",
                                   .unit = "m/s",
                                   .what = "how fast everything goes",
                                   .magnitudes = {1, 10, 100, 1000},
                                   .apply = [](Case&, const Subject&, double) {}};
    return quantity;
}

Outcome measuredAs(double light, double depth, double flip, double misplaced = 0, double nonfinite = 0) {
    Outcome outcome;
    outcome.measured[Measure::compared_pixels] = 1;
    outcome.measured[Measure::light_p99] = light;
    outcome.measured[Measure::depth_p99] = depth;
    outcome.measured[Measure::flip] = flip;
    outcome.measured[Measure::material_mismatch_pixels] = misplaced;
    outcome.measured[Measure::nonfinite_pixels] = nonfinite;
    outcome.worst_x = 3;
    outcome.worst_y = 4;
    return outcome;
}

QuantityAudit speedAudit() {
    QuantityAudit of;
    of.quantity = &speed();
    of.original = 10;
    of.series = {{Path::deferred, {}}, {Path::forward_plus, {{"ibl", "sampled"}, {"haze", "on"}}}};
    of.omitted = {"forward_plus, gbuffer full draws the same as forward_plus"};
    Outcome infinite = measuredAs(1e-4, 1e-5, 0.01, 0, 1), refused = measuredAs(0, 0, 0);
    refused.failed = "no memory";
    infinite.worst_x = 7;
    of.steps = {{1, {measuredAs(5e-3, 1e-3, 0.01), measuredAs(1e-5, 2e-5, 0)}},
                {10, {measuredAs(1e-4, 2e-4, 0), measuredAs(1e-6, 1e-6, 0)}},
                {100, {measuredAs(0.02, 0.5, 0.25, 12), infinite}},
                {1000, {measuredAs(0.75, 0.5, 0.25, 2), refused}}};
    for (Step& step : of.steps)
        for (std::size_t s = 0; s < 2; ++s) {
            Settings& settings = step.outcomes[s].settings;
            settings.size = {64, 36};
            if (s == 0)
                settings.path = Path::deferred;
            else
                settings.ibl = Ibl::sampled;
        }
    of.valid_ranges = validRangesOf(of.steps, 2, of.original);
    of.predicted = {
        {{{.up = 50, .down = 2, .because = "it has 24 bits"}, {}},
         {{.up = 800, .because = "it has 24 bits"}, {.up = 500, .because = "it ends", .at_most = true}}}};
    of.failures = {{"deferred breaks at 100 m/s", "speed.gltf", "diptych compare speed.gltf"},
                   {"again", "", ""}};
    return of;
}

Audit speedAudited() {
    Audit audit;
    audit.scene = "builtin:fast";
    audit.camera = "default";
    audit.settings.size = {64, 36};
    audit.device = {"A GPU", "driver 1.2", "discrete"};
    audit.notes = {"a note"};
    audit.quantities = {speedAudit()};
    static const Quantity tame{
        .name = "tame", .unit = "", .what = "nothing", .magnitudes = {}, .apply = nullptr};
    QuantityAudit& lacking = audit.quantities.emplace_back();
    lacking.quantity = &tame;
    lacking.lacks = "nothing is wild";
    audit.to_come = {"one", "two"};
    audit.requirements = {{"speed", 100, false, "deferred: the error stays below 1e-2 as far as 10"},
                          {"speed", 10, true}};
    audit.resumed = 5;
    return audit;
}

}  // namespace

TEST(AuditDocument, ATerminalShowsRangesRemarksAndFailures) {
    const Audit audit = speedAudited();
    EXPECT_EQ(
        output::inText(blocksOf(audit.quantities[0])),
        "speed\n"
        "how fast everything goes; 1 to 1e+03 m/s, here 10 m/s\n"
        "  settings                            error below 1e-3  error below 1e-2  not visible  all finite\n"
        "  deferred                            10 to 10          up to 10          up to 10     whole range\n"
        "  forward_plus, ibl sampled, haze on  up to 10          up to 10          whole range  up to 10\n"
        "  deferred: error below 1e-2 was predicted up to 800, which differs from the measurement\n"
        "  forward_plus, ibl sampled, haze on: 1 pixel NaN or infinite at 100 m/s, the first at 7,4\n"
        "  forward_plus, ibl sampled, haze on: not drawn at 1e+03 m/s: no memory\n"
        "  predicted: it has 24 bits\n"
        "  predicted: it ends\n"
        "  no series of its own: forward_plus, gbuffer full draws the same as forward_plus\n"
        "  deferred breaks at 100 m/s\n"
        "  diptych compare speed.gltf\n"
        "  again\n");
    EXPECT_EQ(output::inText(blocksOf(audit.quantities[1])), "tame: not varied: nothing is wild\n");
    EXPECT_EQ(output::inText(closingOf(audit)),
              "FAIL: speed as far as 100: deferred: the error stays below 1e-2 as far as 10\n"
              "pass: speed as far as 10\n");
}

TEST(AuditDocument, TheTableHasEveryStepOfEverySeries) {
    EXPECT_EQ(output::inCsv(stepTable(speedAudited())),
              "quantity,magnitude,unit,path,settings,error,light,depth,flip,misplaced,nonfinite,failed\r\n"
              "speed,1,m/s,deferred,,0.005,0.005,0.001,0.01,0,0,\r\n"
              "speed,1,m/s,forward_plus,ibl=sampled haze=on,2e-05,1e-05,2e-05,0,0,0,\r\n"
              "speed,10,m/s,deferred,,0.0002,0.0001,0.0002,0,0,0,\r\n"
              "speed,10,m/s,forward_plus,ibl=sampled haze=on,1e-06,1e-06,1e-06,0,0,0,\r\n"
              "speed,100,m/s,deferred,,0.5,0.02,0.5,0.25,12,0,\r\n"
              "speed,100,m/s,forward_plus,ibl=sampled haze=on,inf,0.0001,1e-05,0.01,0,1,\r\n"
              "speed,1000,m/s,deferred,,0.75,0.75,0.5,0.25,2,0,\r\n"
              "speed,1000,m/s,forward_plus,ibl=sampled haze=on,0,0,0,0,0,0,no memory\r\n");
}

TEST(AuditDocument, ItsJsonHasEverything) {
    nlohmann::ordered_json json = toJson(speedAudited());
    const nlohmann::ordered_json rows = json["rows"];
    json.erase("settings");
    json.erase("rows");
    const auto range = [](const char* down, const char* up) {
        return R"({"down":)" + std::string(down) + R"(,"up":)" + up + "}";
    };
    const char *at_10 = R"({"last":10.0,"first_beyond":100.0})",
               *from_10 = R"({"last":10.0,"first_beyond":1.0})",
               *from_1 = R"({"last":1.0,"first_beyond":null})",
               *to_100 = R"({"last":100.0,"first_beyond":null})",
               *to_1000 = R"({"last":1000.0,"first_beyond":null})";
    EXPECT_EQ(
        json.dump(),
        R"({"schema":2,"scene":"builtin:fast","camera":"default",)"
        R"("device":{"name":"A GPU","driver":"driver 1.2","type":"discrete"},"notes":["a note"],)"
        R"("steps_kept":5,"to_come":["one","two"],"quantities":[)"
        R"({"quantity":"speed","unit":"m/s","what":"how fast everything goes","usual":10.0,"series":[)"
        R"({"path":"deferred","settings":{},"holds":{"1e-3":)" +
            range(from_10, at_10) + R"(,"1e-2":)" + range(from_1, at_10) + R"(,"visible":)" +
            range(from_1, at_10) + R"(,"finite":)" + range(from_1, to_1000) +
            R"(},"predicted":{"1e-3":{"down":2.0,"up":50.0,"because":"it has 24 bits","at_most":false,)"
            R"("agrees":true},"1e-2":{"down":0.0,"up":800.0,"because":"it has 24 bits","at_most":false,)"
            R"("agrees":false}}},)"
            R"({"path":"forward_plus","settings":{"ibl":"sampled","haze":"on"},"holds":{"1e-3":)" +
            range(from_1, at_10) + R"(,"1e-2":)" + range(from_1, at_10) + R"(,"visible":)" +
            range(from_1, to_100) + R"(,"finite":)" + range(from_1, at_10) +
            R"(},"predicted":{"1e-2":{"down":0.0,"up":500.0,"because":"it ends","at_most":true,)"
            R"("agrees":null}}}],)"
            R"("left_out":["forward_plus, gbuffer full draws the same as forward_plus"],"failures":[)"
            R"({"words":"deferred breaks at 100 m/s","scene":"speed.gltf",)"
            R"("command":"diptych compare speed.gltf"},{"words":"again","scene":"","command":""}]},)"
            R"({"quantity":"tame","unit":"","what":"nothing","not_pushed":"nothing is wild"}],)"
            R"("requirements":[{"quantity":"speed","magnitude":100.0,"met":false,)"
            R"("because":"deferred: the error stays below 1e-2 as far as 10"},)"
            R"({"quantity":"speed","magnitude":10.0,"met":true,"because":""}]})");
    ASSERT_EQ(rows.size(), 8u);
    // Only the Settings in which a row differs from the audit's.
    for (std::size_t i = 0; i < rows.size(); ++i)
        EXPECT_EQ(rows[i]["settings"].dump(), i % 2 == 0 ? R"({"path":"deferred"})" : R"({"ibl":"sampled"})");
    EXPECT_EQ(rows[5]["error"], "infinite");
    EXPECT_EQ(rows[5]["worst"].dump(), "[7,4]");
    EXPECT_EQ(rows[4]["error"], 0.5);
    // A series that fails where the scene is holds nowhere.
    Audit bad = speedAudited();
    for (std::vector<ValidRange>& ranges : bad.quantities[0].valid_ranges) ranges[1].at_original = false;
    EXPECT_EQ(toJson(bad)["quantities"][0]["series"][1]["holds"].dump(),
              R"({"1e-3":null,"1e-2":null,"visible":null,"finite":null})");
}

// The reading accepts pixels as far as 2^20, and -1: no pixel.
TEST(AuditDocument, AStepsWorstPixelIsRead) {
    nlohmann::ordered_json json = toJson(Step{2, {measuredAs(1, 1, 1)}});
    EXPECT_EQ(json["rows"][0]["worst"].dump(), "[3,4]");
    EXPECT_EQ(stepFromJson(json).outcomes.at(0).worst_x, 3);
    EXPECT_EQ(stepFromJson(json).outcomes.at(0).worst_y, 4);
    for (const int component : {0, 1})
        for (const auto& [pixel, read] :
             {std::pair{-2, false}, {-1, true}, {1 << 20, true}, {(1 << 20) + 1, false}}) {
            json["rows"][0]["worst"] = {3, 4};
            json["rows"][0]["worst"][static_cast<std::size_t>(component)] = pixel;
            if (read)
                EXPECT_NO_THROW(stepFromJson(json)) << pixel;
            else
                EXPECT_THROW(stepFromJson(json), std::runtime_error) << pixel;
        }
}

TEST(AuditDocument, ThePageSaysEverything) {
    const std::filesystem::path out = folder() / "audit";
    Audit audit = speedAudited();
    audit.scenes = {{"speed.gltf", "a scene"}};
    writeAudit(audit, out, false);
    const std::string page = contentsOf(out / "index.html");
    EXPECT_EQ(
        pageTexts(page),
        "Diptych\nfail\n builtin:fast\n"
        "where each path breaks, varying one quantity at a time; 64x36 on A GPU (driver 1.2); \ndefault\n"
        "FAIL: speed as far as 100: deferred: the error stays below 1e-2 as far as 10\n"
        "pass: speed as far as 10\n"
        "Range in which each path holds\n"
        "quantity\nsettings\nerror below 1e-3\nerror below 1e-2\nnot visible\nall finite\n"
        "predicted, 1e-3\npredicted, 1e-2\n"
        "speed\ndeferred\n10 to 10\nup to 10\nup to 10\nwhole range\n2 to 50\nup to 800\n"
        "speed\nforward_plus, ibl sampled, haze on\nup to 10\nup to 10\nwhole range\nup to 10\n"
        "at most up to 500\n"
        "The error is the larger of two 99th percentiles over the pixels that show a surface: of lit against "
        "a "
        "double-precision reference that shades the surfaces forward+ captures, and of view depth against "
        "rays "
        "traced in double precision. An error is not visible if the mean HDR-FLIP is below 0.05. Predictions "
        "say how far float32 and double should hold if Settings add no other rounding. A prediction agrees "
        "with a measurement within a factor of 2.\n"
        "Error by magnitude\nspeed\nhow fast everything goes; 1 to 1e+03 m/s, here 10 m/s\n"
        "deferred: error below 1e-2 was predicted up to 800, which differs from the measurement\n"
        "forward_plus, ibl sampled, haze on: 1 pixel NaN or infinite at 100 m/s, the first at 7,4\n"
        "forward_plus, ibl sampled, haze on: not drawn at 1e+03 m/s: no memory\n"
        "predicted: it has 24 bits\npredicted: it ends\n"
        "no series of its own: forward_plus, gbuffer full draws the same as forward_plus\n"
        "deferred breaks at 100 m/s\ndiptych compare speed.gltf\ncopy\nagain\n"
        "Notes\na note\nstill being measured: one, two\ntame: not varied: nothing is wild\n"
        "audit.csv\n \naudit.json\n \nrows.csv\n \nspeed.gltf\n \nspeed.svg\n ");
    // What is broken is marked: 3 and 3 of the criteria, and a prediction.
    EXPECT_EQ(countOf(page, "<td class=\"broken\""), 7u) << page.substr(page.find("<table"), 3000);
    EXPECT_EQ(countOf(page, "href=\"#speed\""), 2u);
    EXPECT_EQ(countOf(page, "id=\"speed\""), 1u);
    EXPECT_EQ(countOf(page, "title=\"it has 24 bits\""), 2u);
    EXPECT_EQ(countOf(page, "<svg class=\"chart\""), 1u);
    EXPECT_EQ(contentsOf(out / "speed.gltf"), "a scene");
    EXPECT_EQ(contentsOf(out / "audit.csv"), output::inCsv(stepTable(audit)));
    EXPECT_EQ(contentsOf(out / "speed.svg"), auditPlot(audit.quantities[0], PlotTarget::file));
    EXPECT_FALSE(std::filesystem::exists(out / "tame.svg")) << "nothing to draw";
    EXPECT_EQ(countOf(contentsOf(out / "rows.csv"), "\r\n"), 9u);
    // Without requirements there is no verdict.
    audit.requirements.clear();
    audit.to_come.clear();
    writeAudit(audit, out, true);
    const std::string texts = pageTexts(contentsOf(out / "index.html"));
    for (const char* gone : {"pass", "fail", "still being measured: one, two"})
        EXPECT_EQ(texts.find(gone), texts.npos) << gone;
}

// On both axes logarithmic, magnitudes from 1 to 1000 and errors from 1e-8 to 100.
TEST(AuditDocument, ThePlotSaysEachPoint) {
    const std::string plot = auditPlot(speedAudit(), PlotTarget::file);
    std::vector<std::string> titles;
    static const std::regex title("<g class=\"point\"><title>([^<]*)</title>");
    for (std::sregex_iterator i(plot.begin(), plot.end(), title), end; i != end; ++i)
        titles.push_back((*i)[1]);
    EXPECT_EQ(
        titles,
        (std::vector<std::string>{
            "forward_plus, ibl sampled, haze on: 1 m/s: error 2e-05 (light 1e-05, depth 2e-05), FLIP 0",
            "forward_plus, ibl sampled, haze on: 10 m/s: error 1e-06 (light 1e-06, depth 1e-06), FLIP 0",
            "forward_plus, ibl sampled, haze on: 100 m/s: error inf (light 0.0001, depth 1e-05), FLIP 0.01, "
            "1 pixel NaN or infinite",
            "forward_plus, ibl sampled, haze on: 1e+03 m/s: error 0 (light 0, depth 0), FLIP 0",
            "deferred: 1 m/s: error 0.005 (light 0.005, depth 0.001), FLIP 0.01",
            "deferred: 10 m/s: error 0.0002 (light 0.0001, depth 0.0002), FLIP 0",
            "deferred: 100 m/s: error 0.5 (light 0.02, depth 0.5), FLIP 0.25",
            "deferred: 1e+03 m/s: error 0.75 (light 0.75, depth 0.5), FLIP 0.25"}));
    for (const char* text : {">speed, m/s<", ">relative error<", ">error below 1e-3<", ">error below 1e-2<",
                             ">magnitude in the scene<", "<title>error over speed</title>"})
        EXPECT_EQ(countOf(plot, text), 1u) << text;
    // Errors beyond 1e-8 and 100 are at the ends; the limits are at 1e-3, 1e-2 and, across, at 10.
    QuantityAudit of = speedAudit();
    of.steps[0].outcomes[0].measured[Measure::light_p99] = 1e3;
    of.steps[1].outcomes[0].measured[Measure::light_p99] =
        of.steps[1].outcomes[0].measured[Measure::depth_p99] = 1e-9;
    of.steps[2].outcomes[0].measured[Measure::light_p99] = 100;
    of.steps[3].outcomes[0].measured[Measure::light_p99] =
        of.steps[3].outcomes[0].measured[Measure::depth_p99] = 1e-8;
    const std::string clamped = auditPlot(of, PlotTarget::page);
    static const std::regex mark("<circle class=\"mark\" cx=\"([0-9.]+)\" cy=\"([0-9.]+)\"");
    std::vector<std::string> heights;
    for (std::sregex_iterator i(clamped.begin(), clamped.end(), mark), end; i != end; ++i)
        heights.push_back((*i)[2]);
    ASSERT_GE(heights.size(), 4u);
    EXPECT_EQ(heights[0], heights[2]);
    EXPECT_EQ(heights[1], heights[3]);
    EXPECT_NE(heights[0], heights[1]);
}

}  // namespace diptych::audit
