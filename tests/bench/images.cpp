// SPDX-License-Identifier: MIT
// Time to read an image: bench_images [-n RUNS] [FILE...]
// Without files: writes 1920 x 1080 RGB(A) of a smooth scene with noise, one in each readable format.
// Interleaves RUNS reads of every file, with a warm file cache; medians and spread.
#include "shared/image/exr.h"
#include "shared/image/image_file.h"
#include "shared/image/pfm.h"
#include "shared/image/radiance.h"

#include <fmt/format.h>
#include <png.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

using namespace diptych;

namespace {

namespace fs = std::filesystem;

// Gradients with noise of 1 %, like a path tracer's: the low bits of a float are not compressible.
Image scene(int components) {
    Image image(1920, 1080, components);
    std::minstd_rand random(1);
    std::uniform_real_distribution<float> noise(0.99f, 1.01f);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            for (int c = 0; c < components; ++c)
                image.at(x, y, c) =
                    c == 3 ? 1.0f
                           : noise(random) *
                                 (0.5f + 0.4f * std::sin(0.01f * static_cast<float>(x + (c + 1) * y)));
    return image;
}

void writePng16(const fs::path& file, const Image& image) {
    std::vector<std::uint16_t> values;
    for (const float value : image.data)
        values.push_back(static_cast<std::uint16_t>(65535 * std::min(value, 1.0f)));
    png_image png{};
    png.version = PNG_IMAGE_VERSION;
    png.width = static_cast<png_uint_32>(image.width);
    png.height = static_cast<png_uint_32>(image.height);
    png.format = PNG_FORMAT_LINEAR_RGB;
    if (!png_image_write_to_file(&png, file.c_str(), 0, values.data(), 0, nullptr))
        throw std::runtime_error(png.message);
}

std::vector<std::string> writeScenes(const fs::path& folder) {
    fs::create_directories(folder);
    const Image rgba = scene(4), rgb = scene(3);
    writeExr(folder / "rgba-zip.exr", {{{"R", "G", "B", "A"}, &rgba}});
    writePng16(folder / "rgb-16.png", rgb);
    writeHdr(folder / "rgb.hdr", rgb);
    writePfm(folder / "rgb.pfm", rgb);
    std::vector<std::string> files;
    for (const char* name : {"rgba-zip.exr", "rgb-16.png", "rgb.hdr", "rgb.pfm"})
        files.push_back(folder / name);
    return files;
}

double readMs(const std::string& file) {
    const auto start = std::chrono::steady_clock::now();
    const ImageFile image = readImage(file);
    const auto end = std::chrono::steady_clock::now();
    if (image.layers.empty()) throw std::runtime_error(file + ": no layers");
    return std::chrono::duration<double, std::milli>(end - start).count();
}

}  // namespace

int main(int count, char** arguments) try {
    std::vector<std::string> files(arguments + 1, arguments + count);
    std::size_t runs = 9;
    if (files.size() > 1 && files[0] == "-n") {
        runs = std::max(1ul, std::stoul(files[1]));
        files.erase(files.begin(), files.begin() + 2);
    }
    if (files.empty()) files = writeScenes(fs::temp_directory_path() / "diptych-bench-images");
    std::vector<std::vector<double>> times(files.size());
    for (const std::string& file : files) readMs(file);  // warms the file cache and starts threads
    for (std::size_t run = 0; run < runs; ++run)
        for (std::size_t i = 0; i < files.size(); ++i) times[i].push_back(readMs(files[i]));
    fmt::print("{} runs, ms: median (smallest to largest)\n", runs);
    for (std::size_t i = 0; i < files.size(); ++i) {
        std::ranges::sort(times[i]);
        fmt::print("{:8.1f} ({:.1f} to {:.1f})  {}, {:.1f} MiB\n", times[i][runs / 2], times[i].front(),
                   times[i].back(), files[i], static_cast<double>(fs::file_size(files[i])) / (1 << 20));
    }
    return 0;
} catch (const std::exception& e) {
    std::fprintf(stderr, "bench_images: %s\n", e.what());
    return 2;
}
