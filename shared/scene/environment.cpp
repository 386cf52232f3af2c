// SPDX-License-Identifier: MIT
#include "shared/scene/environment.h"

#include "shared/image/picture_file.h"
#include "shared/text/one_line.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <stdexcept>

namespace diptych {

namespace {

using Channels = std::array<std::size_t, 3>;

// Where a layer has R, G and B: "R" or "LAYER.R".
std::optional<Channels> colourOf(const PictureLayer& layer) {
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

const PictureLayer* layerOf(const PictureFile& picture) {
    const PictureLayer* found = nullptr;
    for (const PictureLayer& layer : picture.layers)
        if (colourOf(layer) && (!found || layer.name.empty())) {
            found = &layer;
            if (layer.name.empty()) break;
        }
    return found;
}

// R, G and B; counts the pixels of which something is 0 instead.
struct Repaired {
    std::size_t negative = 0, not_finite = 0;
};
Image radianceOf(const PictureLayer& layer, Repaired& repaired) {
    const Channels channels = *colourOf(layer);
    Image radiance(layer.image.width, layer.image.height, 3);
    for (std::size_t i = 0; i < radiance.pixels(); ++i) {
        bool negative = false, notFinite = false;
        for (std::size_t c = 0; c < channels.size(); ++c) {
            const float value = layer.image.pixel(i)[channels[c]];
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
        notes.push_back(fmt::format("{}: {} pixel{} {}, taken as 0", where, pixels,
                                    pixels == 1 ? " has a component that is" : "s have components that are",
                                    what));
}

}  // namespace

Environment readEnvironment(const std::filesystem::path& file, std::vector<std::string>& notes) {
    const PictureFile picture = readPicture(file);
    const std::string name = file.string();
    if (picture.display_referred)
        throw std::runtime_error(
            fmt::format("{}: is a {} of display colours, and an environment is radiance: give an OpenEXR or "
                        "Radiance HDR file",
                        name, picture.format));
    const PictureLayer* layer = layerOf(picture);
    if (!layer) throw std::runtime_error(name + ": has no layer with R, G and B");

    const std::string where = "environment " + oneLine(name);
    for (const std::string& said : picture.notes) notes.push_back(where + ": " + said);
    if (!layer->name.empty())
        notes.push_back(
            fmt::format("{}: has no R, G, B without a layer: {} is read", where, oneLine(layer->name)));
    if (picture.width != 2 * picture.height)
        notes.push_back(fmt::format("{}: {} x {} pixels, not twice as wide as high: taken as all directions",
                                    where, picture.width, picture.height));
    Repaired repaired;
    Environment environment{name, radianceOf(*layer, repaired)};
    note(notes, repaired.negative, where, "negative");
    note(notes, repaired.not_finite, where, "not finite");
    return environment;
}

}  // namespace diptych
