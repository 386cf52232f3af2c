// SPDX-License-Identifier: MIT
// All that a benchmark says of made-up times: terminal, page, JSON and files, word for word.
#include "compare/bench/findings.h"
#include "compare/experiment/row.h"
#include "compare/output/writers.h"
#include "compare/page/text.h"
#include "tests/support/errors.h"
#include "tests/support/files.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace diptych {
namespace {

using namespace bench;
using OrderedJson = nlohmann::ordered_json;

BenchRow shortRow(const std::string& words, std::uint32_t lights, std::vector<double> ms,
                  std::vector<PassTime> passes) {
    BenchRow made;
    made.scene = "a&b.glb";
    made.settings.set("path", words.substr(0, words.find(' ')));
    made.settings.set("assign", words.substr(words.find(' ') + 1));
    made.settings.size = {640, 360};
    made.requested_lights = lights;
    made.measured[Measure::lights] = lights + 1;
    made.measured.set(FrameTime{ms[0], ms[1], ms[2], static_cast<int>(ms.size())});
    made.measured.set(FrameBytes{2 << 20, 1 << 20});
    made.ms = std::move(ms);
    made.passes = std::move(passes);
    made.warnings = {"of <all>"};
    return made;
}

// Two modes that are compared, and one that draws another image.
Bench shortBench() {
    Bench bench;
    bench.scene = "a&b.glb";
    bench.device = {"a GPU", "driver 2", "discrete"};
    bench.runs = 6;
    bench.options.max_ms = 1500;
    bench.rows = {shortRow("deferred tiled", 1024, {10, 8, 12.25, 10, 10, 10},
                           {{"G-buffer", 4}, {"assign lights", 1.2346}, {"shade", 5}}),
                  shortRow("forward_plus clustered", 1024, {21, 20, 26, 22, 20, 21}, {{"shade", 13.5}}),
                  shortRow("forward_plus per_object", 0, {1500.4, 999.96, 2000, 1500, 1500, 1500}, {})};
    bench.rows[1].warnings = {"its own", "of <all>", "and another"};
    bench.rows[1].measured[Measure::nonfinite_pixels] = 1;
    bench.skips = {shortRow("deferred every", 4096, {0, 0, 0}, {}),
                   shortRow("deferred every", 1, {0, 0, 0}, {})};
    bench.skips[0].failed = "too <slow>";
    bench.skips[1].failed = "not supported";
    bench.skips[1].settings.size = {0, 0};
    bench.skips[1].requested_lights.reset();
    return bench;
}

const std::string conclusion =
    "640x360, 1025 lights: deferred (tiled) takes 10 ms, forward_plus (clustered) takes 2.11 times as long "
    "(median ratio of 6 interleaved frame pairs; 2.00 to 2.50 at 96.9 % confidence); the pass that differs "
    "most is shade: 5 ms against 13.5 ms";

TEST(BenchDocument, ATerminalShowsEveryWord) {
    EXPECT_EQ(benchTable(shortBench(), 0),
              "  lights       size  path          assign              ms       min       max     memory  "
              "passes, ms\n"
              "    1025    640x360  deferred      tiled               10         8     12.25      3 MiB  "
              "G-buffer 4, assign lights 1.23, shade 5\n"
              "    1025    640x360  forward_plus  clustered           21        20        26      3 MiB  "
              "shade 13.5\n"
              "       1    640x360  forward_plus  per_object *      1500      1000      2000      3 MiB\n");
    EXPECT_EQ(benchTable(shortBench(), 2),
              "       1    640x360  forward_plus  per_object *      1500      1000      2000      3 MiB\n");
    EXPECT_EQ(benchEnd(shortBench()),
              "Not timed, and why\n"
              "deferred, every, 640x360, 4096 lights: too <slow>\n"
              "deferred, every: not supported\n"
              "Notes\n"
              "  forward_plus, clustered, 1025 lights: 1 pixel not finite\n"
              "  of <all>\n"
              "  * draws a different picture: only some lights are shaded per pixel, the others per object\n"
              "  " +
                  conclusion + "\n");
    Bench nothing;
    EXPECT_EQ(benchEnd(nothing), "");
    EXPECT_EQ(benchTable(nothing, 0),
              "  lights       size  path          assign              ms       min       max     memory  "
              "passes, ms\n");
}

// The page's part between its title and its links.
std::string bodyOf(const std::string& page) {
    const std::size_t from = page.find("<header>");
    return page.substr(from, page.find("<script>") - from);
}

const std::string howMeasured =
    "<h2>How it was measured</h2>\n<div class=\"box how\"><ul>"
    "<li>Time is the median over whole frames, not split into passes, from culling to linear lit. It "
    "includes "
    "making the light lists; the scene is already uploaded. Min and max are of single frames, and so are the "
    "ends of bars.</li>"
    "<li>All modes and sizes of one light count are interleaved, one frame of each per round, so a device "
    "that slows down affects all alike.</li>"
    "<li>Pass times are medians over as many other frames, with each pass timed by itself.</li>"
    "<li>The ratio of two modes is the median over frames of the same round. Its interval comes from a sign "
    "test, which holds for any distribution of times.</li></ul></div>\n";

TEST(BenchDocument, APageHasEveryWordInOrder) {
    const auto rowText = [](const char* lights, const char* path, const char* assign, const char* min,
                            const std::string& rest) {
        return "<tr><td class=\"n\">" + std::string(lights) + "</td><td class=\"n\">640x360</td><td>" + path +
               "</td><td>" + assign + "</td>" + min + "<td class=\"n\">3 MiB</td>" + rest + "</tr>\n";
    };
    const auto msCells = [](const char* ms, const char* min, const char* max) {
        std::string cells;
        for (const char* text : {ms, min, max}) cells += "<td class=\"n\">" + std::string(text) + "</td>";
        return cells;
    };
    const Bench bench = shortBench();
    const std::string skips =
        "<h2>Not timed, and why</h2>\n<div class=\"box skips\"><dl>"
        "<dt>deferred, every, 640x360, 4096 lights</dt><dd>too &lt;slow&gt;</dd>"
        "<dt>deferred, every</dt><dd>not supported</dd></dl></div>\n";
    EXPECT_EQ(
        bodyOf(benchHtml(bench)),
        "<header><p class=\"brand\">Diptych</p><h1>Times side by side: <bdi>a&amp;b.glb</bdi></h1>"
        "<p class=\"soft\">3 rows of 6 frames each on a GPU (driver 2)</p></header>\n"
        "<div class=\"box says\"><ul><li>" +
            conclusion +
            "</li></ul></div>\n"
            "<div class=\"box drawn\">" +
            benchPlot(bench, PlotTarget::page) +
            "</div>\n"
            "<div id=\"rows\"><h2>Every mode</h2>\n"
            "<div class=\"box scroll rows\"><table class=\"stack\"><thead><tr><th class=\"n\">lights</th>"
            "<th class=\"n\">size</th><th>path</th><th>assign</th><th class=\"n\">ms</th><th "
            "class=\"n\">min</th>"
            "<th class=\"n\">max</th><th class=\"n\">memory</th><th class=\"whole\">passes, ms</th>"
            "<th class=\"whole\">notes</th></tr></thead>\n<tbody>" +
            rowText(
                "1025", "deferred", "tiled", msCells("10", "8", "12.25").c_str(),
                "<td class=\"whole\">G-buffer 4, assign lights 1.23, shade 5</td><td class=\"whole\"></td>") +
            rowText("1025", "forward_plus", "clustered", msCells("21", "20", "26").c_str(),
                    "<td class=\"whole\">shade 13.5</td><td class=\"whole\">its own; and another</td>") +
            rowText("1", "forward_plus", "per_object *", msCells("1500", "1000", "2000").c_str(),
                    "<td class=\"whole\"></td><td class=\"whole\"></td>") +
            "</tbody></table></div>\n</div>\n" + skips +
            "<h2>Notes</h2>\n<div class=\"box says\"><ul>"
            "<li>forward_plus, clustered, 1025 lights: 1 pixel not finite</li><li>of &lt;all&gt;</li><li>" +
            starMeans + "</li></ul></div>\n" + howMeasured +
            "<footer><p><a href=\"bench.json\">bench.json</a> <a href=\"rows.csv\">rows.csv</a> "
            "<a href=\"bench.svg\">bench.svg</a> </p></footer>");
    EXPECT_NE(benchHtml(bench).find("<title>Diptych: times, a&amp;b.glb</title>"), std::string::npos);
    EXPECT_NE(benchHtml(bench).find("href=\"#rows\""), std::string::npos) << "skips to the table";
    Bench skipped = shortBench();
    skipped.rows.clear();
    skipped.runs = 1;
    EXPECT_EQ(bodyOf(benchHtml(skipped)),
              "<header><p class=\"brand\">Diptych</p><h1>Times side by side: <bdi>a&amp;b.glb</bdi></h1>"
              "<p class=\"soft\">0 rows of 1 frame each on a GPU (driver 2)</p></header>\n"
              "<div id=\"rows\"></div>\n" +
                  skips + howMeasured +
                  "<footer><p><a href=\"bench.json\">bench.json</a> <a href=\"rows.csv\">rows.csv</a> "
                  "</p></footer>");
}

TEST(BenchDocument, JsonHasEveryKey) {
    const Bench bench = shortBench();
    OrderedJson json = benchJson(bench);
    // Those of every experiment's rows, and a benchmark's own.
    ASSERT_EQ(json["rows"].size(), 3u);
    const char* const own[] = {
        R"({"name":"deferred, tiled","assign":"tiled","transparency":"sorted","lighting":"fragment",)"
        R"("same_picture":true,"size":[640,360],"light_count":1024,"assign_ms":1.2346,)"
        R"("assign_share":0.12063001973697066})",
        R"({"name":"forward_plus, clustered","assign":"clustered","transparency":"sorted",)"
        R"("lighting":"fragment","same_picture":true,"size":[640,360],"light_count":1024,"assign_ms":0.0,)"
        R"("assign_share":0.0})",
        R"({"name":"forward_plus, per_object","assign":"per_object","transparency":"sorted",)"
        R"("lighting":"fragment","same_picture":false,"size":[640,360],"light_count":0,"assign_ms":0.0,)"
        R"("assign_share":0.0})"};
    for (std::size_t i = 0; i < 3; ++i) {
        OrderedJson row = json["rows"][i];
        const OrderedJson shared = experiment::jsonOf(bench.rows[i]);
        for (const auto& [key, value] : shared.items()) {
            EXPECT_EQ(row[key], value) << key;
            row.erase(key);
        }
        EXPECT_EQ(row.dump(), own[i]);
    }
    EXPECT_DOUBLE_EQ(assignFraction(bench.rows[0]), 1.2346 / 10.2346);
    json.erase("rows");
    const experiment::TimeRatio ratio = conclusionsOf(bench)[0].ratio;
    EXPECT_NEAR(ratio.confidence, 1 - 2.0 / 64, 1e-12) << "all six on one side, by chance";
    const OrderedJson expected{
        {"schema", 2},
        {"software", "diptych"},
        {"device", {{"name", "a GPU"}, {"driver", "driver 2"}, {"type", "discrete"}}},
        {"scene", "a&b.glb"},
        {"runs", 6},
        {"max_ms", 1500.0},
        {"conclusions",
         {{{"size", {640, 360}},
           {"lights", 1025},
           {"faster", "deferred, tiled"},
           {"slower", "forward_plus, clustered"},
           {"ratio", ratio.ratio},
           {"interval", {2.0, 2.5}},
           {"confidence", ratio.confidence},
           {"pairs", 6},
           {"sure", true},
           {"pass", "shade"},
           {"pass_ms", {5.0, 13.5}},
           {"in_words", conclusion}}}},
        {"msaa_tables", OrderedJson::array()},
        {"growth", {{"lines", OrderedJson::array()}, {"words", OrderedJson::array()}}},
        {"layers", {{"compiler", ""}, {"rows", OrderedJson::array()}, {"words", OrderedJson::array()}}},
        {"skipped",
         {{{"path", "deferred"},
           {"assign", "every"},
           {"size", {640, 360}},
           {"light_count", 4096},
           {"reason", "too <slow>"}},
          {{"path", "deferred"},
           {"assign", "every"},
           {"size", nullptr},
           {"light_count", nullptr},
           {"reason", "not supported"}}}}};
    EXPECT_EQ(json.dump(1), expected.dump(1));
}

TEST(BenchDocument, AFolderHasThePageTheRowsAndThePlot) {
    const std::filesystem::path path = folder() / "out";
    const Bench bench = shortBench();
    const std::string json = writeBench(bench, path, false);
    EXPECT_EQ(filesIn(path), (std::vector<std::string>{"bench.json", "bench.svg", "index.html", "rows.csv"}));
    EXPECT_EQ(contentsOf(path / "bench.json"), json);
    EXPECT_EQ(contentsOf(path / "index.html"), benchHtml(bench));
    EXPECT_EQ(contentsOf(path / "bench.svg"), benchPlot(bench, PlotTarget::file));
    std::vector<const experiment::Row*> rows = experiment::pointersTo(bench.rows);
    for (const BenchRow& skip : bench.skips) rows.push_back(&skip);
    EXPECT_EQ(contentsOf(path / "rows.csv"), inCsv(experiment::rowsTable(rows))) << "skips are last";
    OrderedJson manifest = OrderedJson::parse(json);
    EXPECT_EQ(manifest["files"], (OrderedJson{"bench.json", "bench.svg", "index.html", "rows.csv"}));
    manifest.erase("files");
    EXPECT_EQ(manifest, benchJson(bench));
    // Without a row there is no plot. A folder with something else stays unless it is forced.
    Bench nothing = bench;
    nothing.rows.clear();
    writeBench(nothing, path, false);
    EXPECT_EQ(filesIn(path), (std::vector<std::string>{"bench.json", "index.html", "rows.csv"}));
    std::filesystem::remove(path / "bench.json");
    EXPECT_NE(faultOf([&] { writeBench(nothing, path, false); }), "");
    EXPECT_EQ(faultOf([&] { writeBench(nothing, path, true); }), "");
}

}  // namespace
}  // namespace diptych
