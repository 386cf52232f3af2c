// SPDX-License-Identifier: MIT
// A virtual screen (Xvfb), its contents, and real key and mouse events (xdotool). `./diptych test`
// installs both (packages.txt). A plain CMake build may lack them: the tests that need them are then
// skipped with a message.
#pragma once

#include "tests/tool/running.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace diptych {

// Copy of the screen's contents, RGB.
struct Screen {
    int width = 0, height = 0;
    std::vector<std::array<std::uint8_t, 3>> pixels;
    const std::array<std::uint8_t, 3>& at(int x, int y) const {
        return pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                      static_cast<std::size_t>(x)];
    }
};

class Display {
public:
    static bool isThere() {
        return std::system("command -v Xvfb >/dev/null 2>&1 && command -v xdotool >/dev/null 2>&1") == 0;
    }

    // `folder`: for the screen's memory file. Programs started from now on use this display.
    explicit Display(const Folder& folder, const std::string& size = "1280x760") : folder_(folder) {
        fs::create_directories(folder_ / "screen");
        const fs::path told = folder_ / "display";
        const std::string command = "exec Xvfb -displayfd 3 -screen 0 " + size + "x24 -fbdir '" +
                                    (folder_ / "screen").string() + "' -nolisten tcp 3>'" + told.string() +
                                    "' >'" + (folder_ / "xvfb.log").string() + "' 2>&1";
        std::array<char*, 4> words{const_cast<char*>("sh"), const_cast<char*>("-c"),
                                   const_cast<char*>(command.c_str()), nullptr};
        EXPECT_EQ(::posix_spawnp(&process_, "sh", nullptr, nullptr, words.data(), environ), 0);
        EXPECT_TRUE(soon([&] { return contentsOf(told).ends_with('\n'); }))
            << contentsOf(folder_ / "xvfb.log");
        name_ = ":" + contentsOf(told);
        name_.pop_back();
        ::setenv("DISPLAY", name_.c_str(), 1);
    }
    ~Display() {
        ::unsetenv("DISPLAY");
        if (process_ <= 0) return;
        ::kill(process_, SIGTERM);
        ::waitpid(process_, nullptr, 0);
    }
    Display(const Display&) = delete;
    Display& operator=(const Display&) = delete;

    // xdotool with these arguments: "key e".
    void events(const std::string& words) const {
        EXPECT_EQ(std::system(("xdotool " + words + " >/dev/null 2>&1").c_str()), 0) << words;
    }

    // Parses the X window dump (X11/XWDFile.h) in which Xvfb stores its screen: big-endian 32-bit
    // integers.
    Screen screen() const {
        const std::string dump = contentsOf(folder_ / "screen/Xvfb_screen0");
        const auto number = [&](std::size_t i) {
            std::uint32_t value = 0;
            for (std::size_t b = 0; b < 4; ++b)
                value = value << 8 | static_cast<std::uint8_t>(dump.at(4 * i + b));
            return value;
        };
        const std::size_t head = number(0), line = number(12), colors = number(19);
        Screen screen{static_cast<int>(number(4)), static_cast<int>(number(5)), {}};
        const std::size_t first = head + 12 * colors;
        for (int y = 0; y < screen.height; ++y)
            for (int x = 0; x < screen.width; ++x) {
                const std::size_t at =
                    first + static_cast<std::size_t>(y) * line + 4 * static_cast<std::size_t>(x);
                screen.pixels.push_back({static_cast<std::uint8_t>(dump.at(at + 2)),
                                         static_cast<std::uint8_t>(dump.at(at + 1)),
                                         static_cast<std::uint8_t>(dump.at(at))});
            }
        return screen;
    }

private:
    const Folder& folder_;
    pid_t process_ = 0;
    std::string name_;
};

}  // namespace diptych
