// SPDX-License-Identifier: MIT
// Each number of a Frame has its own key in report.json.
#include "compare/files/frame_json.h"

#include <gtest/gtest.h>

namespace diptych {
namespace {

// Our own images have a path and Settings, an external renderer's the Settings that it was asked for, another
// program's file neither.
TEST(FrameJson, WhoMadeAFrameDecidesWhatIsKnown) {
    const auto known = [](const FrameOrigin& origin) {
        Frame frame;
        frame.settings.path = Path::deferred;
        frame.origin = origin;
        const nlohmann::ordered_json json = jsonOf(frame);
        return std::pair(!json["path"].is_null(), !json["settings"].is_null());
    };
    FrameOrigin file, ours, external;
    file.file = ours.file = external.file = "a.exr";
    ours.device = "a CPU";
    external.external = true;
    EXPECT_EQ(known({}), std::pair(true, true));
    EXPECT_EQ(known(ours), std::pair(true, true));
    EXPECT_EQ(known(external), std::pair(false, true));
    EXPECT_EQ(known(file), std::pair(false, false));
}

TEST(FrameJson, EveryNumberStandsUnderItsKey) {
    Frame frame;
    frame.time.median = 2;
    frame.time.min = 1;
    frame.time.max = 3;
    frame.time.runs = 4;
    frame.time.record = 5;
    frame.time.object_lists = 6;
    frame.made_in_ms = 7;
    frame.relative_uncertainty = 8;
    frame.bytes.images = 9;
    frame.bytes.buffers = 10;
    frame.bytes.gbuffer_per_pixel = 11;
    frame.counters.nonfinite_pixels = 12;
    frame.counters.overflowed_lists = 13;
    frame.counters.lights = 14;
    frame.counters.unreproduced_pixels = 15;
    frame.counters.energy_cut = 16;
    frame.settings.size = {17, 18};
    EXPECT_TRUE(jsonOf(frame)["hidden_light"].is_null());
    frame.hidden_light = {19, 20, 21};
    const auto json = jsonOf(frame);
    EXPECT_EQ(json["ms"]["median"], 2);
    EXPECT_EQ(json["ms"]["min"], 1);
    EXPECT_EQ(json["ms"]["max"], 3);
    EXPECT_EQ(json["ms"]["runs"], 4);
    EXPECT_EQ(json["host_ms"]["record"], 5);
    EXPECT_EQ(json["host_ms"]["object_lists"], 6);
    EXPECT_EQ(json["made_in_ms"], 7);
    EXPECT_EQ(json["uncertainty"], 8);
    EXPECT_EQ(json["bytes"]["images"], 9);
    EXPECT_EQ(json["bytes"]["buffers"], 10);
    EXPECT_EQ(json["bytes"]["gbuffer_per_pixel"], 11);
    EXPECT_EQ(json["counters"]["nonfinite_pixels"], 12);
    EXPECT_EQ(json["counters"]["overflowed_lists"], 13);
    EXPECT_EQ(json["counters"]["lights"], 14);
    EXPECT_EQ(json["counters"]["unreproduced_pixels"], 15);
    EXPECT_EQ(json["counters"]["energy_cut"], 16);
    EXPECT_EQ(json["hidden_light"]["mean"], 19);
    EXPECT_EQ(json["hidden_light"]["p99"], 20);
    EXPECT_EQ(json["hidden_light"]["pixels_above_a_tenth"], 21);
    EXPECT_EQ(json["size"], (nlohmann::ordered_json{17, 18}));
}

}  // namespace
}  // namespace diptych
