// SPDX-License-Identifier: MIT
#include "compare/run/progress.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <string>
#include <vector>

namespace diptych {
namespace {

using namespace std::chrono_literals;

// A simulated screen and clock.
struct Screen {
    std::vector<std::string> lines;
    ProgressOutput::Time now{};

    ProgressOutput output(bool terminal) {
        return {terminal, [] { return std::size_t{80}; },
                [this](const std::string& text) { lines.push_back(text); }, [this] { return now; }};
    }
};

bool holds(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

TEST(Progress, LineShowsHowFar) {
    EXPECT_EQ(progressLine("a.gltf", 0.5, "images", 60), "a.gltf [==========           ]  50 % images");
    EXPECT_EQ(progressLine("a.gltf", 0, "x", 24), "a.gltf [      ]   0 % x");
    EXPECT_EQ(progressLine("a.gltf", 1, "x", 24), "a.gltf [======] 100 % x");
}

// A line that is too wide would wrap and could not be erased.
TEST(Progress, LineNeverExceedsItsColumns) {
    const std::string name(300, 'n');
    for (const std::string& what : {std::string(), std::string("a.gltf"), name})
        for (std::size_t columns = 0; columns < 120; ++columns)
            for (const double fraction : {-1.0, 0.0, 0.3, 1.0, 7.0, std::nan("")})
                EXPECT_LE(progressLine(what, fraction, "images and meshes", columns).size(), columns);
}

// "...and the end of the name", which is more informative than the beginning.
TEST(Progress, LongNamesKeepTheirEnd) {
    EXPECT_TRUE(progressLine("a/long/way/to/Sponza.gltf", 0.5, "x", 40).starts_with("..."))
        << progressLine("a/long/way/to/Sponza.gltf", 0.5, "x", 40);
}

TEST(Progress, TimeLeftIsThatOfThePaceSoFar) {
    EXPECT_EQ(timeLeft(10s, 0.5), "0:10 left");
    EXPECT_EQ(timeLeft(10s, 0.25), "0:30 left");
    EXPECT_EQ(timeLeft(100s, 0.4), "2:30 left");
    EXPECT_EQ(timeLeft(1h, 0.5), "1:00:00 left");
    EXPECT_EQ(timeLeft(10s, 1), "0:00 left");
}

TEST(Progress, TimeLeftIsNotGuessedFromNothing) {
    EXPECT_EQ(timeLeft(1s, 0.5), "") << "too early";
    EXPECT_EQ(timeLeft(10s, 0.01), "") << "too little";
    EXPECT_EQ(timeLeft(10s, 0), "");
    EXPECT_EQ(timeLeft(10s, std::nan("")), "");
    EXPECT_EQ(timeLeft(24h * 365, 0.02), "") << "beyond what is worth saying";
}

TEST(Progress, ATerminalSeesABarAfterASecondAndIsWipedAtTheEnd) {
    Screen screen;
    {
        Progress progress(screen.output(true));
        screen.now += 900ms;
        progress.at("a.gltf", 0.1, "read");
        EXPECT_TRUE(screen.lines.empty()) << "short work stays silent";
        screen.now += 3100ms;
        progress.at("a.gltf", 0.5, "draw");
        ASSERT_EQ(screen.lines.size(), 1u);
        EXPECT_TRUE(holds(screen.lines[0], "a.gltf [")) << screen.lines[0];
        EXPECT_TRUE(holds(screen.lines[0], " 50 % draw, 0:04 left")) << screen.lines[0];
        EXPECT_FALSE(holds(screen.lines[0], "\n"));
        progress.at("a.gltf", 0.6, "draw");
        EXPECT_EQ(screen.lines.size(), 1u) << "twenty times a second at most";
        wipeProgress();
        ASSERT_EQ(screen.lines.size(), 2u) << "before other output";
        EXPECT_EQ(screen.lines[1], "\r\x1b[K");
        wipeProgress();
        EXPECT_EQ(screen.lines.size(), 2u) << "nothing is shown";
        screen.now += 1s;
        progress.at("a.gltf", 0.7, "draw");
    }
    ASSERT_EQ(screen.lines.size(), 4u);
    EXPECT_EQ(screen.lines[3], "\r\x1b[K");
}

TEST(Progress, ALogGetsAPlainLineEveryTenSeconds) {
    Screen screen;
    {
        Progress progress(screen.output(false));
        for (int second = 0; second < 35; ++second, screen.now += 1s)
            progress.at("a.gltf", second / 40.0, "draw");
    }
    EXPECT_EQ(screen.lines, (std::vector<std::string>{"diptych: a.gltf: 25 % draw, 0:30 left\n",
                                                      "diptych: a.gltf: 50 % draw, 0:20 left\n",
                                                      "diptych: a.gltf: 75 % draw, 0:10 left\n"}));
}

TEST(Progress, QuietSaysNothing) {
    Progress progress(std::nullopt);
    progress.at("a.gltf", 0.5, "draw");
    progress.wipe();
    Stage().at(0.5, "nobody asks");
}

TEST(Progress, StagesFillTheirPartOfTheWhole) {
    Screen screen;
    Progress progress(screen.output(false));
    const Stage whole(progress, "report");
    const auto said = [&](const Stage& stage, double fraction) {
        screen.now += 1h * 1000;  // no remaining time is shown
        stage.at(fraction, "x");
        return screen.lines.back();
    };
    EXPECT_EQ(said(whole.part(0.2, 0.6), 0), "diptych: report: 20 % x\n");
    EXPECT_EQ(said(whole.part(0.2, 0.6), 0.5), "diptych: report: 40 % x\n");
    EXPECT_EQ(said(whole.part(0.2, 0.6).part(0.5, 1).about("a"), 0.5), "diptych: a: 50 % x\n");
    EXPECT_EQ(said(whole.part(0.2, 0.6), 7), "diptych: report: 60 % x\n");
    EXPECT_EQ(said(whole, 0.1), "diptych: report: 60 % x\n") << "never back";
}

}  // namespace
}  // namespace diptych
