// SPDX-License-Identifier: MIT
// Notes on a baseline, before any number: everything that changed, and nothing else.
#include "compare/verdict/baseline.h"
#include "compare/files/frame_exr.h"
#include "compare/run/version.h"
#include "tests/support/files.h"
#include "tests/support/frames.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <functional>
#include <limits>

namespace diptych {
namespace {

using Lines = std::vector<std::string>;

const ReportDevice aCpu{"a CPU", "1.0", "cpu"};

// Values without a short decimal representation.
Frame drawnNow(Path path = Path::deferred) {
    Frame frame = flatFrame(path, 4, 3, 0.5f, 3);
    frame.scene = "builtin:one";
    frame.camera = {"main", {1.0 / 3, 2, 3}, {0, 0.1, 0}, {0, 1, 0}, 60.0 / 7, 0.5, 0.01, 100};
    return frame;
}

// Written as by `compare --update-baseline`, read as by `compare --baseline`.
Frame kept(const Frame& frame, const ReportDevice& device = aCpu) {
    const std::filesystem::path file = folder() / "b.exr";
    writeFrameExr(file, frame, device);
    return frameFromExr(file);
}

Lines saidOf(const Frame& then, const Frame& now, const ReportDevice& device = aCpu) {
    return baselineMismatches(kept(then), now, device);
}

TEST(BaselineMismatches, TheSameHasNone) {
    for (const Path path : {Path::deferred, Path::forward_plus, Path::reference}) {
        Frame then = drawnNow(path);
        EXPECT_EQ(saidOf(then, then), Lines{}) << nameOf(path);
        EXPECT_EQ(saidOf(then, drawnNow(Path::forward_plus)), Lines{}) << "both paths stand beside it";
        then.camera.far = std::numeric_limits<double>::infinity();
        EXPECT_EQ(saidOf(then, then), Lines{}) << "JSON has no infinity";
    }
}

// Every member, changed by one ULP of a double.
TEST(BaselineMismatches, EveryMemberOfTheCameraIsNamed) {
    struct Case {
        const char* named;
        std::function<void(FrameCamera&)> move;
    };
    const auto bit = [](double& value) { value = std::nextafter(value, 1e9); };
    const Case cases[] = {{"camera", [](FrameCamera& c) { c.name = "side"; }},
                          {"camera eye", [&](FrameCamera& c) { bit(c.eye[0]); }},
                          {"camera eye", [&](FrameCamera& c) { bit(c.eye[1]); }},
                          {"camera eye", [&](FrameCamera& c) { bit(c.eye[2]); }},
                          {"camera target", [&](FrameCamera& c) { bit(c.target[0]); }},
                          {"camera target", [&](FrameCamera& c) { bit(c.target[1]); }},
                          {"camera target", [&](FrameCamera& c) { bit(c.target[2]); }},
                          {"camera up", [&](FrameCamera& c) { bit(c.up[0]); }},
                          {"camera up", [&](FrameCamera& c) { bit(c.up[1]); }},
                          {"camera up", [&](FrameCamera& c) { bit(c.up[2]); }},
                          {"camera fov, degrees", [&](FrameCamera& c) { bit(c.fov_degrees); }},
                          {"camera ymag, m", [&](FrameCamera& c) { bit(c.ymag); }},
                          {"camera near, m", [&](FrameCamera& c) { bit(c.near); }},
                          {"camera far, m", [&](FrameCamera& c) { bit(c.far); }},
                          {"camera far, m", [](FrameCamera& c) { c.far = HUGE_VAL; }}};
    const Frame then = drawnNow(), baseline = kept(then);
    for (const Case& one : cases) {
        Frame now = then;
        one.move(now.camera);
        const Lines lines = baselineMismatches(baseline, now, aCpu);
        ASSERT_EQ(lines.size(), 1u) << one.named;
        EXPECT_TRUE(lines[0].starts_with(fmt::format("baseline: {} ", one.named))) << lines[0];
        EXPECT_NE(lines[0].find("(now "), std::string::npos) << lines[0];
    }
    // The other members are derived from these.
    static_assert(sizeof(FrameCamera) == 2 * sizeof(std::string) + 13 * sizeof(double),
                  "a new member wants a case");
}

TEST(BaselineMismatches, BothValuesAreSaid) {
    Frame now = drawnNow();
    now.camera.eye[2] = 4;
    now.camera.far = HUGE_VAL;
    EXPECT_EQ(saidOf(drawnNow(), now),
              (Lines{"baseline: camera eye (0.3333333333333333, 2, 3) (now (0.3333333333333333, 2, 4))",
                     "baseline: camera far, m 100 (now inf)"}));
}

TEST(BaselineMismatches, AFileWithoutACameraSaysSo) {
    Frame then = drawnNow();
    then.camera = {};
    EXPECT_EQ(saidOf(then, drawnNow()), Lines{"baseline: camera unknown (now known)"});
}

TEST(BaselineMismatches, SceneDeviceDriverAndCommitAreNamed) {
    Frame now = drawnNow();
    now.scene = "builtin:two";
    EXPECT_EQ(saidOf(drawnNow(), now), Lines{"baseline: scene builtin:one (now builtin:two)"});
    EXPECT_EQ(saidOf(drawnNow(), drawnNow(), {"a GPU", "1.0", "discrete"}),
              Lines{"baseline: device a CPU (now a GPU)"});
    EXPECT_EQ(saidOf(drawnNow(), drawnNow(), {"a CPU", "1.1", "cpu"}),
              Lines{"baseline: driver 1.0 (now 1.1)"});
    Frame then = kept(drawnNow());
    then.origin.commit = "0123abc";
    EXPECT_EQ(baselineMismatches(then, drawnNow(), aCpu),
              Lines{fmt::format("baseline: commit 0123abc (now {})", commitName())});
    then.origin = {};
    then.origin.file = "b.exr";
    EXPECT_EQ(baselineMismatches(then, drawnNow(), aCpu),
              (Lines{fmt::format("baseline: commit unknown (now {})", commitName()),
                     "baseline: device unknown (now a CPU)", "baseline: driver unknown (now 1.0)"}));
}

// Every Setting by name, with both values. The path is the frames' own, and a size must be the same.
TEST(BaselineMismatches, EverySettingIsNamed) {
    const Frame then = drawnNow(), baseline = kept(then);
    const auto defaults = nlohmann::json::parse(toJson(then.settings));
    std::size_t cases = 0;
    for (const Field& field : settingFields()) {
        if (field.option == "path" || field.option == "size") continue;
        Frame now = then;
        std::vector<std::string> values = sweptValues(then.settings, field.option);
        for (const char* value :
             {"1", "2", "3", "0.5", "on", "all", "fp32", "0..1", "depth", "scene", "point:2", "0.5,0.5,0.5",
              "b.exr", "component", "smoothstep", "squared", "slope", "blended"})
            values.emplace_back(value);
        for (const std::string& value : values) try {
                now.settings.set(field.option, value);
                if (now.settings != then.settings) break;
            } catch (const std::runtime_error&) {
            }
        std::string key(field.option);
        std::ranges::replace(key, '-', '_');
        const auto changed = nlohmann::json::parse(toJson(now.settings));
        ASSERT_NE(changed.at(key), defaults.at(key)) << key << ": no value here changes it";
        EXPECT_EQ(baselineMismatches(baseline, now, aCpu),
                  Lines{fmt::format("baseline: different Settings: {} {} (now {})", key,
                                    defaults.at(key).dump(), changed.at(key).dump())});
        ++cases;
    }
    EXPECT_EQ(cases + 2, defaults.size());
}

// Another renderer's file: nothing but that is known of it.
TEST(BaselineMismatches, OfAnotherProgramNothingIsKnown) {
    Frame other = drawnNow(Path::reference);
    other.origin = {"b.exr", "", "", ""};
    other.scene.clear();
    EXPECT_EQ(baselineMismatches(other, drawnNow(), aCpu),
              Lines{"baseline: not written by diptych: scene, camera and Settings are unknown"});
}

// A replaced baseline is kept beside the new one.
TEST(Baseline, AnUpdateKeepsTheOldFile) {
    const std::filesystem::path file = folder() / "b.exr", old = file.string() + ".old";
    Frame first = drawnNow(), second = first;
    second.channels.at(Channel::lit).data[0] = 2;
    EXPECT_EQ(updateBaseline(file, first, aCpu),
              fmt::format("baseline {} written from deferred", file.string()));
    EXPECT_FALSE(std::filesystem::exists(old));
    for (const Frame& frame : {second, first}) {
        const PixelData before = frameFromExr(file).channels.at(Channel::lit).data;
        EXPECT_EQ(updateBaseline(file, frame, aCpu),
                  fmt::format("baseline {} replaced from deferred; the old one is now {}", file.string(),
                              old.string()));
        EXPECT_EQ(frameFromExr(file).channels.at(Channel::lit).data, frame.channels.at(Channel::lit).data);
        EXPECT_EQ(frameFromExr(old).channels.at(Channel::lit).data, before);
    }
}

TEST(Baseline, AReferenceOfFewerSamplesIsNoTruthOfThem) {
    Settings reference, path;
    reference.path = Path::reference;
    EXPECT_EQ(samplesProblem(reference, path), "") << "one of each";
    path.msaa = 4;
    EXPECT_EQ(samplesProblem(reference, path),
              "--msaa 4: --reference-mode surface shades one surface per pixel; use --reference-mode scene "
              "--spp 64");
    reference.reference_mode = ReferenceMode::scene;
    reference.spp = 3;
    EXPECT_EQ(samplesProblem(reference, path),
              "--msaa 4: the reference takes only 3 samples per pixel; use --spp 64");
    reference.spp = 4;
    EXPECT_EQ(samplesProblem(reference, path), "");
    path.msaa = 8;
    EXPECT_NE(samplesProblem(reference, path), "");
}

}  // namespace
}  // namespace diptych
