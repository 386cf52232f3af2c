// SPDX-License-Identifier: MIT
#include "shared/scene/image/radiance_layer.h"

#include "shared/text/counted.h"
#include "shared/text/fail.h"
#include "shared/text/one_line.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string_view>

namespace diptych {

namespace {

using Channels = std::array<std::size_t, 3>;

// Indices of the channels R, G and B ("R" or "LAYER.R") of a layer, if it has all three.
std::optional<Channels> colourOf(const ImageLayer& layer) {
    Channels channels{};
    for (std::size_t c = 0; c < channels.size(); ++c) {
        const auto at = std::ranges::find_if(layer.channels, [&](const std::string& channel) {
            return channel.substr(channel.rfind('.') + 1) == std::string(1, "RGB"[c]);
        });
        if (at == layer.channels.end()) return std::nullopt;
        channels[c] = static_cast<std::size_t>(at - layer.channels.begin());
    }
    return channels;
}

const ImageLayer* layerOf(const ImageFile& image) {
    const ImageLayer* found = nullptr;
    for (const ImageLayer& layer : image.layers)
        if (colourOf(layer) && (!found || layer.name.empty())) {
            found = &layer;
            if (layer.name.empty()) break;
        }
    return found;
}

// Counts of pixels in which a component was replaced by 0.
struct Repaired {
    std::size_t negative = 0, not_finite = 0;
};
Image repairedFrom(const ImageLayer& layer, Repaired& repaired) {
    const Channels channels = *colourOf(layer);
    Image radiance(layer.image.width, layer.image.height, 3);
    for (std::size_t i = 0; i < radiance.pixels(); ++i)
        for (std::size_t c = 0; c < channels.size(); ++c)
            radiance.pixel(i)[c] = layer.image.pixel(i)[channels[c]];
    if (layer.to_rec709) convertColors(radiance, *layer.to_rec709);
    for (std::size_t i = 0; i < radiance.pixels(); ++i) {
        bool negative = false, notFinite = false;
        for (std::size_t c = 0; c < channels.size(); ++c) {
            const float value = radiance.pixel(i)[c];
            notFinite |= !std::isfinite(value);
            negative |= std::isfinite(value) && value < 0;
            radiance.pixel(i)[c] = std::isfinite(value) && value > 0 ? value : 0;
        }
        repaired.negative += negative;
        repaired.not_finite += notFinite;
    }
    return radiance;
}

void note(std::vector<std::string>& notes, std::size_t pixels, const std::string& where, const char* what) {
    if (pixels > 0)
        notes.push_back(fmt::format("{}: {} {} {}; 0 is used", where, counted(pixels, "pixel"),
                                    pixels == 1 ? "has a component that is" : "have components that are",
                                    what));
}

}  // namespace

bool isRadianceImage(std::span<const std::byte> bytes) {
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    constexpr std::array<std::string_view, 4> beginnings{"\x76\x2f\x31\x01", "#?", "PF", "Pf"};
    return std::ranges::any_of(beginnings, [&](std::string_view b) { return text.starts_with(b); });
}

Image radianceOf(const ImageFile& image, const std::string& where, std::vector<std::string>& notes) {
    const ImageLayer* layer = layerOf(image);
    if (!layer) fail("has no layer with R, G and B");
    for (const auto* said : {&image.notes.lines, &image.notes.not_applied, &image.notes.in_part})
        for (const std::string& line : *said) notes.push_back(where + ": " + line);
    if (!layer->name.empty())
        notes.push_back(
            fmt::format("{}: has no R, G, B outside layers; layer {} is read", where, oneLine(layer->name)));
    Repaired repaired;
    Image radiance = repairedFrom(*layer, repaired);
    note(notes, repaired.negative, where, "negative");
    note(notes, repaired.not_finite, where, "not finite");
    return radiance;
}

}  // namespace diptych
