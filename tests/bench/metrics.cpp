// SPDX-License-Identifier: MIT
// Time to compare two images in memory: bench_metrics [-n RUNS]
// Two images of 1920x1080, noise over a gradient, different everywhere. Interleaves RUNS runs of each
// kind. Wall-clock and processor time: medians and spread. `memory`: resident size that the first run
// added to the process, in images.
#include "compare/metrics/flip.h"
#include "compare/metrics/standard.h"

#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <functional>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

using namespace diptych;

namespace {

struct Pair {
    Image reference, test;
};

// `stops`: range of the image in powers of 2; 0: from 0 to 1.
Pair images(double stops) {
    Pair pair{Image(1920, 1080, 3), Image(1920, 1080, 3)};
    std::mt19937 random(1);
    std::uniform_real_distribution<float> noise(0.9f, 1.0f);
    for (int y = 0; y < 1080; ++y)
        for (int x = 0; x < 1920; ++x)
            for (int c = 0; c < 3; ++c) {
                const double position = (x + 0.1 * y * c) / (1920 + 216);
                const auto value =
                    static_cast<float>(stops > 0 ? std::exp2(stops * (position - 0.5)) : position);
                pair.reference.at(x, y, c) = value * noise(random);
                pair.test.at(x, y, c) = value * noise(random);
            }
    return pair;
}

struct Kind {
    std::string name;
    std::function<void()> run;
    std::vector<double> wall{}, processor{};
    double memory = 0;
};

rusage usage() {
    rusage u{};
    getrusage(RUSAGE_SELF, &u);
    return u;
}

double processorMs() {
    const auto ms = [](const timeval& t) {
        return 1e3 * static_cast<double>(t.tv_sec) + 1e-3 * static_cast<double>(t.tv_usec);
    };
    const rusage u = usage();
    return ms(u.ru_utime) + ms(u.ru_stime);
}

// In a process of its own, so that its peak is due to this kind; in images.
double addedImages(const Kind& kind) {
    int ends[2];
    if (pipe(ends) != 0) throw std::runtime_error("no pipe");
    const pid_t child = fork();
    if (child == 0) {
        const long before = usage().ru_maxrss;
        kind.run();
        const double added =
            static_cast<double>(usage().ru_maxrss - before) * 1024 / (1920.0 * 1080 * 3 * sizeof(float));
        _exit(write(ends[1], &added, sizeof added) == sizeof added ? 0 : 1);
    }
    double added = 0;
    if (child < 0 || read(ends[0], &added, sizeof added) != sizeof added)
        throw std::runtime_error("the child failed");
    waitpid(child, nullptr, 0);
    close(ends[0]);
    close(ends[1]);
    return added;
}

void measure(Kind& kind) {
    const double before = processorMs();
    const auto start = std::chrono::steady_clock::now();
    kind.run();
    kind.wall.push_back(
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
    kind.processor.push_back(processorMs() - before);
}

std::string spread(std::vector<double> values) {
    std::ranges::sort(values);
    return fmt::format("{:.0f} ({:.0f} to {:.0f})", values[values.size() / 2], values.front(), values.back());
}

}  // namespace

int main(int count, char** arguments) try {
    const std::vector<std::string> words(arguments + 1, arguments + count);
    if (!words.empty() && (words.size() != 2 || words[0] != "-n"))
        throw std::runtime_error("usage: bench_metrics [-n RUNS]");
    const std::size_t runs = words.empty() ? 5 : std::max(1ul, std::stoul(words[1]));

    const Pair display = images(0), linear = images(14);
    const Coverage all = everyPixel(display.reference.pixels());
    HdrFlipOptions fifteen;
    fifteen.exposures = 15;
    std::vector<Kind> kinds{
        {"FLIP, LDR", [&] { ldrFlip(display.reference, display.test); }},
        {"FLIP, HDR, 15 exposures", [&] { hdrFlip(linear.reference, linear.test, fifteen); }},
        {"FLIP, LDR, the same picture", [&] { ldrFlip(display.reference, display.reference); }},
        {"plain, LDR",
         [&] { standardMetrics(display.reference, display.test, ChannelKind::color, Range::display, all); }},
        {"plain, HDR",
         [&] { standardMetrics(linear.reference, linear.test, ChannelKind::color, Range::linear, all); }},
        {"plain, vectors",
         [&] { standardMetrics(display.reference, display.test, ChannelKind::vector, Range::linear, all); }},
    };
    for (Kind& kind : kinds) kind.memory = addedImages(kind);  // before this process has threads
    for (std::size_t run = 0; run < runs; ++run)
        for (Kind& kind : kinds) measure(kind);
    fmt::print("1920x1080, {} runs, ms: median (smallest to largest)\n", runs);
    for (const Kind& kind : kinds)
        fmt::print("{:28} wall {}   processor {}   memory {:.2f} pictures\n", kind.name, spread(kind.wall),
                   spread(kind.processor), kind.memory);
    return 0;
} catch (const std::exception& e) {
    std::fprintf(stderr, "bench_metrics: %s\n", e.what());
    return 2;
}
