// SPDX-License-Identifier: MIT
// tradeoff.json is stated whole: rows with their commands, fronts, metrics, skips, drift and cost.
#include "compare/files/frame_json.h"
#include "compare/run/version.h"
#include "compare/tradeoff/tradeoff.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace diptych::tradeoff {
namespace {

using SweepJson = nlohmann::ordered_json;

TradeoffRow stated(Path path, double ms, double error) {
    TradeoffRow row;
    row.settings.path = path;
    experiment::Row camera{.camera = "door", .blocks = {{ms, ms, ms, 5}, {2 * ms, 2 * ms, 2 * ms, 5}}};
    camera.measured.set(Measure::flip, Errors{error, error, error});
    joinBlocks(camera);
    row.cameras = {camera};
    row.measured.set(Measure::flip, Errors{error, error, error});
    joinCameras(row);
    row.drawing_ms = 10 * ms;
    row.image = "lit.png";
    row.errors_map = "flip.png";
    return row;
}

// Forward+ is exact and slow; deferred is fast, and once worse than before.
Tradeoff statedSweep() {
    Tradeoff sweep;
    sweep.scene = "a b.glb";
    sweep.cameras = {"door", "1"};
    sweep.runs = 5;
    sweep.device = {"a CPU", "1.0", "cpu"};
    sweep.rows = {stated(Path::forward_plus, 8, 0), stated(Path::deferred, 4, 0.25),
                  stated(Path::deferred, 5, 0.5)};
    sweep.rows[2].settings.set("gbuffer", "compact");
    sweep.skips = {{{{"path", "deferred"}, {"msaa", "4"}}, "why"}};
    sweep.notes = {"a note"};
    sweep.reference.path = Path::reference;
    sweep.reference_image = "reference.png";
    sweep.resumed_rows = 7;
    sweep.cost = {.whole = 100, .reading = 1, .reference = 20, .drawing = 30};
    return sweep;
}

TEST(TradeoffJson, ARowIsReadBack) {
    const TradeoffRow row = stated(Path::deferred, 4, 0.25);
    const SweepJson json = jsonOf(row);
    SweepJson expected = experiment::jsonOf(row);
    expected["drawing_ms"] = 40.0;
    expected["picture"] = "lit.png";
    expected["error_picture"] = "flip.png";
    EXPECT_EQ(json.dump(), expected.dump());
    EXPECT_EQ(jsonOf(tradeoffRowFrom(json)).dump(), expected.dump());
}

TEST(TradeoffJson, IsWhole) {
    Tradeoff sweep = statedSweep();
    const auto rowJson = [&](std::size_t i, const SweepJson& differs) {
        const TradeoffRow& row = sweep.rows[i];
        const std::string comparing = comparingCommand(sweep, row);
        SweepJson json{{"row", i + 1}, {"differs", differs}};
        json.update(jsonOf(row));
        json["measure"] = measuringCommand(sweep, row);
        json["render"] = renderingCommand(sweep, row);
        json["compare"] = comparing.empty() ? SweepJson(nullptr) : SweepJson(comparing);
        return json;
    };
    const auto metrics = [](const auto& all) {
        SweepJson list = SweepJson::array();
        for (const auto& one : all)
            list.push_back({{"name", one.name}, {"title", one.title}, {"means", one.means}});
        return list;
    };
    SweepJson fronts = SweepJson::array();
    for (const auto& metric : errorMetrics) {
        fronts.push_back({{"error", metric.name}, {"path", nullptr}, {"rows", {2, 1}}});
        fronts.push_back({{"error", metric.name}, {"path", "deferred"}, {"rows", SweepJson::array({2})}});
        fronts.push_back({{"error", metric.name}, {"path", "forward_plus"}, {"rows", SweepJson::array({1})}});
    }
    const SweepJson forward{{"path", "forward_plus"}}, deferred{{"path", "deferred"}};
    SweepJson compact = deferred;
    compact["gbuffer"] = "compact";
    SweepJson expected{
        {"schema", 1},
        {"software", "diptych"},
        {"commit", commitName()},
        {"device", {{"name", "a CPU"}, {"driver", "1.0"}, {"type", "cpu"}}},
        {"scene", "a b.glb"},
        {"cameras", {"door", "1"}},
        {"runs", 5},
        {"settings", diptych::jsonOf(sweep.requested)},
        {"reference", {{"settings", diptych::jsonOf(sweep.reference)}, {"picture", "reference.png"}}},
        {"errors", metrics(errorMetrics)},
        {"shadow_figures", metrics(shadowMetrics)},
        {"sample_figures", metrics(sampleMetrics)},
        {"rows", {rowJson(0, forward), rowJson(1, deferred), rowJson(2, compact)}},
        {"fronts", fronts},
        {"skipped", {{{"tried", {{"path", "deferred"}, {"msaa", "4"}}}, {"reason", "why"}}}},
        {"notes", {"a note"}},
        {"rows_kept", 7},
        {"second_visit", {{"median", 2.0}, {"min", 2.0}, {"max", 2.0}}},
        {"cost_ms",
         {{"whole", 100.0}, {"reading", 1.0}, {"reference", 20.0}, {"drawing", 30.0}, {"beyond", 49.0}}}};
    EXPECT_EQ(tradeoffJson(sweep).dump(1), expected.dump(1));
    // A single block shows no drift. Another renderer differs in no Setting and is drawn by its own command.
    for (TradeoffRow& row : sweep.rows) row.cameras[0].blocks.resize(1);
    sweep.rows[2].renderer = "cycles";
    const SweepJson other = tradeoffJson(sweep);
    EXPECT_TRUE(other["second_visit"].is_null());
    EXPECT_EQ(other["rows"][2]["differs"], SweepJson::object());
    EXPECT_TRUE(other["rows"][2]["render"].is_null());
}

// The terminal's sentences after the rows.
TEST(TradeoffEnd, SaysWhoseTimesAreAbove) {
    const std::string above =
        "Times above are from each row's first timing block; times in the files are from all "
        "its frames\n";
    Tradeoff sweep = statedSweep();
    EXPECT_NE(tradeoffEnd(sweep).find("  " + above), std::string::npos) << tradeoffEnd(sweep);
    for (TradeoffRow& row : sweep.rows) row.cameras[0].blocks.resize(1);
    EXPECT_EQ(tradeoffEnd(sweep).find(above), std::string::npos);
}

}  // namespace
}  // namespace diptych::tradeoff
