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
    EXPECT_EQ(progressLine("a.gltf", 0.999, "x", 200), "a.gltf [=========================== ]  99 % x")
        << "as wide as it gets, and not yet at its end";
    EXPECT_EQ(progressLine("a", 0.5, "x", 20), "a [==  ]  50 % x") << "half of twelve columns";
    EXPECT_EQ(progressLine("a", 0.5, "x", 19), "a  50 % x") << "no room for a bar";
    EXPECT_EQ(progressLine("a", 0.5, "step", 7), "  50 % ") << "the end is cut off";
    for (const double outside : {-1.0, std::nan("")})
        EXPECT_EQ(progressLine("a", outside, "x", 20), "a [    ]   0 % x");
    EXPECT_EQ(progressLine("a", 7, "x", 20), "a [====] 100 % x");
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
    EXPECT_EQ(progressLine("a/long/way/to/Sponza.gltf", 0.5, "x", 40),
              ".../Sponza.gltf [=======       ]  50 % x");
    EXPECT_EQ(progressLine("a.gltf", 0.5, "x", 12), "...f  50 % x");
    EXPECT_EQ(progressLine("a.gltf", 0.5, "x", 11), "  50 % x") << "dots alone are no name";
}

TEST(Progress, TimeLeftIsThatOfThePaceSoFar) {
    EXPECT_EQ(timeLeft(10s, 0.5), "0:10 left");
    EXPECT_EQ(timeLeft(10s, 0.25), "0:30 left");
    EXPECT_EQ(timeLeft(100s, 0.4), "2:30 left");
    EXPECT_EQ(timeLeft(1h, 0.5), "1:00:00 left");
    EXPECT_EQ(timeLeft(10s, 1), "0:00 left");
    EXPECT_EQ(timeLeft(10s, 0.3), "0:24 left") << "23.3 s are not over after 23";
    EXPECT_EQ(timeLeft(2s, 0.02), "1:38 left");
    EXPECT_EQ(timeLeft(359999s, 0.5), "99:59:59 left");
    EXPECT_EQ(clockText(59.2), "1:00");
    EXPECT_EQ(clockText(3599), "59:59");
    EXPECT_EQ(clockText(3661), "1:01:01");
}

TEST(Progress, TimeLeftIsNotGuessedFromNothing) {
    EXPECT_EQ(timeLeft(1.99s, 0.5), "") << "too early";
    EXPECT_EQ(timeLeft(10s, 0.0199), "") << "too little";
    EXPECT_EQ(timeLeft(360000s, 0.5), "") << "a hundred hours";
    EXPECT_EQ(timeLeft(10s, 0), "");
    EXPECT_EQ(timeLeft(10s, std::nan("")), "");
    EXPECT_EQ(timeLeft(24h * 365, 0.02), "") << "beyond what is worth saying";
}

TEST(Progress, ATerminalSeesABarAfterASecondAndIsWipedAtTheEnd) {
    Screen screen;
    {
        Progress progress(screen.output(true));
        screen.now += 999ms;
        progress.at("a.gltf", 0.1, "read");
        EXPECT_TRUE(screen.lines.empty()) << "short work stays silent";
        screen.now += 1ms;
        progress.at("a.gltf", 0.1, "read");
        ASSERT_EQ(screen.lines.size(), 1u);
        EXPECT_EQ(screen.lines[0], "\r\x1b[K" + progressLine("a.gltf", 0.1, "read", 79))
            << "one column is free";
        screen.lines.clear();
        screen.now += 3s;
        progress.at("a.gltf", 0.5, "draw");
        ASSERT_EQ(screen.lines.size(), 1u);
        EXPECT_EQ(screen.lines[0], "\r\x1b[K" + progressLine("a.gltf", 0.5, "draw, 0:04 left", 79));
        screen.now += 49ms;
        progress.at("a.gltf", 0.6, "draw");
        EXPECT_EQ(screen.lines.size(), 1u) << "twenty times a second at most";
        wipeProgress();
        ASSERT_EQ(screen.lines.size(), 2u) << "before other output";
        EXPECT_EQ(screen.lines[1], "\r\x1b[K");
        wipeProgress();
        EXPECT_EQ(screen.lines.size(), 2u) << "nothing is shown";
        screen.now += 1ms;
        progress.at("a.gltf", std::nan(""), "draw");
        EXPECT_TRUE(holds(screen.lines.back(), " 60 % ")) << "never back: " << screen.lines.back();
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

TEST(Progress, AListenerIsToldOfEachStepWithinTheWhole) {
    std::vector<std::string> told;
    Progress progress([&](const std::string& what, double fraction, const std::string& step) {
        told.push_back(what + " " + step + " " + std::to_string(fraction).substr(0, 4));
    });
    for (const double fraction : {-1.0, 0.25, 7.0, 0.5}) progress.at("a", fraction, "b");
    EXPECT_EQ(told, (std::vector<std::string>{"a b 0.00", "a b 0.25", "a b 1.00", "a b 0.50"}));
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
    EXPECT_EQ(said(whole.part(0.2, 0.6), -9), "diptych: report: 20 % x\n");
    EXPECT_EQ(said(whole.part(0.2, 0.6), 0.5), "diptych: report: 40 % x\n");
    EXPECT_EQ(said(whole.part(0.2, 0.6).part(0.5, 1).about("a"), 0.5), "diptych: a: 50 % x\n");
    EXPECT_EQ(said(whole.part(0.2, 0.6), 7), "diptych: report: 60 % x\n");
    EXPECT_EQ(said(whole, 0.1), "diptych: report: 60 % x\n") << "never back";
}

}  // namespace
}  // namespace diptych
