// SPDX-License-Identifier: MIT
// Notes of a comparison and of two files, each with its cause and the nearest case without it. Notes about a
// Frame's counters: compare_options_test.cpp; about channels of one side: strict_test.cpp.
#include "compare/verdict/image_diff.h"
#include "compare/verdict/pair_reports.h"
#include "shared/frame/supported_channels.h"
#include "shared/image/exr.h"
#include "shared/image/png.h"
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

}  // namespace
}  // namespace diptych
