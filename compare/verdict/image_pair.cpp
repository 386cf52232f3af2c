// SPDX-License-Identifier: MIT
#include "compare/verdict/image_pair.h"

#include "shared/image/file_bytes.h"

#include <fmt/format.h>
#include <tbb/parallel_invoke.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <stdexcept>

namespace diptych {
namespace {

// IEC 61966-2-1.
float linearFromSrgb(float v) {
    return v <= 0.04045f ? v / 12.92f : std::pow((v + 0.055f) / 1.055f, 2.4f);
}

void decode(ImageLayer& layer) {
    if (layer.image.empty())
        layer.image =
            StoredImage{{}, std::move(layer.coded), static_cast<int>(layer.channels.size())}.takeImage();
}

// Index of a layer's alpha, after its colours; empty without alpha or without colours.
std::optional<std::size_t> alphaOf(const ImageLayer& layer) {
    const auto found = std::ranges::find(layer.channels, "A");
    if (found == layer.channels.end() || layer.channels.size() == 1) return {};
    return static_cast<std::size_t>(found - layer.channels.begin());
}

bool hasAlpha(const ImageFile& file) {
    return std::ranges::any_of(file.layers,
                               [](const ImageLayer& layer) { return alphaOf(layer).has_value(); });
}

// Multiplies straight colours by their alpha.
void associate(ImageFile& file) {
    for (ImageLayer& layer : file.layers) {
        const std::optional<std::size_t> alpha = alphaOf(layer);
        if (!alpha) continue;
        decode(layer);
        for (std::size_t i = 0; i < layer.image.pixels(); ++i) {
            float* const pixel = layer.image.pixel(i);
            for (std::size_t c = 0; c < layer.channels.size(); ++c)
                if (c != *alpha) pixel[c] *= pixel[*alpha];
        }
    }
    file.straight_alpha = false;
}

void makeLinear(ImageFile& file) {
    for (ImageLayer& layer : file.layers) {
        decode(layer);
        for (std::size_t i = 0; i < layer.image.data.size(); ++i) {
            const std::string& channel = layer.channels[i % static_cast<std::size_t>(layer.image.components)];
            if (!channel.ends_with('A')) layer.image.data[i] = linearFromSrgb(layer.image.data[i]);
        }
    }
    file.display_referred = false;
}

// Peak memory of comparing, bytes per pixel, without the encoded files.
double bytesPerPixel(const ImageSize (&sizes)[2], EightBits eight, const ImageDiffOptions& options) {
    const bool kept = eight == EightBits::kept;
    constexpr double color = 3 * sizeof(float), coverage = 1, error = sizeof(float);
    double images = 0, largest = 0;
    for (const ImageSize& size : sizes) {
        const auto decoded = static_cast<double>(size.bytes_per_pixel);
        images += kept ? decoded : std::max(decoded, color);  // grey becomes a colour
        largest = std::max(largest, decoded);
    }
    // Splitting a layer into channels copies it. FLIP's errors are kept for each colour.
    constexpr double alpha = sizeof(float);  // for an image without alpha
    const double split = alpha + (kept ? largest : std::max(largest, color));
    const double flip = error * (kept ? 1 : std::ceil(largest / color));
    const double holes = options.selection.any() ? 2 * color : 0;
    const double filters = (options.blur > 0 ? 4 * color : 0) + (options.shift > 0 ? color : 0);
    return images + std::max({split, coverage + flip + holes + options.output_bytes, coverage + filters});
}

// `same_bytes`: the files are equal, read or not.
void bringTogether(ImagePair& pair, const std::string& reference, const std::string& test, bool same_bytes,
                   bool strict) {
    ImageFile &a = pair.reference, &b = pair.test;
    if (a.width != b.width || a.height != b.height)
        throw std::runtime_error(fmt::format("{} is {}x{} and {} is {}x{}: images must have the same size",
                                             reference, a.width, a.height, test, b.width, b.height));
    if (a.display_referred != b.display_referred) {
        pair.notes.push_back(fmt::format("{} is {}; it was decoded from sRGB to linear to match the other",
                                         a.display_referred ? reference : test,
                                         a.display_referred ? a.format : b.format));
        makeLinear(a.display_referred ? a : b);
    }
    if (a.straight_alpha != b.straight_alpha && hasAlpha(a) && hasAlpha(b)) {
        pair.notes.push_back(fmt::format("{}: colours were multiplied by alpha to match the other",
                                         a.straight_alpha ? reference : test));
        associate(a.straight_alpha ? a : b);
    }
    for (const ImageFile* file : {&a, &b}) {
        const std::string& name = file == &a ? reference : test;
        const auto& others = (file == &a ? b : a).notes.not_applied;
        const auto say = [&](const std::string& line, bool fails) {
            (fails ? pair.failures : pair.notes).push_back(fmt::format("{}: {}", name, line));
        };
        for (const std::string& line : file->notes.lines) say(line, false);
        // A line that both files have makes no difference between them.
        for (const std::string& line : file->notes.not_applied)
            say(line, strict && std::ranges::count(others, line) == 0);
        if (file == &a || reference != test)
            for (const std::string& line : file->notes.in_part) say(line, strict && !same_bytes);
    }
}

}  // namespace

ImagePair readPair(const std::string& reference, const std::string& test, const ImageDiffOptions& options) {
    const std::string* const names[2] = {&reference, &test};
    std::vector<unsigned char> files[2];
    std::string parts[2];
    std::span<const std::byte> bytes[2];
    ImageSize kept[2], decoded[2];
    for (const int i : {0, 1}) {
        const ImageName name = imageName(*names[i]);
        parts[i] = name.part;
        files[i] = bytesOf(name.file);
        bytes[i] = std::as_bytes(std::span<const unsigned char>(files[i]));
        kept[i] = imageSize(bytes[i], *names[i], parts[i], EightBits::kept);
        decoded[i] = imageSize(bytes[i], *names[i], parts[i], EightBits::decoded);
    }
    const bool same_bytes = files[0] == files[1];
    const auto isEight = [&](int i) { return kept[i].bytes_per_pixel < decoded[i].bytes_per_pixel; };
    const EightBits eight =
        isEight(0) && isEight(1) && options.names.empty() && options.blur == 0 && options.shift == 0
            ? EightBits::kept
            : EightBits::decoded;
    const auto& sizes = eight == EightBits::kept ? kept : decoded;
    const ImageSize& larger = std::max(sizes[0], sizes[1], [](const ImageSize& a, const ImageSize& b) {
        return a.width * a.height < b.width * b.height;
    });
    const auto pixels = static_cast<double>(larger.width * larger.height);
    // SSIM has 252 rows of floats per thread, everything else some 20.
    const double rows = 1100.0 * static_cast<double>(larger.width) * tbb::this_task_arena::max_concurrency();
    const double needed = pixels * bytesPerPixel(sizes, eight, options);
    const std::string what =
        fmt::format("diff of {} and {}, {}x{}", reference, test, larger.width, larger.height);
    checkMemory(what, static_cast<std::uint64_t>(needed + rows), "compare smaller images, or parts of them");
    double beside = needed;  // readImage() claims the images themselves
    for (const ImageSize& size : sizes)
        beside -= static_cast<double>(size.width * size.height * size.bytes_per_pixel);
    Claim compared = claimMemory(static_cast<std::uint64_t>(std::max(beside, 0.0)),
                                 files[0].size() + files[1].size(), what);
    // If neither file can be read, the error names the reference, whichever thread was faster.
    ImageFile images[2];
    std::exception_ptr failures[2];
    const auto read = [&](int i) {
        try {
            images[i] = readImage(bytes[i], *names[i], parts[i], limits::imageBytes(), eight);
        } catch (...) {
            failures[i] = std::current_exception();
        }
        files[i] = {};
    };
    tbb::parallel_invoke([&] { read(0); }, [&] { read(1); });
    for (const std::exception_ptr& failure : failures)
        if (failure) std::rethrow_exception(failure);
    // A part that was chosen is read whole.
    for (const int i : {0, 1})
        if (!parts[i].empty()) images[i].notes.in_part.clear();
    ImagePair pair{std::move(images[0]), std::move(images[1]), std::move(compared), {}, {}};
    bringTogether(pair, reference, test, same_bytes, options.strict);
    return pair;
}

}  // namespace diptych
