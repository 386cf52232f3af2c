// SPDX-License-Identifier: MIT
#include "compare/report/exposure_line.h"

#include "compare/files/frame_exr.h"
#include "shared/contract/debug_mode.h"
#include "shared/image/image_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <vector>

namespace diptych {

std::string exposureLine(const Frame& frame, const ImageChoice& choice) {
    return exposureFor(choice, findChannel(frame, Channel::lit), coverage(frame, frame)).because;
}

std::string exposureLine(const Report& report, const ImageChoice& choice) {
    std::vector<Exposure> all;
    for (const Comparison& comparison : report.comparisons)
        all.push_back(exposureOf(report, comparison, choice));
    return exposureLine(all);
}

Exposure exposureOf(const Report& report, const Comparison& comparison, const ImageChoice& choice) {
    return exposureFor(choice, findChannel(report.baseline(comparison), Channel::lit), comparison.coverage);
}

std::string exposureLine(const std::vector<Exposure>& all) {
    if (all.empty()) return {};
    const auto [min, max] = std::ranges::minmax(all, {}, &Exposure::factor);
    if (min.factor == max.factor) return all.front().because;
    return fmt::format(
        "exposures from {:.4g} to {:.4g}, automatic; --exposure or --match-exposure FILE sets one for all "
        "pictures",
        min.factor, max.factor);
}

double exposureOfFile(const std::filesystem::path& file) {
    const ImageFile stored = readImage(file.string());
    if (stored.display_referred)
        throw std::runtime_error(
            fmt::format("--match-exposure {}: {} holds display colours; give the EXR that it was made from",
                        file.string(), stored.format));
    try {
        const Frame frame = frameFromExr(file);
        if (const Image* const lit = findChannel(frame, Channel::lit))
            return exposureFor({}, lit, coverage(frame, frame)).factor;
    } catch (const std::runtime_error&) {
        // Not one of our files: its first colours are radiance.
    }
    const auto colors =
        std::ranges::find_if(stored.layers, [](const ImageLayer& l) { return l.image.components >= 3; });
    if (colors == stored.layers.end())
        throw std::runtime_error(fmt::format("--match-exposure {}: holds no colours", file.string()));
    Image image(stored.width, stored.height, 3);
    for (std::size_t i = 0; i < image.pixels(); ++i) std::copy_n(colors->image.pixel(i), 3, image.pixel(i));
    return exposureFor({}, &image, everyPixel(image.pixels())).factor;
}

}  // namespace diptych
