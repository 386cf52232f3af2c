// SPDX-License-Identifier: MIT
// What a report says of the Frames that it compared: origin, times, memory, Settings, camera.
#include "compare/output/writers.h"
#include "compare/report/document.h"
#include "compare/report/titles.h"

#include <gtest/gtest.h>

#include <limits>

namespace diptych {
namespace {

Frame timedFrame(Path path) {
    Frame frame;
    frame.name = std::string(nameOf(path));
    frame.scene = "<scene>";
    frame.settings.path = path;
    frame.settings.size = {4, 3};
    frame.time = {.median = 12.345, .min = 1.5, .max = 23, .runs = 5};
    frame.bytes = {.images = 2048, .buffers = 3 << 20, .gbuffer_per_pixel = 20};
    return frame;
}

// Both Frames, compared without any channel.
struct TimedPair {
    Report report;
    Frame &left, &right;
    TimedPair() : report(ofTwo()), left(report.frames[0]), right(report.frames[1]) {}

    static Report ofTwo() {
        Report report;
        report.frames = {timedFrame(Path::deferred), timedFrame(Path::forward_plus)};
        report.comparisons.emplace_back().test = 1;
        return report;
    }
    std::vector<output::Block> blocks() const {
        std::vector<output::Block> all;
        addFrames(all, report, report.comparisons[0]);
        return all;
    }
};

TEST(FrameLines, SayWhatMadeEach) {
    const auto lineOf = [](const auto& change) {
        Frame frame = timedFrame(Path::deferred);
        change(frame);
        const std::string lines =
            output::inText({output::Block(frameLines(frame, timedFrame(Path::forward_plus)))});
        return lines.substr(0, lines.find('\n'));
    };
    const std::string time = "  deferred: 12.35 ms (1.5 to 23, 5 runs)",
                      bytes = ", 20 bytes per pixel of G-buffer and depth";
    EXPECT_EQ(lineOf([](Frame&) {}), time + bytes);
    EXPECT_EQ(lineOf([](Frame& f) { f.time.runs = 0; }), "  deferred" + bytes);
    EXPECT_EQ(lineOf([](Frame& f) { f.time.runs = 1; }), "  deferred: 12.35 ms (1.5 to 23, 1 run)" + bytes);
    EXPECT_EQ(lineOf([](Frame& f) { f.time.object_lists = 0.12345; }),
              time + ", 0.123 ms on the host to choose each object's lights" + bytes);
    EXPECT_EQ(
        lineOf([](Frame& f) { f.origin = {.file = "", .device = "a GPU", .driver = "2.0", .commit = ""}; }),
        time + ", on a GPU, 2.0" + bytes);
    EXPECT_EQ(lineOf([](Frame& f) { f = timedFrame(Path::forward_plus); }),
              "  forward_plus: 12.35 ms (1.5 to 23, 5 runs), 20 bytes per pixel of depth");
    EXPECT_EQ(lineOf([](Frame& f) {
                  f = timedFrame(Path::reference);
                  f.settings.reference_mode = ReferenceMode::surface;
                  f.made_in_ms = 1234.5;
              }),
              "  reference: double precision, mode surface, rendered in 1.23 s");
    // Of files, nothing else is known.
    EXPECT_EQ(
        lineOf([](Frame& f) { f.origin = {.file = "a.exr", .device = "", .driver = "2", .commit = "c"}; }),
        "  deferred: a.exr");
    EXPECT_EQ(lineOf([](Frame& f) {
                  f.origin = {.file = "a.exr", .device = "a GPU", .driver = "2.0", .commit = "1a2b"};
              }),
              "  deferred: a.exr, on a GPU, 2.0, commit 1a2b");
    const auto external = [&](const std::vector<std::string>& corrections) {
        return lineOf([&](Frame& f) {
            f.origin = {.file = "a.exr", .device = "a GPU", .driver = "", .commit = ""};
            f.origin.external = true;
            f.origin.corrections = corrections;
        });
    };
    EXPECT_EQ(external({}), "  deferred: a.exr, external renderer, no corrections");
    EXPECT_EQ(external({"one", "two"}), "  deferred: a.exr, external renderer, corrections: one; two");
    EXPECT_EQ(output::inHtml(frameLines(timedFrame(Path::deferred), timedFrame(Path::forward_plus))),
              "<div class=\"box says\"><ul><li><bdi>deferred: 12.35 ms (1.5 to 23, 5 runs), 20 bytes per "
              "pixel of G-buffer and depth</bdi></li><li><bdi>forward_plus: 12.35 ms (1.5 to 23, 5 runs), "
              "20 bytes per pixel of depth</bdi></li></ul></div>\n");
}

// Each bar's length is a fraction of the longest time.
TEST(FrameBlocks, TimesHaveBars) {
    TimedPair pair;
    pair.left.time.median = 2;
    pair.right.time.median = 3;
    pair.left.passes = {{"g<b", 1}, {"shade", 0.5}};
    pair.right.passes = {{"shade", 4}};
    const std::string columns = output::inHtml(pair.blocks().at(1)), end = "</div>\n";
    const auto row = [](const std::string& name, char kind, const std::string& width, const std::string& ms) {
        return "<tr><td>" + name + "</td><td class=\"bars\"><i class=\"bar " + kind +
               "\" style=\"width:" + width + "%\"></i></td><td class=\"n\">" + ms + "</td></tr>\n";
    };
    const auto soft = [](const std::string& name) { return "<span class=\"soft\">" + name + "</span>"; };
    const std::string times =
        "<div class=\"columns\"><div class=\"box\"><h4>Time</h4>\n<div class=\"scroll\"><table><thead><tr>"
        "<th>frame and passes</th><th class=\"bars\"></th><th class=\"n\">ms</th></tr></thead>\n<tbody>" +
        row("<b>deferred</b>", 'a', "50.00", "<b>2.00</b>") + row(soft("g&lt;b"), 'a', "25.00", "1.00") +
        row(soft("shade"), 'a', "12.50", "0.50") + row("<b>forward_plus</b>", 'b', "75.00", "<b>3.00</b>") +
        row(soft("shade"), 'b', "100.00", "4.00") +
        "</tbody></table><p class=\"soft small\">Whole frames are timed without profiling, both paths "
        "interleaved. Passes are medians of separate, profiled runs and need not add up to a frame. Host "
        "times are not included.</p>\n" +
        end + end;
    EXPECT_EQ(columns.substr(0, times.size()), times);
    pair.left.time.median = pair.right.time.median = 0;
    pair.left.passes.clear();
    pair.right.passes.clear();
    const std::string none =
        "<div class=\"columns\"><div class=\"box\"><h4>Time</h4>\n<p class=\"soft\">not "
        "timed</p>\n" +
        end;
    EXPECT_EQ(output::inHtml(pair.blocks().at(1)).substr(0, none.size()), none);
    pair.right.passes = {{"shade", 0.125}};  // a pass alone
    EXPECT_NE(output::inHtml(pair.blocks().at(1)).find(row(soft("shade"), 'b', "100.00", "0.12")),
              std::string::npos);
}

TEST(FrameBlocks, CostsStandSideBySide) {
    TimedPair pair;
    pair.left.counters.lights = 7;
    pair.right.counters.lights = 8;
    pair.left.counters.overflowed_lists = 1;
    pair.right.counters.nonfinite_pixels = 2;
    pair.left.counters.unreproduced_pixels = 3;
    pair.right.counters.energy_cut = 0.012345;
    pair.right.bytes.gbuffer_per_pixel = 4;
    const auto row = [](const std::string& name, const std::string& a, const std::string& b) {
        return "<tr><td>" + name + "</td><td class=\"n\">" + a + "</td><td class=\"n\">" + b + "</td></tr>\n";
    };
    const auto costs = [&] {
        const std::string columns = output::inHtml(pair.blocks().at(1));
        return columns.substr(columns.find("<div class=\"box\"><h4>Memory"));
    };
    const std::string head =
        "<div class=\"box\"><h4>Memory and counters</h4>\n<div class=\"scroll\"><table><thead><tr><th></th>"
        "<th class=\"n\">deferred</th><th class=\"n\">forward_plus</th></tr></thead>\n<tbody>" +
        row("images", "2 KiB", "2 KiB") + row("buffers", "3 MiB", "3 MiB") +
        row("G-buffer and depth per pixel", "20 B", "4 B") + row("lights", "7", "8") +
        row("overflowed light lists", "1", "0");
    const std::string cut =
        row("flux that the light cutoff removes from lights without a range", "0 %", "1.23 %") +
        row("NaN or infinite lit pixels", "0", "2");
    const std::string end =
        row("pixels the capture did not reproduce", "3", "0") + "</tbody></table></div>\n</div>\n</div>\n";
    const std::string noise = "pixels that a second run changed";
    EXPECT_EQ(costs(), head + cut + row(noise, "not run", "not run") + end);
    // Rows of what only one side has; the largest count of all channels.
    pair.left.counters.shadow_pages = {.requested = 9, .resident = 5, .fallback = 4, .drawn = 6};
    pair.right.counters.unsorted = {.fragments = 11, .pixels = 10};
    pair.left.noise = {{Channel::lit, {0, 0}}};
    pair.right.noise = {{Channel::lit, {2, 0}}, {Channel::albedo, {3, 0}}, {Channel::normals, {1, 0}}};
    const std::string pages = "shadow pages, and those replaced by a coarser level",
                      lists = "blended fragments that did not fit in a list, and their pixels";
    EXPECT_EQ(costs(), head + row(pages, "9, 4", "0, 0") + row(lists, "0, 0", "11, 10") + cut +
                           row(noise, "0", "3") + end);
    std::swap(pair.left.counters, pair.right.counters);
    EXPECT_NE(costs().find(row(pages, "0, 0", "9, 4") + row(lists, "11, 10", "0, 0")), std::string::npos);
}

TEST(FrameBlocks, SettingsThatDifferAreMarked) {
    TimedPair pair;
    pair.left.settings.camera = "<door>";
    pair.right.settings.camera = "roof";
    const std::string table = output::inHtml(pair.blocks().at(2));
    const std::string head =
        "<details class=\"box settings\"><summary><b>Settings </b><span class=\"soft\">all; differences are "
        "coloured</span></summary><div class=\"scroll\"><table><thead><tr><th></th><th class=\"mono wide\">"
        "deferred</th><th class=\"mono wide\">forward_plus</th></tr></thead>\n<tbody>";
    EXPECT_EQ(table.substr(0, head.size()), head);
    EXPECT_NE(
        table.find("<tr class=\"differs\"><td>camera</td><td class=\"mono wide\">&quot;&lt;door&gt;&quot;"
                   "</td><td class=\"mono wide\">&quot;roof&quot;</td></tr>\n"),
        std::string::npos)
        << table;
    EXPECT_NE(table.find("<tr><td>size</td><td class=\"mono wide\">[4,3]</td><td class=\"mono wide\">"
                         "[4,3]</td></tr>\n"),
              std::string::npos)
        << table;
}

TEST(FrameBlocks, TheCameraIsThatOfTheTest) {
    TimedPair pair;
    FrameCamera& camera = pair.right.camera;
    camera = {.name = "<door>", .eye = {1, 2, 3.123456}, .target = {4, 5, 6}, .fov_degrees = 45.678};
    camera.near = 0.0123456;
    camera.far = std::numeric_limits<double>::infinity();
    const auto line = [&] { return output::inHtml(pair.blocks().at(3)); };
    const std::string start =
                          "<p class=\"soft camera\">Scene <bdi>&lt;scene&gt;</bdi>. Camera <bdi>&lt;door&gt;",
                      eye = ": eye 1, 2, 3.1235; target 4, 5, 6; ";
    EXPECT_EQ(line(), start + "</bdi>" + eye + "45.68\u00b0 vertical; near 0.01235, far inf m</p>\n");
    camera.fov_degrees = 0;
    camera.far = 1234.56;
    camera.choice = "of <six>";
    pair.right.settings.time = 0.5;
    EXPECT_EQ(line(), start + ", 0.5 s</bdi> (<bdi>of &lt;six&gt;</bdi>)" + eye +
                          "orthographic; near 0.01235, far 1235 m</p>\n");
}

// Of two files nothing more is known; of a file and a Frame, all of the Frame.
TEST(FrameBlocks, FilesHaveOnlyTheirLines) {
    TimedPair pair;
    EXPECT_EQ(pair.blocks().size(), 4u);
    pair.left.origin.file = "a.exr";
    EXPECT_EQ(pair.blocks().size(), 4u);
    pair.right.origin.file = "b.exr";
    EXPECT_EQ(pair.blocks().size(), 1u);
    pair.left.origin.file = "";
    EXPECT_EQ(pair.blocks().size(), 4u);
}

}  // namespace
}  // namespace diptych
