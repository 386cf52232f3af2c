// SPDX-License-Identifier: MIT
// What is said of relations that hold, are broken and do not apply: whole texts, JSON, pages and pictures.
#include "compare/audit/report.h"
#include "compare/image/channel_image.h"
#include "compare/output/writers.h"
#include "shared/contract/debug_mode.h"
#include "shared/frame/debug_modes.h"
#include "shared/image/png.h"
#include "tests/support/files.h"
#include "tests/support/page_texts.h"
#include "tests/support/report_builder.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <limits>
#include <string>
#include <vector>

namespace diptych::audit {

namespace {

Relation relationNamed(std::string_view name, Equality equality) {
    return {.name = name, .changes = "all is pushed", .equality = equality, .because = "pushing is exact"};
}
const Relation pushed = relationNamed("pushed", Equality::rounding),
               still = relationNamed("still", Equality::bits),
               unread = relationNamed("unread", Equality::sums),
               absent = relationNamed("absent", Equality::bits);

Frame twoPixels(float light) {
    Frame frame;
    frame.settings.size = {2, 1};
    frame.channels[Channel::lit] = Image(2, 1, 3, light);
    frame.channels[Channel::lit].data = {light, 0, 0, 0, light, light / 2};
    frame.channels[Channel::material_id] = Image(2, 1, 1, 0.0f);
    return frame;
}

SeriesResult seriesOf(Path path, std::vector<ChannelResult> channels, std::vector<Change> changes = {}) {
    SeriesResult of;
    of.series = {path, std::move(changes)};
    of.comparison.channels = std::move(channels);
    of.comparison.covered = 100;
    of.comparison.max_excluded = of.comparison.max_filtered = 8;
    of.tolerance.equality = Equality::rounding;
    of.tolerance.relative = 1e-6;
    of.tolerance.step = 0x1p-7;
    return of;
}

// Forward+ breaks the first relation by light and depth, deferred does not read its input with a full
// G-buffer, and both hold the second.
RelationAudit someRelations() {
    const ChannelResult small{
        .mode = Channel::lit, .error = 1e-7, .allowed = 2e-7, .used = 0.5, .x = 4, .y = 5};
    RelationAudit audit;
    audit.scene = "builtin:pushed";
    audit.camera = "front";
    audit.settings.size = {2, 1};
    audit.device = {"A GPU", "driver 1.2", "discrete"};
    SeriesResult holds = seriesOf(Path::deferred, {small});
    holds.comparison.excluded = 3;
    holds.comparison.filtered = 1;
    SeriesResult breaks = seriesOf(
        Path::forward_plus,
        {{.mode = Channel::lit, .error = 3e-4, .allowed = 1e-4, .used = 3, .x = 1, .y = 2, .beyond = 2},
         {.mode = Channel::depth, .error = 0.5, .allowed = 0.125, .used = 4, .x = 6, .y = 7, .beyond = 1},
         {.mode = Channel::normals, .error = 1, .allowed = 2, .used = 0.5, .x = 0, .y = 0}},
        {{"gbuffer", "full"}, {"ibl", "sampled"}});
    breaks.original = twoPixels(0.5f);
    breaks.changed = twoPixels(1);
    breaks.comparison.used_by_pixel = Image(2, 1, 1);
    breaks.comparison.used_by_pixel.data = {3, 0.25f};
    SeriesResult lacks = seriesOf(Path::deferred, {}, {{"gbuffer", "full"}});
    lacks.lacks = "deferred does not read the changed input";
    SeriesResult reference = seriesOf(Path::reference, {}, {{"reference-mode", "scene"}});
    SeriesResult exact = seriesOf(Path::deferred, {small}), worse = seriesOf(Path::forward_plus, {small});
    worse.comparison.channels[0].used = 0.75;
    worse.comparison.channels[0].error = 12;
    worse.comparison.channels[0].allowed = 16;
    for (SeriesResult* of : {&exact, &worse}) of->tolerance.equality = Equality::bits;
    SeriesResult dear = reference;
    dear.comparison.channels = {small};
    dear.comparison.channels[0].used = 5;
    SeriesResult gone = seriesOf(Path::deferred, {}), too = seriesOf(Path::forward_plus, {});
    gone.lacks = too.lacks = "it does not read the changed input";
    audit.relations = {{&still, "", {exact, worse, dear}},
                       {&absent, "the scene has one light", {}},
                       {&unread, "", {gone, too}},
                       {&pushed, "", {holds, breaks, lacks, reference}}};
    return audit;
}

}  // namespace

TEST(RelationDocument, ATerminalSaysWhatIsBrokenInDetail) {
    const RelationAudit audit = someRelations();
    const auto textOf = [&](std::size_t i) {
        return output::inText(blocksOf(audit.relations[i], audit.device));
    };
    EXPECT_EQ(textOf(0), "still               holds: forward_plus: lit 12 ULP, allowed 16, at 4,5\n");
    EXPECT_EQ(textOf(1), "absent              does not apply: the scene has one light\n");
    EXPECT_EQ(textOf(2), "unread              does not apply: neither path reads the changed input\n");
    EXPECT_EQ(
        textOf(3),
        "pushed              broken: holds in double precision: a bug of the driver or of Diptych, on A GPU "
        "with driver 1.2\n"
        "all is pushed; pushing is exact\n"
        "  deferred: holds: lit 1e-07, allowed 2e-07, at 4,5; another surface at 3 pixels (at most 8); a "
        "texture filtered differently at 1 pixel (at most 8)\n"
        "  forward_plus, gbuffer full, ibl sampled: broken: depth 0.5, allowed 0.125, at 6,7; tolerance: "
        "1e-06 of the value plus 0.0078 of its change to the next pixel\n"
        "  forward_plus, gbuffer full, ibl sampled, lit: 2 pixels out of tolerance, the worst at 1,2: "
        "0.0003, allowed 0.0001\n"
        "  forward_plus, gbuffer full, ibl sampled, depth: 1 pixel out of tolerance, the worst at 6,7: 0.5, "
        "allowed 0.125\n"
        "  reference, double precision: holds: equal\n");
    EXPECT_EQ(output::inText(closingOf(audit)), "FAIL: 1 of 4 relations hold, 1 broken, 2 not applicable\n");
    RelationAudit sound = audit;
    sound.relations.pop_back();
    EXPECT_EQ(output::inText(closingOf(sound)), "pass: 1 of 3 relations hold, 0 broken, 2 not applicable\n");
    // A renderer that refuses the case breaks the relation too; the reference tells whose fault it is.
    RelationResult refused = audit.relations[0];
    refused.series[1].comparison.failed = "no memory";
    const auto refusedOn = [&](const ReportDevice& device) {
        return output::inText(blocksOf(refused, device));
    };
    const std::string details =
        "all is pushed; pushing is exact\n"
        "  deferred: holds: lit 1e-07 ULP, allowed 2e-07, at 4,5\n"
        "  forward_plus: broken: not drawn: no memory; tolerance: bit for bit\n";
    const std::string reference = "  reference, double precision: holds: lit 1e-07, allowed 2e-07, at 4,5\n";
    EXPECT_EQ(
        refusedOn({"llvmpipe", "Mesa", "cpu"}),
        "still               broken: holds in double precision, and llvmpipe is a CPU: most likely a bug of "
        "Diptych\n" +
            details + reference);
    refused.series[2].comparison.excluded = 9;  // of at most 8
    EXPECT_EQ(
        refusedOn(audit.device),
        "still               broken: the double-precision reference breaks it too: the changed scene is read "
        "differently, or the relation does not hold for this scene; most likely a bug of Diptych\n" +
            details +
            "  reference, double precision: broken: lit 1e-07, allowed 2e-07, at 4,5; another surface at 9 "
            "pixels (at most 8); tolerance: 1e-06 of the value plus 0.0078 of its change to the next "
            "pixel\n");
}

TEST(RelationDocument, JsonHasEveryChannel) {
    nlohmann::ordered_json json = toJson(someRelations());
    json.erase("settings");
    const auto pixels = [](int excluded, int filtered) {
        return fmt::format(R"("pixels":{{"covered":100,"set_aside":{},"most_set_aside":8,)"
                           R"("filtered_otherwise":{},"most_filtered_otherwise":8}},"channels":)",
                           excluded, filtered);
    };
    const std::string described = R"(,"changes":"all is pushed","alike":")",
                      exact = R"(","because":"pushing is exact","verdict":")",
                      bits = R"("verdict":"holds","tolerance":"bit for bit",)" + pixels(0, 0),
                      rounding =
                          R"("tolerance":"1e-06 of the value plus 0.0078 of its change to the next pixel",)",
                      reference = R"({"path":"reference","settings":{"reference-mode":"scene"},)",
                      unreadBy = R"(,"settings":{},"verdict":"does not apply",)"
                                 R"("because":"it does not read the changed input"})",
                      picture = R"("pushed-forward_plus-full-)";
    EXPECT_EQ(
        json.dump(),
        R"({"schema":1,"verdict":"fail","scene":"builtin:pushed","camera":"front","device":{"name":"A GPU",)"
        R"("driver":"driver 1.2","type":"discrete"},"notes":[],"relations":[)"
        R"({"name":"still")" +
            described + "bits" + exact + R"(holds","series":[{"path":"deferred","settings":{},)" + bits +
            R"([{"name":"lit","error":1e-07,"allowed":2e-07,"used":0.5,"worst_pixel":[4,5],)"
            R"("pixels_beyond":0}]},)"
            R"({"path":"forward_plus","settings":{},)" +
            bits +
            R"([{"name":"lit","error":12.0,"allowed":16.0,"used":0.75,"worst_pixel":[4,5],)"
            R"("pixels_beyond":0}]},)" +
            reference + R"("verdict":"holds",)" + rounding + pixels(0, 0) +
            R"([{"name":"lit","error":1e-07,"allowed":2e-07,"used":5.0,"worst_pixel":[4,5],)"
            R"("pixels_beyond":0}]}]},)"
            R"({"name":"absent")" +
            described + "bits" + exact +
            R"(does not apply","lacks":"the scene has one light","series":[]},)"
            R"({"name":"unread")" +
            described + "sums" + exact + R"(does not apply","series":[{"path":"deferred")" + unreadBy +
            R"(,{"path":"forward_plus")" + unreadBy + R"(]},{"name":"pushed")" + described + "rounding" +
            exact +
            R"(broken","blame":"holds in double precision: a bug of the driver or of Diptych, on A GPU with )"
            R"(driver 1.2","series":[{"path":"deferred","settings":{},"verdict":"holds",)" +
            rounding + pixels(3, 1) +
            R"([{"name":"lit","error":1e-07,"allowed":2e-07,"used":0.5,"worst_pixel":[4,5],)"
            R"("pixels_beyond":0}]},)"
            R"({"path":"forward_plus","settings":{"gbuffer":"full","ibl":"sampled"},"verdict":"broken",)" +
            rounding + pixels(0, 0) +
            R"([{"name":"lit","error":0.0003,"allowed":0.0001,"used":3.0,"worst_pixel":[1,2],)"
            R"("pixels_beyond":2},)"
            R"({"name":"depth","error":0.5,"allowed":0.125,"used":4.0,"worst_pixel":[6,7],)"
            R"("pixels_beyond":1},)"
            R"({"name":"normals","error":1.0,"allowed":2.0,"used":0.5,"worst_pixel":[0,0],)"
            R"("pixels_beyond":0}],)"
            R"("pictures":[)" +
            picture + R"(given.png",)" + picture + R"(changed.png",)" + picture +
            R"(used.png"]},)"
            R"({"path":"deferred","settings":{"gbuffer":"full"},"verdict":"does not apply",)"
            R"("because":"deferred does not read the changed input"},)" +
            reference + R"("verdict":"holds",)" + rounding + pixels(0, 0) + R"([]}]}]})");
    // What cannot be a number in JSON, and what was not drawn.
    RelationAudit odd = someRelations();
    odd.relations.resize(1);
    SeriesResult& of = odd.relations[0].series[0];
    of.comparison.channels[0].used = std::numeric_limits<double>::infinity();
    of.comparison.failed = "no memory";
    const nlohmann::ordered_json first = toJson(odd)["relations"][0]["series"][0];
    EXPECT_EQ(first["channels"][0]["used"], "infinite");
    EXPECT_EQ(first["failed"], "no memory");
    EXPECT_EQ(first["verdict"], "broken");
}

