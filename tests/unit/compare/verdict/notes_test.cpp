// SPDX-License-Identifier: MIT
// Notes of a comparison and of two files, each with its cause and the nearest case without it. Notes about a
// Frame's counters: compare_options_test.cpp; about channels of one side: strict_test.cpp.
#include "compare/verdict/image_diff.h"
#include "compare/verdict/pair_reports.h"
#include "shared/frame/supported_channels.h"
#include "shared/image/exr.h"
#include "shared/image/png.h"
#include "tests/support/errors.h"
#include "tests/support/files.h"
#include "tests/support/frames.h"
#include "tests/support/report_builder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace diptych {
namespace {

using NoteLines = std::vector<std::string>;
using FramesChange = std::function<void(std::vector<Frame>&)>;

NoteLines notesOfFrames(const FramesChange& change, bool allow_noise) {
    Report report;
    report.device = {"a GPU", "1.0", "discrete"};
    report.frames = bothFrames();
    change(report.frames);
    CompareOptions options;
    options.allow_noise = allow_noise;
    return compareFrames(report, 0, 1, {}, options).notes;
}

// Lines of `all` that `others` lacks.
NoteLines added(const NoteLines& all, const NoteLines& others) {
    NoteLines lines;
    for (const std::string& line : all)
        if (std::ranges::count(others, line) == 0) lines.push_back(line);
    return lines;
}

// The first frame becomes the reference's; the other has some samples.
void againstReference(std::vector<Frame>& frames, int samples) {
    frames[0] = frames[1];
    frames[0].name = "reference";
    frames[0].settings.path = Path::reference;
    frames[0].settings.reference_mode = ReferenceMode::scene;
    frames[0].through_gbuffer.clear();
    std::erase_if(frames[0].channels,
                  [](const auto& channel) { return !isSupportedByReference(debugMode(channel.first)); });
    for (Frame& frame : frames) frame.settings.msaa = samples;
}

TEST(ComparisonNotes, ComeWithTheirCauseAlone) {
    struct Case {
        NoteLines notes;
        FramesChange cause, nearest;
        bool allow_noise = false;
    };
    const auto noise = [](std::uint64_t pixels) {
        return [=](std::vector<Frame>& frames) { frames[1].noise[Channel::lit] = {pixels, 0.25}; };
    };
    const auto erase = [](std::vector<Channel> channels) {
        return [=](std::vector<Frame>& frames) {
            for (Frame& frame : frames)
                for (const Channel channel : channels) frame.channels.erase(channel);
        };
    };
    const auto external = [](bool is) {
        return [=](std::vector<Frame>& frames) {
            for (const Channel channel : {Channel::albedo, Channel::normals})
                frames[1].channels.erase(channel);
            frames[1].origin.external = is;
        };
    };
    const auto omitted = [](bool is) {
        return [=](std::vector<Frame>& frames) {
            frames[0].requested = frames[1].requested = {Channel::lit};
            frames[1].origin.omitted_channels = {"mystery"};
            frames[1].origin.external = is;
        };
    };
    const auto assigned = [](Assignment to) {
        return [=](std::vector<Frame>& frames) {
            frames[0].settings.assign = Assignment::tiled;
            frames[1].settings.assign = to;
            for (Frame& frame : frames)
                std::erase_if(frame.channels, [](const auto& channel) {
                    return channel.first != Channel::lit && channel.first != Channel::light_count;
                });
        };
    };
    const Case cases[] = {
        {{"forward_plus: two runs differ in lit at 1 pixel, by up to 0.25; --allow-noise adds that to the "
          "tolerance"},
         noise(1),
         noise(0)},
        {{"forward_plus: two runs differ in lit at 1 pixel, by up to 0.25, which is added to the tolerance"},
         noise(1),
         noise(0),
         true},
        {{"without material_id and depth, background pixels count in every mean"},
         erase({Channel::material_id, Channel::depth}),
         erase({Channel::depth})},
        {{"forward_plus does not have albedo, normals: not compared"}, external(true), external(false)},
        {{"mystery of forward_plus: not compared, Diptych has no such channel"},
         omitted(true),
         omitted(false)},
        {{"deferred and forward_plus have different Settings: --assign tiled and clustered",
          "light_count was not compared: --assign tiled and clustered evaluate different lights"},
         assigned(Assignment::clustered),
         assigned(Assignment::tiled)},
        {{"only lit is compared with the reference: with MSAA, a path's other channels show one sample, the "
          "reference's the pixel centre"},
         [](std::vector<Frame>& frames) { againstReference(frames, 4); },
         [](std::vector<Frame>& frames) { againstReference(frames, 1); }},
    };
    for (const Case& c : cases) {
        const NoteLines caused = notesOfFrames(c.cause, c.allow_noise),
                        near = notesOfFrames(c.nearest, c.allow_noise);
        EXPECT_EQ(added(caused, near), c.notes);
    }
}

TEST(ComparisonNotes, AnotherRenderersBackgroundIsCounted) {
    for (const bool lit : {true, false}) {
        Frame ours = flatFrame(Path::deferred, 3, 1, 0.5f),
              theirs = flatFrame(Path::forward_plus, 3, 1, 0.5f);
        ours.channels[Channel::material_id].data = {-1, 0, -1};
        theirs.name = "other";
        std::ranges::fill_n(theirs.channels[Channel::lit].data.begin(), 3, lit ? 0.125f : 0.0f);
        std::ranges::fill_n(theirs.channels[Channel::lit].data.begin() + 6, 3, 0.0f);
        showOurBackground(theirs, ours);
        EXPECT_EQ(theirs.notes,
                  lit ? NoteLines{"other is not black at 1 pixel where deferred shows no surface: a "
                                  "background or shifted edges; these pixels are not compared"}
                      : NoteLines{});
    }
}

// Background pixels of another renderer become ours in every channel of ours; it gets our ids and depths.
TEST(ComparisonNotes, AnotherRenderersBackgroundBecomesOurs) {
    Frame ours = flatFrame(Path::deferred, 3, 1, 0.5f), theirs = flatFrame(Path::forward_plus, 3, 1, 0.25f);
    ours.channels[Channel::material_id].data = {-1, 0, -1};
    ours.channels[Channel::albedo] = Image(3, 1, 3, 0.75f);
    ours.channels[Channel::depth] = Image(3, 1, 1, 2);
    theirs.channels[Channel::albedo] = Image(3, 1, 3, 1);
    theirs.channels[Channel::metallic] = Image(3, 1, 1, 1);
    theirs.channels.erase(Channel::material_id);
    const Frame before = theirs;
    showOurBackground(theirs, ours);
    EXPECT_EQ(theirs.channels.at(Channel::lit).data,
              (PixelData{0.5f, 0.5f, 0.5f, 0.25f, 0.25f, 0.25f, 0.5f, 0.5f, 0.5f}));
    EXPECT_EQ(theirs.channels.at(Channel::albedo).data,
              (PixelData{0.75f, 0.75f, 0.75f, 1, 1, 1, 0.75f, 0.75f, 0.75f}));
    EXPECT_EQ(theirs.channels.at(Channel::metallic).data, (PixelData{1, 1, 1})) << "ours has none";
    EXPECT_EQ(theirs.channels.at(Channel::material_id).data, ours.channels.at(Channel::material_id).data);
    EXPECT_EQ(theirs.channels.at(Channel::depth).data, ours.channels.at(Channel::depth).data);
    EXPECT_EQ(theirs.requested, (std::vector<Channel>{Channel::lit, Channel::albedo, Channel::metallic}));
    // Nothing changes where our background is unknown, or at another size.
    ours.channels.erase(Channel::material_id);
    ours.channels.erase(Channel::depth);
    theirs = before;
    showOurBackground(theirs, ours);
    EXPECT_EQ(theirs.channels.at(Channel::lit).data, before.channels.at(Channel::lit).data);
    EXPECT_TRUE(theirs.requested.empty());
}

TEST(DiffNotes, ComeWithTheirCauseAlone) {
    const std::filesystem::path here = folder();
    const auto notes = [&](const char* a, const char* b, const char* metric = "flip") {
        ImageDiffOptions options;
        options.metric = metric;
        options.tolerance = 1;
        options.tolerance_requested = true;
        return diffImages((here / a).string(), (here / b).string(), options).notes;
    };
    const auto write = [&](const char* name, float first) {
        Image image(24, 24, 3, 0.5f);
        image.data[0] = first;
        writeExr(here / name, {{{"R", "G", "B"}, &image}});
    };
    write("half.exr", 0.5f);
    write("nan.exr", std::numeric_limits<float>::quiet_NaN());
    write("below.exr", -1);
    write("far_below.exr", -3);
    EXPECT_EQ(notes("half.exr", "half.exr"), NoteLines{});
    EXPECT_EQ(notes("nan.exr", "nan.exr")[0],
              "lit: 1 pixel of the reference and 1 of the test are NaN or infinite");
    EXPECT_EQ(notes("nan.exr", "half.exr")[0],
              "lit: 1 pixel of the reference and 0 of the test are NaN or infinite");
    const std::string unseen =
        "lit: FLIP cannot see 1 pixel that differs (negative, or beyond its exposures): error 1 each";
    EXPECT_EQ(notes("below.exr", "far_below.exr"), NoteLines{unseen});
    EXPECT_EQ(notes("below.exr", "below.exr"), NoteLines{});
    EXPECT_EQ(notes("below.exr", "far_below.exr", "max"), NoteLines{});
    writePng(here / "a.png", {24, 24, 3, std::vector<std::uint8_t>(24 * 24 * 3, 188)});
    const std::string decoded =
        (here / "a.png").string() + " is PNG; it was decoded from sRGB to linear to match the other";
    EXPECT_EQ(notes("a.png", "half.exr"),
              (NoteLines{decoded, "lit: 8 bit in the reference, float in the test"}));
    EXPECT_EQ(notes("half.exr", "a.png"),
              (NoteLines{decoded, "lit: float in the reference, 8 bit in the test"}));
    EXPECT_EQ(notes("a.png", "a.png"), NoteLines{});
}

// A colour at an alpha of 0 in both files is invisible.
TEST(DiffNotes, AHiddenDifferenceIsNamed) {
    const std::filesystem::path here = folder();
    for (const std::string layer : {"", "glass."})
        for (const float alpha : {0.0f, 1.0f}) {
            for (const char* file : {"a.exr", "b.exr"}) {
                Image color(24, 24, 3, 0.5f), cover(24, 24, 1, 1.0f);
                if (file[0] == 'b') color.at(3, 5, 1) = 0.25f, color.at(7, 5, 2) = 0.25f;
                cover.at(7, 5) = 0;
                cover.at(3, 5) = file[0] == 'a' ? alpha : 0.0f;
                writeExr(here / file,
                         {{{layer + "R", layer + "G", layer + "B"}, &color}, {{layer + "A"}, &cover}});
            }
            ImageDiffOptions options;
            options.channels = {layer.empty() ? "lit" : "glass"};
            for (const bool alone : {true, false}) {
                if (!alone) options.channels.clear();
                const ImageDiff diff =
                    diffImages((here / "a.exr").string(), (here / "b.exr").string(), options);
                const std::string name = layer.empty() ? "A" : "glass.A",
                                  said = "; " + name +
                                         " is 0 in both wherever they differ, so the difference is invisible";
                const ImageChannelDiff& color = *diff.channels.front();
                EXPECT_EQ(color.decision.reason.find(said) != std::string::npos, alpha == 0 && !alone)
                    << color.pair.name << ": " << color.decision.reason;
                EXPECT_EQ(color.decision.level, Level::fail);
                EXPECT_EQ(color.worst_y, 5);
            }
        }
}

TEST(DiffNotes, BlackMeansBothImages) {
    const std::filesystem::path here = folder();
    const Image none(4, 3, 3);
    Image lit = none;
    lit.at(2, 1, 2) = 1;
    writeExr(here / "a.exr", {{{"R", "G", "B"}, &none}});
    writeExr(here / "b.exr", {{{"R", "G", "B"}, &lit}});
    const auto emptiness = [&](const char* a, const char* b) {
        ImageDiffOptions options;
        return diffImages((here / a).string(), (here / b).string(), options).emptiness;
    };
    EXPECT_NE(emptiness("a.exr", "a.exr"), "");
    EXPECT_EQ(emptiness("a.exr", "b.exr"), "");
    EXPECT_EQ(emptiness("b.exr", "a.exr"), "");
    ImageDiffOptions options;
    options.selection.crop = Crop{0, 0, 2, 3};
    const ImageDiff part = diffImages((here / "b.exr").string(), (here / "a.exr").string(), options);
    EXPECT_TRUE(part.passed());
    EXPECT_NE(part.emptiness, "") << "in the compared part";
    EXPECT_EQ(part.notes, NoteLines{"6 of 12 pixels are compared; options exclude the others"});
}

// A metric that a channel lacks demands equality there.
TEST(DiffNotes, ChannelsWithoutTheMetricAreNamed) {
    const std::filesystem::path here = folder();
    const Image color(24, 24, 3, 0.5f), one(24, 24, 1, 0.5f);
    Image other = one;
    other.at(3, 5) = 0.25f;
    writeExr(here / "a.exr", {{{"R", "G", "B"}, &color}, {{"x.Y"}, &one}, {{"y.Y"}, &one}});
    writeExr(here / "b.exr", {{{"R", "G", "B"}, &color}, {{"x.Y"}, &one}, {{"y.Y"}, &other}});
    ImageDiffOptions options;
    options.metric_requested = options.tolerance_requested = true;
    options.tolerance = 1;
    const ImageDiff diff = diffImages((here / "a.exr").string(), (here / "b.exr").string(), options);
    EXPECT_EQ(diff.notes, NoteLines{"flip is not defined for x, y: only equal values pass"});
    std::vector<std::string> reasons;
    for (const auto& channel : diff.channels) reasons.push_back(channel->decision.reason);
    EXPECT_EQ(reasons, (NoteLines{"", "",
                                  "max 0.25 exceeds 0, at 0.174 % of the pixels; judge it by a rule, by a "
                                  "--metric defined for it, or leave it out with --channels"}));
    EXPECT_EQ(diff.channels.back()->worst_x, 3);
    EXPECT_EQ(diff.channels.back()->worst_y, 5);
    options.channels = {"x"};
    EXPECT_EQ(faultOf([&] { diffImages((here / "a.exr").string(), (here / "b.exr").string(), options); }),
              "--metric flip: not defined for any channel of these images: x");
    for (const auto& [name, metric] : {std::pair{"relative", "relative_max"},
                                       {"angular", "angle_max"},
                                       {"angle", "angle_max"},
                                       {"ulp", "ulp_max"},
                                       {"relmse", "relative_mse"},
                                       {"psnr", "psnr"}})
        EXPECT_EQ(metricOfOption(name), metric);
    EXPECT_TRUE(
        faultOf([&] {
            metricOfOption("maxx");
        }).starts_with("--metric maxx: unknown metric; use one of relative, angular, ulp, max, mean, "));
}

}  // namespace
}  // namespace diptych
