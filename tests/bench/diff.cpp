// SPDX-License-Identifier: MIT
// diff compared with other programs: bench_diff [-n RUNS]
// Two float32 EXRs of 1920x1080, RGB, ZIP, a smooth scene with noise. Interleaves RUNS runs of each
// program, with a warm file cache. Wall-clock and processor time: medians and spread. Memory: the largest
// resident size of all runs, in float32 images. Reports programs that are not installed, and skips them.
#include "shared/image/exr.h"
#include "shared/image/png.h"

#include <fmt/format.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

using namespace diptych;

namespace {

namespace fs = std::filesystem;

Image scene(unsigned seed) {
    Image image(1920, 1080, 3);
    std::minstd_rand random(seed);
    std::uniform_real_distribution<float> noise(0.99f, 1.01f);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            for (int c = 0; c < 3; ++c)
                image.at(x, y, c) =
                    noise(random) * (0.5f + 0.4f * std::sin(0.01f * static_cast<float>(x + (c + 1) * y)));
    return image;
}

void writeInputs(const fs::path& folder) {
    fs::create_directories(folder);
    for (const unsigned seed : {1u, 2u}) {
        const Image image = scene(seed);
        Image8 png{image.width, image.height, 3, {}};
        for (const float v : image.data)
            png.data.push_back(static_cast<std::uint8_t>(std::lround(255 * std::clamp(v, 0.0f, 1.0f))));
        writeExr(folder / fmt::format("{}.exr", seed), {{{"R", "G", "B"}, &image}});
        writePng(folder / fmt::format("{}.png", seed), png);
    }
}

struct Program {
    std::string name, command;
    std::vector<double> wall{}, processor{};
    double memory = 0;  // in images

    void run() {
        const auto start = std::chrono::steady_clock::now();
        const pid_t child = fork();
        if (child == 0) {
            execl("/bin/sh", "sh", "-c", ("exec " + command + " >/dev/null 2>&1").c_str(), nullptr);
            _exit(127);
        }
        int status = 0;
        rusage usage{};
        wait4(child, &status, 0, &usage);
        if (!WIFEXITED(status) || WEXITSTATUS(status) > 2)
            throw std::runtime_error(name + ": did not run: " + command);
        const auto ms = [](const timeval& t) {
            return 1e3 * static_cast<double>(t.tv_sec) + 1e-3 * static_cast<double>(t.tv_usec);
        };
        wall.push_back(
            std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
        processor.push_back(ms(usage.ru_utime) + ms(usage.ru_stime));
        memory = std::max(memory, static_cast<double>(usage.ru_maxrss) * 1024 / (1920.0 * 1080 * 3 * 4));
    }
};

std::string spread(std::vector<double> values) {
    std::ranges::sort(values);
    return fmt::format("{:7.0f} ({:.0f} to {:.0f})", values[values.size() / 2], values.front(),
                       values.back());
}

bool installed(const std::string& program) {
    return std::system(("command -v " + program + " >/dev/null 2>&1").c_str()) == 0;
}

}  // namespace

int main(int argc, char** argv) {
    const int runs = argc == 3 && std::string(argv[1]) == "-n" ? std::max(1, std::atoi(argv[2])) : 7;
    try {
        const fs::path folder = fs::temp_directory_path() / fmt::format("diptych_bench_diff_{}", getpid());
        writeInputs(folder);
        const std::string exr = fmt::format(" '{0}/1.exr' '{0}/2.exr'", folder.string()),
                          png = fmt::format(" '{0}/1.png' '{0}/2.png'", folder.string()),
                          self = "'" DIPTYCH_PROGRAM "'";
        std::vector<Program> programs{{"diff, plain figures, EXR", self + " diff --metric rmse" + exr},
                                      {"diff, FLIP and plain, EXR", self + " diff" + exr},
                                      {"diff, FLIP and plain, PNG", self + " diff" + png}};
        if (installed("idiff"))
            programs.push_back({"OpenImageIO idiff, EXR", "idiff" + exr});
        else
            fmt::print("idiff is not installed (openimageio-tools): left out\n");
        if (installed("flip")) {
            programs.push_back({"FLIP's authors, EXR", "flip -nerd -r" + exr.substr(0, exr.find("' '") + 1) +
                                                           " -t" + exr.substr(exr.find("' '") + 1)});
        } else {
            fmt::print("the FLIP authors' program is not installed: left out\n");
        }
        for (int i = 0; i <= runs; ++i)
            for (Program& program : programs) {
                program.run();
                if (i == 0) program.wall.clear(), program.processor.clear();  // warm-up
            }
        fmt::print("{:28} {:>24} {:>24} {:>9}\n", "", "wall ms", "processor ms", "pictures");
        for (const Program& program : programs)
            fmt::print("{:28} {:>24} {:>24} {:9.2f}\n", program.name, spread(program.wall),
                       spread(program.processor), program.memory);
        fs::remove_all(folder);
    } catch (const std::exception& error) {
        fmt::print(stderr, "bench_diff: {}\n", error.what());
        return 2;
    }
}
