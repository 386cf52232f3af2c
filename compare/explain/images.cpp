// SPDX-License-Identifier: MIT
#include "compare/explain/images.h"

#include "shared/contract/debug_mode.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <span>
#include <stdexcept>

namespace diptych {

namespace {

constexpr Color8 palette[] = {{0x56, 0xb4, 0xe9}, {0xe6, 0x9f, 0x00}, {0x00, 0x9e, 0x73}, {0xcc, 0x79, 0xa7},
                              {0xf0, 0xe4, 0x42}, {0x00, 0x72, 0xb2}, {0xd5, 0x5e, 0x00}};
static_assert(std::size(palette) == ownColors);
constexpr Color8 otherColor{0xd8, 0xd8, 0xd8};
constexpr Color8 negativeColor{0x46, 0x96, 0xff};  // far from errorColor() for protan readers too
constexpr double darkened = 0.3;                   // brightness of the image behind the map of causes

std::uint8_t byteOf(double value) {
    return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0, 255.0)));
}

void put(Image8& image, std::size_t pixel, const Color8& color) {
    std::ranges::copy(color, image.data.begin() + static_cast<std::ptrdiff_t>(3 * pixel));
}

// The difference at each pixel.
Image sumOfMaps(const Explanation& explanation) {
    Image sum = explanation.unexplained_map;
    for (const Cause& cause : explanation.causes)
        for (std::size_t i = 0; i < sum.data.size(); ++i) sum.data[i] += cause.map.data[i];
    return sum;
}

}  // namespace

Color8 causeColor(std::size_t index) {
    return index < ownColors ? palette[index] : otherColor;
}

std::string contributionFile(const Explanation& explanation, std::size_t cause) {
    std::string name = explanation.causes.at(cause).name;
    name.erase(0, name.find_first_not_of('-'));
    for (char& c : name)
        if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '_') c = '-';
    return fmt::format("share-{}.{}.png", cause + 1, name);
}

Image8 dominantImage(const Explanation& explanation, const Image8& shown) {
    const Image& dominant_causes = explanation.dominant;
    if (shown.width != dominant_causes.width || shown.height != dominant_causes.height)
        throw std::logic_error("the picture behind a map of causes has another size");
    Image8 image{dominant_causes.width, dominant_causes.height, 3,
                 std::vector<std::uint8_t>(3 * dominant_causes.pixels())};
    const auto components = static_cast<std::size_t>(shown.components);
    for (std::size_t p = 0; p < dominant_causes.pixels(); ++p) {
        const float index = dominant_causes.pixel(p)[0];
        if (index >= 0) {
            put(image, p, causeColor(static_cast<std::size_t>(index)));
            continue;
        }
        // Rec. 709 weights on encoded values; the image only has to be recognisable.
        const std::uint8_t* const c = shown.data.data() + components * p;
        const std::uint8_t grey = byteOf(darkened * (0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2]));
        put(image, p, {grey, grey, grey});
    }
    return image;
}

double topOfMaps(const Explanation& explanation) {
    const Image difference = sumOfMaps(explanation);
    std::vector<float> errors(difference.data.begin(), difference.data.end());
    std::erase_if(errors, [](float error) { return !(error > 0); });
    if (errors.empty()) return 0;
    const auto at = errors.begin() + static_cast<std::ptrdiff_t>(errors.size() - 1 - errors.size() / 1000);
    std::ranges::nth_element(errors, at);
    return double{*at};
}

Image8 contributionImage(const Image& contributions, double top) {
    Image positive = contributions;
    for (float& contribution : positive.data) contribution = std::max(contribution, 0.0f);
    Image8 image = errorMap(positive, top);
    for (std::size_t p = 0; p < contributions.pixels(); ++p) {
        const double contribution = double{contributions.pixel(p)[0]};
        if (!(contribution < 0) || !(top > 0)) continue;
        const double t = std::sqrt(std::min(1.0, -contribution / top));
        put(image, p,
            {byteOf(t * negativeColor[0]), byteOf(t * negativeColor[1]), byteOf(t * negativeColor[2])});
    }
    return image;
}

Image8 litImage(const Frame& frame, const Frame& baseline, const ImageChoice& choice) {
    const DebugMode& lit = debugMode(Channel::lit);
    const Exposure exposure =
        exposureFor(choice, &baseline.channels.at(lit.channel), coverage(baseline, baseline));
    const Frame* const shown = &frame;
    return channelImage(lit, frame, scaleFor(lit, exposure, std::span(&shown, 1)));
}

std::vector<NamedImage> explanationMaps(const Explanation& explanation) {
    const double top = topOfMaps(explanation);
    std::vector<NamedImage> maps{{differenceFile, contributionImage(sumOfMaps(explanation), top)}};
    for (std::size_t i = 0; i < explanation.causes.size(); ++i)
        maps.push_back({contributionFile(explanation, i), contributionImage(explanation.causes[i].map, top)});
    maps.push_back({unexplainedFile, contributionImage(explanation.unexplained_map, top)});
    return maps;
}

}  // namespace diptych