TEST(RelationDocument, ThePageShowsWhatIsBrokenFirst) {
    const std::filesystem::path out = folder() / "relations";
    writeRelations(someRelations(), out, false);
    const std::string page = contentsOf(out / "index.html");
    EXPECT_EQ(
        pageTexts(page),
        "Diptych\nfail\n builtin:pushed\nchanges that must not change the picture; 2x1 on A GPU (driver "
        "1.2); \n"
        "front\nFAIL: 1 of 4 relations hold, 1 broken, 2 not applicable\nAll verdicts\n"
        "relation\nverdict\nrenderer\nerror / allowed\nworst pixel\n"
        "pushed\nholds\ndeferred\n0.5\nlit 1e-07, allowed 2e-07, at 4,5; another surface at 3 pixels (at "
        "most 8); "
        "a texture filtered differently at 1 pixel (at most 8)\n"
        "pushed\nbroken\nforward_plus, gbuffer full, ibl sampled\n4\ndepth 0.5, allowed 0.125, at 6,7\n"
        "pushed\ndoes not apply\ndeferred, gbuffer full\ndeferred does not read the changed input\n"
        "pushed\nholds\nreference, double precision\n0\nequal\n"
        "still\nholds\ndeferred\n0.5\nlit 1e-07 ULP, allowed 2e-07, at 4,5\n"
        "still\nholds\nforward_plus\n0.75\nlit 12 ULP, allowed 16, at 4,5\n"
        "still\nholds\nreference, double precision\n5\nlit 1e-07, allowed 2e-07, at 4,5\n"
        "absent\ndoes not apply\nthe scene has one light\n"
        "unread\ndoes not apply\ndeferred\nit does not read the changed input\n"
        "unread\ndoes not apply\nforward_plus\nit does not read the changed input\n"
        "Each relation compares two pictures of one renderer, so it needs no ground truth. A pixel&#39;s "
        "error is "
        "divided by the error allowed there: above 1 the relation is broken. Pixels at an edge that show "
        "another "
        "surface are excluded, and so are textured pixels that a filter weights differently; the number of "
        "both "
        "is limited.\nThe relations\n"
        "pushed \nbroken\nall is pushed; pushing is exact\n"
        "holds in double precision: a bug of the driver or of Diptych, on A GPU with driver 1.2\n"
        "deferred: holds: lit 1e-07, allowed 2e-07, at 4,5; another surface at 3 pixels (at most 8); a "
        "texture "
        "filtered differently at 1 pixel (at most 8)\n"
        "forward_plus, gbuffer full, ibl sampled: broken: depth 0.5, allowed 0.125, at 6,7; tolerance: 1e-06 "
        "of "
        "the value plus 0.0078 of its change to the next pixel\n"
        "forward_plus, gbuffer full, ibl sampled, lit: 2 pixels out of tolerance, the worst at 1,2: 0.0003, "
        "allowed 0.0001\n"
        "forward_plus, gbuffer full, ibl sampled, depth: 1 pixel out of tolerance, the worst at 6,7: 0.5, "
        "allowed "
        "0.125\n"
        "original, forward_plus, gbuffer full, ibl sampled\nchanged, forward_plus, gbuffer full, ibl "
        "sampled\n"
        "error / allowed, forward_plus, gbuffer full, ibl sampled\n"
        "reference, double precision: holds: equal\n"
        "still \nholds\nall is pushed; pushing is exact\nforward_plus: lit 12 ULP, allowed 16, at 4,5\n"
        "absent \ndoes not apply\nall is pushed; pushing is exact\nthe scene has one light\n"
        "unread \ndoes not apply\nall is pushed; pushing is exact\nneither path reads the changed input\n"
        "pushed-forward_plus-full-changed.png\n \npushed-forward_plus-full-given.png\n \n"
        "pushed-forward_plus-full-used.png\n \nrelations.json\n ");
    for (const auto& [markup, count] : {std::pair{"<span class=\"verdict pass\">holds", 6u},
                                        {"<span class=\"verdict fail\">broken", 2u},
                                        {"<span class=\"soft\">does not apply", 6u},
                                        {"data-value=\"-1\"", 4u},
                                        {"<b>holds in double", 1u},
                                        {"<p class=\"soft small\">", 4u},
                                        {"href=\"#pushed\"", 4u},
                                        {"id=\"pushed\"", 1u},
                                        {"<i class=\"swatch reference\">", 3u}})
        EXPECT_EQ(countOf(page, markup), count) << markup;
}

