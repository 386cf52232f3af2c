// SPDX-License-Identifier: MIT
// Compares two images in memory. The exit code is 0 if all limits hold.
#include <diptych/diptych.h>

#include <cmath>
#include <cstdio>
#include <exception>
#include <vector>

int main() {
    constexpr int width = 64, height = 36;
    std::vector<float> reference, test;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int c = 0; c < 3; ++c) {
                const float radiance = 0.5f + 0.5f * std::sin(0.1f * static_cast<float>(x + y * c));
                reference.push_back(radiance);
                test.push_back(x > 30 && x < 34 ? 1.5f * radiance : radiance);
            }
    try {
        diptych::library::Options options;
        options.limits = {{"flip", 0.02}, {"psnr", 30}};
        const diptych::library::Result result =
            diptych::library::compare({width, height, reference}, {width, height, test}, options);
        std::printf("diptych %s: worst at %d,%d\n", diptych::library::version().c_str(), result.worst_x,
                    result.worst_y);
        for (const diptych::library::Outcome& outcome : result.outcomes)
            std::printf("%s %.4g, limit %g: %s\n", outcome.limit.figure.c_str(), outcome.measured,
                        outcome.limit.value, outcome.holds ? "holds" : "does not hold");
        return result.passed ? 0 : 1;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 2;
    }
}
