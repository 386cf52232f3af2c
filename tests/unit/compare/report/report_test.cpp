// SPDX-License-Identifier: MIT
// A report's files, keys and escapes; files of others stay untouched.
#include "compare/report/report.h"
#include "compare/files/data_uri.h"
#include "compare/files/diptych_files.h"
#include "compare/files/frame_exr.h"
#include "compare/files/output.h"
#include "compare/report/json.h"
#include "compare/report/titles.h"
#include "shared/image/atomic_file.h"
#include "shared/image/exr.h"
#include "tests/support/files.h"
#include "tests/support/report_builder.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>

namespace diptych {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

Report passing() {
    return reportOf(bothFrames());
}
// A report of one channel, for tests of folders.
Report ofOneChannel() {
    return reportOf(withOnly({Channel::roughness, Channel::material_id}, bothFrames()));
}
Report failing() {
    std::vector<Frame> frames = bothFrames();
    frames[1].channels[Channel::roughness].at(1, 2) = 0.75f;
    frames[1].channels[Channel::albedo].at(1, 2, 0) = std::numeric_limits<float>::quiet_NaN();
    return reportOf(std::move(frames));
}
Json channelOf(const Json& report, const std::string& name) {
    for (const Json& channel : report["comparisons"][0]["channels"])
        if (channel["name"] == name) return channel;
    return {};
}

TEST(Report, LeavesWhatTheContractNames) {
    const fs::path out = folder() / "report";
    const std::string json = writeReport(passing(), out, {});
    for (const char* file : {"index.html", "report.json", "junit.xml", "deferred.exr", "forward_plus.exr",
                             "lit.png", "texcoords.forward_plus.png"})
        EXPECT_TRUE(fs::exists(out / file)) << file;
    EXPECT_EQ(contentsOf(out / "report.json"), json);
    EXPECT_EQ(namesIn(out.parent_path()), std::vector<std::string>{"report"}) << "nothing temporary stays";
    EXPECT_EQ(namesIn(out), Json::parse(json)["files"].get<std::vector<std::string>>());

    const std::vector<ImageLayer> layers = readExr(out / "forward_plus.exr").layers;
    std::set<std::string> channels;
    for (const ImageLayer& layer : layers) channels.insert(layer.channels.begin(), layer.channels.end());
    for (const DebugMode& mode : debugModes())
        for (const std::string& name : exrChannels(mode))
            EXPECT_EQ(channels.contains(name), mode.supported_by != SupportedBy::deferred_only) << name;
}

TEST(Report, JsonHasTheFixedKeys) {
    const Report report = passing();
    const ReportLayout layout = layoutOf(report, {});
    const Json json = Json::parse(reportJson(report, &layout));
    EXPECT_EQ(json["schema"], 1);
    EXPECT_EQ(json["verdict"], "pass");
    for (const char* key : {"name", "driver", "type"}) EXPECT_TRUE(json["device"].contains(key)) << key;
    ASSERT_EQ(json["frames"].size(), 2u);
    for (const Json& frame : json["frames"]) {
        for (const char* key :
             {"name", "path", "scene", "camera", "size", "settings", "ms", "passes", "bytes", "counters"})
            EXPECT_TRUE(frame.contains(key)) << key;
        EXPECT_EQ(frame["ms"], (Json{{"median", 2.0}, {"min", 1.0}, {"max", 3.0}, {"runs", 5}}));
        EXPECT_EQ(frame["size"], (Json{4, 3}));
        EXPECT_TRUE(frame["camera"]["far"].is_null()) << "JSON has no infinity";
        for (const char* key : {"images", "buffers", "gbuffer_per_pixel"})
            EXPECT_TRUE(frame["bytes"].contains(key)) << key;
        for (const char* key : {"nonfinite_pixels", "overflowed_lists", "lights"})
            EXPECT_TRUE(frame["counters"].contains(key)) << key;
        EXPECT_EQ(settingsFromJson(frame["settings"].dump()).size, (Size{4, 3}));
    }
    const Json& comparison = json["comparisons"][0];
    for (const char* key : {"scene", "camera", "baseline", "test", "verdict", "channels"})
        EXPECT_TRUE(comparison.contains(key)) << key;
    EXPECT_EQ(comparison["baseline"], "deferred");
    EXPECT_EQ(comparison["test"], "forward_plus");
    EXPECT_EQ(comparison["channels"].size(), channelsOfOneSample());
    for (const Json& channel : comparison["channels"])
        for (const char* key : {"number", "name", "metric", "max", "mean", "rmse", "p99", "p999", "flip",
                                "worst_pixel", "tolerance", "because", "verdict"})
            EXPECT_TRUE(channel.contains(key)) << channel["name"] << " " << key;
    EXPECT_TRUE(json["encode_ms"].is_number());
}

TEST(Report, StatisticsWithoutAFiniteValueAreNull) {
    const Json json = Json::parse(reportJson(failing(), nullptr));
    EXPECT_EQ(json["verdict"], "fail");
    const Json only = channelOf(json, "texcoords"), nan = channelOf(json, "albedo"),
               rough = channelOf(json, "roughness");
    EXPECT_EQ(only["verdict"], "forward-only");
    for (const char* key : {"max", "mean", "rmse", "p99", "p999", "flip", "worst_pixel", "tolerance"})
        EXPECT_TRUE(only[key].is_null()) << key;
    EXPECT_EQ(nan["verdict"], "fail");
    EXPECT_TRUE(nan["max"].is_null());
    EXPECT_EQ(nan["infinite_pixels"], 1);
    EXPECT_EQ(nan["nonfinite_pixels"], (Json{{"baseline", 0}, {"test", 1}}));
    EXPECT_EQ(rough["max"], 0.25);
    EXPECT_EQ(rough["mean"], 0.25) << "the one covered pixel";
    EXPECT_EQ(rough["worst_pixel"], (Json{1, 2}));
    EXPECT_EQ(rough["worst_values"]["test"], Json::array({0.75}));
}

TEST(Report, JunitHasOneCasePerChannelAndIsWellFormed) {
    const std::string junit = junitOf(failing());
    EXPECT_EQ(markupFault(junit), "");
    EXPECT_EQ(countOf(junit, "<testcase "), channelsOfOneSample());
    EXPECT_EQ(countOf(junit, "<failure "), 2u);
    EXPECT_EQ(countOf(junit, "<skipped "),
              static_cast<std::size_t>(
                  std::ranges::count(debugModes(), SupportedBy::forward_only, &DebugMode::supported_by)));
    EXPECT_NE(junit.find("failures=\"2\""), std::string::npos);
}

TEST(Report, TheMarkupCheckFindsFaults) {
    EXPECT_NE(markupFault("<a><b></a></b>"), "");
    EXPECT_NE(markupFault("<a>"), "");
    EXPECT_NE(markupFault("<a>x & y and more</a>"), "");
    EXPECT_EQ(markupFault("<a b=\"c\">x &amp; y<br></a>", {"br"}), "");
}

TEST(Report, ThePageStandsAloneWithFailuresFirst) {
    const fs::path out = folder() / "report";
    writeReport(failing(), out, {});
    const std::string page = contentsOf(out / "index.html");
    EXPECT_EQ(markupFault(page, htmlVoids), "");
    for (const char* external : {"http:", "https:", "src=\"/", "url(", "@import"})
        EXPECT_EQ(page.find(external), std::string::npos) << external;
    const auto card = [&](const std::string& name) { return page.find("id=\"c0-" + name + "\""); };
    const std::size_t table = page.find("class=\"overview\"");
    EXPECT_LT(card("albedo"), card("lit")) << "a failing card before a passing one";
    EXPECT_LT(card("lit"), card("roughness")) << "lit is the second at the latest";
    EXPECT_LT(card("roughness"), table) << "pictures before the table";
    EXPECT_LT(table, card("metallic"));
    for (std::size_t at = page.find("src=\""); at != std::string::npos; at = page.find("src=\"", at + 1)) {
        const std::string source = page.substr(at + 5, page.find('"', at + 5) - at - 5);
        EXPECT_TRUE(fs::exists(out / source)) << source;
    }
}

TEST(Report, ThePageCountsThePixelsThatASecondRunChanged) {
    std::vector<Frame> frames = bothFrames();
    frames[0].noise = {{Channel::lit, {0, 0}}, {Channel::albedo, {0, 0}}};
    frames[1].noise = {{Channel::lit, {2, 0.1}}, {Channel::albedo, {1, 0.1}}};
    const std::string page = pageOf(reportOf(std::move(frames)));
    EXPECT_NE(page.find("a second run changed</td><td class=\"n\">0</td><td class=\"n\">2</td>"), page.npos);
}

TEST(Report, ASinglePageHoldsItsImages) {
    const fs::path out = folder() / "report";
    ReportOptions options;
    options.single_file = true;
    writeReport(failing(), out, options);
    const std::string page = contentsOf(out / "index.html");
    EXPECT_EQ(markupFault(page, htmlVoids), "");
    EXPECT_EQ(page.find(".png\""), std::string::npos);
    EXPECT_NE(page.find("src=\"data:image/png;base64,iVBORw0KGgo"), std::string::npos)
        << "a PNG's first bytes";
    EXPECT_EQ(namesIn(out), (std::vector<std::string>{"index.html", "junit.xml", "report.json"}));
    EXPECT_EQ(Json::parse(contentsOf(out / "report.json"))["files"], Json(namesIn(out)));
    EXPECT_EQ(contentsOf(out / "junit.xml").find("ATTACHMENT"), std::string::npos) << "there are no files";
}

// If both sides show a channel alike, the page has its image once, otherwise twice.
TEST(Report, ASinglePageHoldsASharedImageOnce) {
    const fs::path out = folder() / "report";
    ReportOptions options;
    options.single_file = true;
    std::vector<Frame> frames = bothFrames();
    for (Frame& frame : frames) std::ranges::fill(frame.channels.at(Channel::material_id).data, 3.0f);
    std::ranges::fill(frames[1].channels.at(Channel::roughness).data, 1.0f);
    writeReport(reportOf(std::move(frames)), out, options);
    const std::string page = contentsOf(out / "index.html");
    const std::regex uri("src=\"(data:[^\"]*)\"");
    int shared = 0, apart = 0;
    for (std::size_t at = page.find("<div class=\"pair "); at != page.npos;
         at = page.find("<div class=\"pair ", at + 1)) {
        const std::string pair = page.substr(at, page.find("<i class=\"divider\">", at) - at);
        std::vector<std::string> uris;
        for (std::sregex_iterator i(pair.begin(), pair.end(), uri), none; i != none; ++i)
            uris.push_back((*i)[1]);
        const bool copies =
            pair.find("<img loading=\"lazy\" width") != pair.npos && pair.find("data-same") != pair.npos;
        ASSERT_EQ(uris.size(), copies ? 1u : 2u) << pair.substr(0, 200);
        EXPECT_TRUE(copies || uris[0] != uris[1]);
        ++(copies ? shared : apart);
    }
    EXPECT_GT(shared, 3);
    EXPECT_GT(apart, 0);
}

TEST(Report, NamesOfOthersAreEscaped) {
    Report report = reportOf(bothFrames("a<b>&\"'\x01\xff.gltf"));
    report.frames[0].notes = {"<script>alert(1)</script>"};
    const std::string page = pageOf(report), junit = junitOf(report);
    EXPECT_EQ(markupFault(page, htmlVoids), "");
    EXPECT_EQ(markupFault(junit), "");
    EXPECT_EQ(page.find("<script>alert"), std::string::npos);
    EXPECT_NE(junit.find("a&lt;b&gt;&amp;&quot;&#39;\xef\xbf\xbd\xef\xbf\xbd.gltf"), std::string::npos);
    EXPECT_TRUE(Json::accept(reportJson(report, nullptr)));
}

TEST(Report, OursIsReplacedAndOthersStay) {
    const fs::path out = folder() / "report";
    writeReport(failing(), out, {});
    EXPECT_TRUE(fs::exists(out / "roughness.difference.png"));
    writeFile(out / "mine.txt", "keep");
    writeReport(passing(), out, {});
    EXPECT_FALSE(fs::exists(out / "roughness.difference.png")) << "the earlier report's own file";
    EXPECT_EQ(contentsOf(out / "mine.txt"), "keep");
    EXPECT_EQ(Json::parse(contentsOf(out / "report.json"))["verdict"], "pass");
}

TEST(Report, AFailureLeavesTheEarlierReportWhole) {
    const fs::path out = folder() / "report";
    const std::string json = writeReport(passing(), out, {});
    const std::vector<std::string> names = namesIn(out);
    Report broken = failing();
    broken.frames[1].channels[Channel::texcoords] = Image(9, 9, 2);  // an EXR has one size
    EXPECT_THROW(writeReport(broken, out, {}), std::runtime_error);
    EXPECT_EQ(contentsOf(out / "report.json"), json);
    EXPECT_EQ(namesIn(out), names);
    EXPECT_THROW(writeReport(broken, out.parent_path() / "new", {}), std::runtime_error);
    EXPECT_EQ(namesIn(out.parent_path()), std::vector<std::string>{"report"});
}

TEST(Report, AnothersFolderNeedsForce) {
    const fs::path out = folder() / "theirs";
    fs::create_directories(out);
    writeFile(out / "mine.txt", "keep");
    EXPECT_THROW(writeReport(ofOneChannel(), out, {}), std::runtime_error);
    EXPECT_EQ(namesIn(out), std::vector<std::string>{"mine.txt"});
    ReportOptions options;
    options.force = true;
    writeReport(ofOneChannel(), out, options);
    EXPECT_TRUE(fs::exists(out / "report.json"));
    EXPECT_EQ(contentsOf(out / "mine.txt"), "keep");
}

TEST(Report, AnEditedListRemovesNothingOutside) {
    const fs::path here = folder(), out = here / "report";
    writeReport(ofOneChannel(), out, {});
    writeFile(here / "outside.txt", "keep");
    Json json = Json::parse(contentsOf(out / "report.json"));
    json["files"].push_back("../outside.txt");
    json["files"].push_back("..");
    writeFile(out / "report.json", json.dump());
    writeReport(ofOneChannel(), out, {});
    EXPECT_EQ(contentsOf(here / "outside.txt"), "keep");
}

// Another tool's report.json may have a schema and a list of files, too.
TEST(Report, AStrangersListRemovesNothing) {
    const fs::path out = folder() / "theirs";
    fs::create_directories(out);
    writeFile(out / "mine.txt", "keep");
    writeFile(out / "mine.png", "keep");
    const std::string files = R"("files": ["mine.txt", "mine.png"]})";
    for (const std::string start : {R"({"schema": 1, )", R"({"schema": 1, "software": "other", )",
                                    R"({"schema": 3, "software": "diptych", )", R"([1, {"schema": 1, )"}) {
        writeFile(out / "report.json", start + files);
        EXPECT_THROW(writeReport(ofOneChannel(), out, {}), std::runtime_error) << start;
        EXPECT_EQ(namesIn(out), (std::vector<std::string>{"mine.png", "mine.txt", "report.json"}));
    }
    ReportOptions force;
    force.force = true;
    writeReport(ofOneChannel(), out, force);
    EXPECT_TRUE(fs::exists(out / "mine.png")) << "--force replaces files, it does not clear folders";

    Json json = Json::parse(contentsOf(out / "report.json"));
    EXPECT_EQ(json["software"], "diptych");
    json["files"] = {"mine.txt"};
    writeFile(out / "report.json", json.dump());
    writeReport(ofOneChannel(), out, {});
    EXPECT_EQ(contentsOf(out / "mine.txt"), "keep") << "diptych never writes .txt";
}

// The word "diptych" in an image's comment or a scene's path does not make a file ours.
TEST(Report, AFileThatOnlyMentionsDiptychIsNotOurs) {
    const fs::path here = folder();
    for (const std::string& text : {std::string("diptych"), std::string("\x76\x2f\x31\x01 diptych"),
                                    std::string("\x89PNG\r\n\x1a\n diptych")}) {
        writeFile(here / "a.exr", text);
        EXPECT_THROW(checkReplaceable({OutputKind::exr, here / "a.exr"}, "", false), std::runtime_error);
    }
}

TEST(Report, SeveralComparisonsShareAFolder) {
    const fs::path out = folder() / "report";
    const std::set<Channel> channels{Channel::roughness, Channel::material_id};
    std::vector<Frame> frames = withOnly(channels, bothFrames("scenes/One.glb")),
                       more = withOnly(channels, bothFrames("builtin:one"));
    for (Frame& frame : more) {
        frame.settings.camera = "eye=1,2,3";
        frames.push_back(frame);
    }
    const Json json = Json::parse(writeReport(reportOf(std::move(frames)), out, {}));
    EXPECT_EQ(json["comparisons"].size(), 2u);
    for (const char* file : {"One-7dc25e/deferred.exr", "one/eye-1-2-3-a1c8f7/forward_plus.exr",
                             "one/eye-1-2-3-a1c8f7/roughness.png"})
        EXPECT_TRUE(fs::exists(out / file)) << file;
    EXPECT_EQ(markupFault(contentsOf(out / "index.html"), htmlVoids), "");
}

TEST(Report, TheTableSaysFailuresFirstAndTheVerdictLast) {
    const std::string table = reportTable(failing());
    EXPECT_LT(table.find("roughness"), table.find("lit "));
    EXPECT_TRUE(table.ends_with("FAIL: albedo, roughness beyond tolerance\n")) << table;
    const auto both = std::ranges::count_if(debugModes(), [](const DebugMode& mode) {
        return mode.supported_by == SupportedBy::both || mode.supported_by == SupportedBy::paths_only;
    });
    EXPECT_TRUE(reportTable(passing()).ends_with(fmt::format(
        "pass: all {} compared channels are within tolerance ({} more exist on one "
        "side only)\n",
        both, std::ranges::count(debugModes(), SupportedBy::forward_only, &DebugMode::supported_by))));
}

TEST(Report, NotesOfTheSceneAreSaidOnce) {
    std::vector<Frame> frames = bothFrames();
    for (Frame& frame : frames) frame.notes = {"1 material <Lens> drawn opaque"};
    const Report report = reportOf(std::move(frames));
    EXPECT_EQ(countOf(reportTable(report), "note: 1 material <Lens> drawn opaque\n"), 1u);
    const std::string junit = junitOf(report);
    EXPECT_EQ(markupFault(junit), "");
    EXPECT_EQ(countOf(junit, "note: 1 material &lt;Lens&gt; drawn opaque\n"), 1u);
    EXPECT_EQ(junitOf(passing()).find("note: "), std::string::npos);
}

// The tolerance of lit is per pixel; only pixels that remain unexplained count.
TEST(Report, ExplainedChannelsCountWhatIsLeftOver) {
    std::vector<Frame> frames = bothFrames();
    frames[1].channels[Channel::lit].at(1, 2) = 0.75f;
    const Report report = reportOf(frames);
    const auto rowEnds = [](const Report& of, const std::string& end) {
        const std::string table = reportTable(of);
        const std::size_t row = table.find("  lit  ");
        return table.substr(row, table.find('\n', row) - row).ends_with(end);
    };
    EXPECT_TRUE(rowEnds(report, "pixels unexplained         0         0  pass")) << reportTable(report);
    frames[1].through_gbuffer[Channel::lit].at(1, 2) = 0.25f;
    EXPECT_TRUE(rowEnds(reportOf(frames), "pixels unexplained         1         0  FAIL"));
}

TEST(Report, HelpersAreNeitherComparedNorWritten) {
    std::vector<Frame> frames = bothFrames();
    for (Frame& frame : frames) frame.requested = {Channel::normals};
    const fs::path out = folder() / "report";
    const Report report = reportOf(std::move(frames));
    writeReport(report, out, {});
    ASSERT_EQ(report.comparisons[0].channels.size(), 1u);
    EXPECT_EQ(report.comparisons[0].channels[0].mode->name, "normals");
    EXPECT_EQ(report.comparisons[0].coverage.count, 1u)
        << "the helper material_id still tells the background";
    const std::vector<ImageLayer> layers = readExr(out / "deferred.exr").layers;
    ASSERT_EQ(layers.size(), 1u);
    EXPECT_EQ(layers[0].name, "normals");
}

// RFC 4648's examples.
TEST(Report, Base64) {
    for (const auto& [text, code] :
         {std::pair{"f", "Zg=="}, {"fo", "Zm8="}, {"foo", "Zm9v"}, {"foobar", "Zm9vYmFy"}})
        EXPECT_EQ(dataUri(text), std::string("data:image/png;base64,") + code);
}

}  // namespace
}  // namespace diptych