// Both pictures have the exposure of the first; the third shows which part of the tolerance is used.
TEST(RelationDocument, ThePicturesShareAnExposure) {
    const std::filesystem::path out = folder() / "relations";
    const RelationAudit audit = someRelations();
    writeRelations(audit, out, false);
    const std::string stem = "pushed-forward_plus-full-";
    const SeriesResult& broken = audit.relations[3].series[1];
    EXPECT_EQ(imageName(pushed, broken.series, "given"), stem + "given.png");
    EXPECT_EQ(imageName(pushed, {Path::deferred, {}}, "used"), "pushed-deferred-used.png");
    ImageScale scale;
    scale.exposure = exposureFor({}, &broken.original->channels.at(Channel::lit),
                                 coverage(*broken.original, *broken.original));
    const DebugMode& lit = debugMode(Channel::lit);
    const auto colorsOf = [&](const char* shown) {
        const Image8 image = readPng(out / (stem + shown + ".png"));
        std::vector<std::uint8_t> colors;
        for (std::size_t i = 0; i < image.data.size(); ++i)
            if (i % 4 != 3) colors.push_back(image.data[i]);
        return colors;
    };
    EXPECT_EQ(colorsOf("given"), channelImage(lit, *broken.original, scale).data);
    EXPECT_EQ(colorsOf("changed"), channelImage(lit, *broken.changed, scale).data);
    EXPECT_EQ(colorsOf("used"), errorMap(broken.comparison.used_by_pixel, 1).data);
}

TEST(RelationDocument, ATolerancesWordsAreOfItsEquality) {
    RelationTolerance tolerance;
    EXPECT_EQ(tolerance.describe(), "bit for bit");
    tolerance.ulps = 16;
    EXPECT_EQ(tolerance.describe(), "16 ULP of the largest component");
    tolerance.relative = 1.5e-6;
    tolerance.equality = Equality::sums;
    EXPECT_EQ(tolerance.describe(), "lit: 1.5e-06 of each component");
    tolerance.equality = Equality::rounding;
    EXPECT_EQ(tolerance.describe(), "1.5e-06 of the value");
    tolerance.step = 0x1p-7;
    EXPECT_EQ(tolerance.describe(), "1.5e-06 of the value plus 0.0078 of its change to the next pixel");
    for (const auto& [equality, name] :
         {std::pair{Equality::bits, "bits"}, {Equality::sums, "sums"}, {Equality::rounding, "rounding"}})
        EXPECT_EQ(nameOf(equality), name);
}

}  // namespace diptych::audit
