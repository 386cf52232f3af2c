// SPDX-License-Identifier: MIT
// The output of a sweep: table, CSV, JSON, plots and page.
#include "compare/cli/option_groups.h"
#include "compare/output/writers.h"
#include "compare/tradeoff/all_scenes.h"
#include "compare/tradeoff/plot.h"
#include "compare/tradeoff/tables.h"
#include "compare/tradeoff/tradeoff.h"
#include "tests/support/command_lines.h"
#include "tests/support/files.h"
#include "tests/support/nonfinite.h"
#include "tests/support/report_builder.h"
#include "tests/support/setting_samples.h"

#include <gtest/gtest.h>

#include <limits>
#include <map>

namespace diptych {

using namespace cli;
using namespace tradeoff;

namespace {

TradeoffRow row(const char* path, const char* option, const char* value, double ms, const Errors& errors) {
    TradeoffRow made;
    made.settings.set("path", path);
    if (*option) made.settings.set(option, value);
    experiment::Row camera{.camera = "a, \"b\" <c>", .blocks = {{ms, 0.9 * ms, 1.5 * ms, 5}}};
    camera.passes = {{"shade", ms / 2}};
    camera.measured.set(FrameBytes{1000, 200, 24});
    camera.measured.set(Measure::flip, errors);
    joinBlocks(camera);
    made.cameras = {camera};
    made.measured.set(Measure::flip, errors);
    joinCameras(made);
    made.image = made.errors_map = "x.png";
    return made;
}

Tradeoff several() {
    Tradeoff tradeoff;
    tradeoff.scene = "a & b's <scene>.glb";
    tradeoff.cameras = {"0"};
    tradeoff.device = {"llvmpipe", "Mesa", "cpu"};
    tradeoff.runs = 5;
    tradeoff.rows = {row("forward_plus", "", "", 8, {0, 0, 0}),
                     row("deferred", "", "", 4, {0.01, 0.02, 0.04}),
                     row("deferred", "size", "320x180", 1, {0.2, 3, 4}),
                     row("deferred", "gbuffer", "compact", 5, {inf, inf, inf})};
    for (TradeoffRow& made : tradeoff.rows) made.settings.camera = "0";
    tradeoff.requested.camera = "0";
    tradeoff.rows[1].warnings = {"one, \"two\""};
    tradeoff.skips = {{{{"path", "deferred"}, {"msaa-edges", "all"}},
                       "--msaa-edges all has no effect without --msaa 4; use exact"}};
    return tradeoff;
}

// RFC 4180, implemented independently of the writer.
std::vector<std::vector<std::string>> parseCsv(const std::string& text) {
    std::vector<std::vector<std::string>> lines(1, {""});
    bool quoted = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (quoted && c == '"' && text[i + 1] == '"')
            lines.back().back() += text[++i];
        else if (c == '"')
            quoted = !quoted;
        else if (!quoted && c == ',')
            lines.back().emplace_back();
        else if (!quoted && c == '\r' && text[i + 1] == '\n' && i + 2 < text.size())
            ++i, lines.push_back({""});
        else if (quoted || (c != '\r' && c != '\n'))
            lines.back().back() += c;
    }
    return lines;
}

TEST(TradeoffOutput, CsvHasEveryRowAndReadsBack) {
    const auto lines = parseCsv(inCsv(csvTable(several())));
    ASSERT_EQ(lines.size(), 5u);
    for (const auto& line : lines) EXPECT_EQ(line.size(), lines[0].size());
    const auto at = [&](std::size_t line, const std::string& name) {
        const auto column = std::ranges::find(lines[0], name) - lines[0].begin();
        return lines[line][static_cast<std::size_t>(column)];
    };
    EXPECT_EQ(at(2, "ms_max"), "6");
    EXPECT_EQ(at(2, "warnings"), "one, \"two\"");
    EXPECT_EQ(at(4, "flip"), "inf");
    EXPECT_EQ(at(4, "front_flip"), "0");
    EXPECT_EQ(at(3, "front_flip"), "1");
    EXPECT_EQ(at(1, "ms: shade"), "4");
    EXPECT_EQ(at(1, "compare").find("diptych compare --baseline reference"), 0u);
    EXPECT_EQ(at(3, "compare"), "") << "not as large as the reference";
    Tradeoff external = several();
    external.rows[0].renderer = "three";
    external.rows[0].measured = {};
    const auto other = parseCsv(inCsv(csvTable(external)));
    const auto column = std::ranges::find(other[0], "image_bytes") - other[0].begin();
    EXPECT_EQ(other[1][static_cast<std::size_t>(column)], "0") << "of another renderer";
}

// Settings that the path ignores have no value.
TEST(TradeoffOutput, EveryColumnOfTheCsvHasItsOwnValue) {
    const auto valueOf = [](experiment::Measure measure) {
        return std::to_string(100 + static_cast<std::size_t>(measure));
    };
    for (const Path path : drawn_paths) {
        Tradeoff tradeoff = several();
        tradeoff.rows.resize(1);
        TradeoffRow& row = tradeoff.rows[0];
        row.settings = everythingChanged();
        row.settings.path = path;
        row.cameras.clear();  // no spread
        for (std::size_t i = 0; i < experiment::measures.size(); ++i)
            row.measured[static_cast<experiment::Measure>(i)] = 100 + static_cast<double>(i);
        std::map<std::string, std::string> expected{
            {"row", "1"},
            {"path", std::string(nameOf(path))},
            {"runs", "5"},
            {"ms", valueOf(Measure::ms)},
            {"ms_min", valueOf(Measure::ms_min)},
            {"ms_max", valueOf(Measure::ms_max)},
            {"image_bytes", valueOf(Measure::image_bytes)},
            {"buffer_bytes", valueOf(Measure::buffer_bytes)},
            {"gbuffer_bytes_per_pixel", valueOf(Measure::gbuffer_bytes)},
            {"ms: shade", "4"},
            {"warnings", ""},
            {"picture", "x.png"},
            {"measure", measuringCommand(tradeoff, row)},
            {"render", renderingCommand(tradeoff, row)},
            {"compare", comparingCommand(tradeoff, row)}};
        for (const Field& field : settingFields())
            if (!field.sweep.empty() && field.option != "path")
                expected[std::string(field.option)] = ignoredBecause(row.settings, field.option).empty()
                                                          ? row.settings.valueOf(field.option)
                                                          : "";
        for (std::size_t i = 0; i < experiment::errorMetrics.size(); ++i) {
            const std::string name(experiment::errorMetrics[i].name);
            for (const char* end : {"", "_min", "_max"}) expected[name + end] = valueOf(Measure::flip + i);
            expected["front_" + name] = "1";
        }
        for (std::size_t i = 0; i < experiment::shadowMetrics.size(); ++i)
            expected["shadow_" + std::string(experiment::shadowMetrics[i].name)] =
                valueOf(Measure::shadow_error + i);
        for (std::size_t i = 0; i < experiment::sampleMetrics.size(); ++i)
            expected["samples_" + std::string(experiment::sampleMetrics[i].name)] =
                valueOf(Measure::shaded + i);
        const auto lines = parseCsv(inCsv(csvTable(tradeoff)));
        std::map<std::string, std::string> found;
        for (std::size_t column = 0; column < lines[0].size(); ++column)
            EXPECT_TRUE(found.emplace(lines[0][column], lines[1].at(column)).second) << lines[0][column];
        EXPECT_EQ(found, expected);
    }
}

// The command line parses the printed commands back to the row's Settings.
TEST(TradeoffOutput, CommandsAreOfTheRow) {
    Tradeoff tradeoff = several();
    tradeoff.scene = "builtin:one";
    const auto wordsIn = [](const std::string& command) {
        std::vector<std::string> words;  // no word here contains a space
        std::string text = command;
        std::erase(text, '\'');
        for (std::size_t from = 0; from <= text.size();) {
            const std::size_t end = std::min(text.find(' ', from), text.size());
            words.push_back(text.substr(from, end - from));
            from = end + 1;
        }
        words.erase(words.begin());
        return words;
    };
    const auto parse = [&](std::size_t row) {
        return parsedAs<SceneGroup>(wordsIn(measuringCommand(tradeoff, tradeoff.rows[row])));
    };
    const auto gridOf = [&](std::size_t row) {
        return parsedAs<GridGroup>(wordsIn(measuringCommand(tradeoff, tradeoff.rows[row]))).grid;
    };
    const SceneGroup full = parse(3);
    EXPECT_EQ(full.settings, tradeoff.rows[3].settings);
    EXPECT_EQ(gridOf(3), R"({"settings":{}})");
    const SceneGroup half = parse(2);
    EXPECT_EQ(half.settings.size, tradeoff.requested.size) << "the reference's";
    EXPECT_EQ(gridOf(2), R"({"settings":{"size":"320x180"}})");
    EXPECT_EQ(parsedAs<SettingsGroup>(wordsIn(renderingCommand(tradeoff, tradeoff.rows[2]))).settings,
              tradeoff.rows[2].settings);
    // Settings that the reference depends on stay as given, except in the row itself.
    tradeoff.rows[1].settings.shadows = Shadows::off;
    tradeoff.requested.spp = 16;
    const SceneGroup shadowed = parse(1);
    EXPECT_EQ(shadowed.settings.shadows, tradeoff.requested.shadows);
    EXPECT_EQ(shadowed.settings.spp, 16);
    EXPECT_EQ(gridOf(1), R"({"settings":{"shadows":"off"}})");
    EXPECT_EQ(comparingCommand(tradeoff, tradeoff.rows[1]), "") << "its reference would have none";
    tradeoff.cameras = {"0", "1"};
    tradeoff.runs = 9;
    const SceneGroup both = parse(1);
    EXPECT_EQ(both.cameras, tradeoff.cameras);
    EXPECT_EQ(both.runs, 9);
}

TEST(TradeoffOutput, RowsSurviveTheirJson) {
    for (TradeoffRow made : several().rows) {
        made.cameras[0].blocks[0].median = 1.0 / 3;
        made.settings.camera = "eye=1,2,3";
        const TradeoffRow back = tradeoffRowFrom(nlohmann::ordered_json::parse(jsonOf(made).dump()));
        EXPECT_EQ(jsonOf(back), jsonOf(made));
        EXPECT_EQ(back.settings, made.settings);
        EXPECT_EQ(back[Measure::flip], made[Measure::flip]);
        EXPECT_EQ(back.cameras[0].blocks[0].median, 1.0 / 3);
    }
}

TEST(TradeoffOutput, PlotsAndPageAreWellFormed) {
    const Tradeoff tradeoff = several();
    for (std::size_t metric = 0; metric < tradeoff::errorMetrics.size(); ++metric)
        for (const std::optional<Path> path : {std::optional<Path>(), std::optional(Path::deferred)}) {
            const std::string svg = tradeoffPlot(tradeoff, metric, path, PlotTarget::file);
            EXPECT_EQ(markupFault(svg), "");
            EXPECT_EQ(svg.find("nan"), std::string::npos);
            EXPECT_NE(svg.find("xmlns=\"http://www.w3.org/2000/svg\""), std::string::npos);
            EXPECT_EQ(countOf(svg, "data-row"), path ? 3u : 4u);
            EXPECT_NE(svg.find("\u221e"), std::string::npos) << "an infinite error has its lane";
            EXPECT_EQ(svg.find(">0</text>") != std::string::npos, !path) << "and an error of 0";
        }
    const std::string page = tradeoffHtml(tradeoff);
    EXPECT_EQ(markupFault(page, {"meta", "img"}), "");
    EXPECT_EQ(page.find("<scene>"), std::string::npos);
}

TEST(TradeoffOutput, ThePageAndTheTerminalSayWhatCameOfIt) {
    Tradeoff tradeoff = several();
    tradeoff.notes = {"a note"};
    EXPECT_EQ(tradeoffEnd(tradeoff),
              "  Pareto front of time and FLIP: rows 3, 2, 1\n"
              "  Pareto front of time and relative RMSE: rows 3, 2, 1\n"
              "  Pareto front of time and relative p99: rows 3, 2, 1\n"
              "Warnings\n  row 2: one, \"two\"\n"
              "Not drawn, and why\nhas no effect without --msaa 4: msaa-edges all\n"
              "How it was measured\n  It took 0.0 s, 0.0 s of which to draw and time the rows\n  a note\n");
    tradeoff.reference_image = "r.png";
    const std::string page = tradeoffHtml(tradeoff);
    for (const std::string& part :
         {std::string(
              "<h1>Time against error: <bdi>a &amp; b&#39;s &lt;scene&gt;.glb</bdi></h1><p class=\"soft\">"
              "4 rows at 640x360 on llvmpipe (Mesa), 5 timed frames each; <bdi>a, &quot;b&quot; &lt;c&gt;"
              "</bdi>; errors of lit against the reference</p>"),
          std::string(
              "<article class=\"row-card\" data-row=\"2\" hidden><h3>deferred</h3><p class=\"soft\">row 2</p>"
              "<div class=\"pictures\"><figure><img loading=\"lazy\" src=\"x.png\" "
              "alt=\"lit\"><figcaption>lit"
              "</figcaption></figure><figure><img loading=\"lazy\" src=\"r.png\" "
              "alt=\"reference\"><figcaption>"
              "reference</figcaption></figure><figure><img loading=\"lazy\" src=\"x.png\" "
              "alt=\"FLIP: black 0, pale 1\"><figcaption>FLIP: black 0, pale 1</figcaption></figure></div>"
              "<dl><dt>time, ms</dt><dd>4 (3.6 to 6)</dd><dt>FLIP</dt><dd>0.01</dd><dt>relative RMSE</dt>"
              "<dd>0.02</dd><dt>relative p99</dt><dd>0.04</dd><dt>memory</dt><dd>1.172 KiB</dd><dt>shade</dt>"
              "<dd>2 ms</dd></dl><p class=\"warn\">one, &quot;two&quot;</p>"),
          std::string("data-row=\"3\"><h3>"), std::string("<div data-figure=\"flip\"><"),
          std::string("<div data-figure=\"relative_rmse\" hidden><"),
          std::string("<div data-figure=\"relative_p99\" hidden><")})
        EXPECT_NE(page.find(part), page.npos) << part;
}

// Rows fit the terminal: numbers are dropped one by one, then Settings are truncated.
TEST(TradeoffOutput, RowsFitTheTerminal) {
    const Tradeoff tradeoff = several();
    std::vector<Settings> rows;
    for (const TradeoffRow& row : tradeoff.rows) rows.push_back(row.settings);
    std::size_t before = 1000;
    for (const std::size_t columns : {200u, 120u, 100u, 80u, 60u, 50u}) {
        const TradeoffTable table(tradeoff, rows, columns, false);
        std::string text = table.head();
        for (std::size_t i = 0; i < rows.size(); ++i) text += table.line(tradeoff, i);
        std::size_t longest = 0;
        for (std::size_t at = 0; at < text.size();) {
            const std::size_t end = text.find('\n', at);
            longest = std::max(longest, end - at);
            at = end + 1;
        }
        EXPECT_LE(longest, columns);
        EXPECT_LE(longest, before);
        before = longest;
        EXPECT_NE(text.find("FLIP"), std::string::npos);
        EXPECT_EQ(text.find("diptych tradeoff"), std::string::npos);
    }
    const TradeoffTable free(tradeoff, rows, 0, true);
    EXPECT_NE(free.head().find("memory"), std::string::npos);
    EXPECT_EQ(free.line(tradeoff, 0).find("..."), std::string::npos);
    EXPECT_NE(free.line(tradeoff, 0).find(measuringCommand(tradeoff, tradeoff.rows[0])), std::string::npos);
}

TEST(TradeoffOutput, FrontsAreOfWhatTheirPlotShows) {
    const Tradeoff tradeoff = several();
    EXPECT_EQ(frontOf(tradeoff, 0), (std::vector<std::size_t>{2, 1, 0}));
    EXPECT_EQ(frontOf(tradeoff, 0, Path::deferred), (std::vector<std::size_t>{2, 1}));
    EXPECT_EQ(frontOf(tradeoff, 0, Path::forward_plus), std::vector<std::size_t>{0});
}

TEST(TradeoffOutput, SeveralCamerasAreMeansAndSpreads) {
    TradeoffRow made = row("deferred", "", "", 2, {0.5, 0.5, 0.5});
    made.cameras.push_back(made.cameras[0]);
    made.cameras[1].blocks = {{4, 3, 10, 5}};
    made.cameras[1].measured.set(Measure::flip, Errors{0.25, 1, 0.5});
    made.cameras[1].measured.set(FrameBytes{5000, 0, 24});
    made.cameras[1].measured.set(Measure::shaded, SampleFractions{});
    joinBlocks(made.cameras[1]);
    joinCameras(made);
    EXPECT_DOUBLE_EQ(made[Measure::ms], 3);
    EXPECT_DOUBLE_EQ(made[Measure::ms_min], (1.8 + 3) / 2);
    EXPECT_DOUBLE_EQ(made[Measure::ms_max], (3.0 + 10) / 2);
    EXPECT_EQ(made[Measure::frames], 10);
    EXPECT_EQ(cameraRangeOf(made, Measure::flip).low, 0.25);
    EXPECT_EQ(cameraRangeOf(made, Measure::relative_rmse).high, 1);
    EXPECT_EQ(made[Measure::memory], 5000);
    EXPECT_FALSE(made.measured.has(Measure::shaded)) << "one camera has none";
    EXPECT_DOUBLE_EQ(made.passes[0].ms, 1);
}

TEST(TradeoffOutput, OfNoSceneIsAnEmptyList) {
    const std::filesystem::path written = folder() / "none";
    writeAllScenes(written, {{"schema", 1}}, {}, {"a.glb: is empty"}, false);
    EXPECT_EQ(nlohmann::json::parse(contentsOf(written / tradeoffsManifest))["scenes"],
              nlohmann::json::array());
    EXPECT_NE(contentsOf(written / "index.html").find("a.glb: is empty"), std::string::npos);
}

TEST(TradeoffOutput, TwoVisitsCountAlikeAndTellTheDrift) {
    Tradeoff tradeoff = several();
    EXPECT_FALSE(driftOf(tradeoff)) << "one visit";
    for (TradeoffRow& made : tradeoff.rows) made.cameras[0].blocks.push_back(made.cameras[0].blocks[0]);
    tradeoff.rows[0].cameras[0].blocks[1] = {16, 15, 17, 2};
    tradeoff.rows[2].cameras[0].blocks[1] = {0.5, 0.25, 0.5, 2};
    experiment::Row& twice = tradeoff.rows[0].cameras[0];
    joinBlocks(twice);
    EXPECT_DOUBLE_EQ(twice[Measure::ms], 12) << "8 of five frames and 16 of two";
    EXPECT_DOUBLE_EQ(twice[Measure::ms_min], 7.2);
    EXPECT_DOUBLE_EQ(twice[Measure::ms_max], 17);
    EXPECT_EQ(twice[Measure::frames], 7);
    const std::optional<CameraRange> drift = driftOf(tradeoff);
    ASSERT_TRUE(drift);
    EXPECT_DOUBLE_EQ(drift->value, 1);
    EXPECT_DOUBLE_EQ(drift->low, 0.5);
    EXPECT_DOUBLE_EQ(drift->high, 2);
}

}  // namespace
}  // namespace diptych
