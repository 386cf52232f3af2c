// SPDX-License-Identifier: MIT
// What a picture file of any renderer holds: layers of float32.
#pragma once

#include "shared/image/image.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace diptych {

// Component i of `image` is the channel `channels[i]`.
struct PictureLayer {
    // "" for the channels without one (R, G, B, A; Y; Z). Of several EXR parts "PART.LAYER", or LAYER alone
    // where that begins with the part's name already, or PART for the channels without a layer.
    std::string name;
    // In full: "R", "albedo.R", "beauty.albedo.R". In the order R G B A, X Y Z, U V, others as the file has
    // them.
    std::vector<std::string> channels;
    // What the file stores: "half", "float", "uint", or "mixed" where the channels of an EXR's layer differ;
    // "8 bit", "16 bit"; "RGBE".
    std::string sample;
    Image image;
    // Per channel: the stored uint32 of every pixel where float32 has rounded some of them (above 2^24),
    // empty where the image holds all exactly. Without a channel of that kind there is none at all.
    std::vector<std::vector<std::uint32_t>> exact{};

    // What stands in the file, not rounded: two of them are equal only where the files are. A PNG's and a
    // scaled file's is the image's value.
    double value(std::size_t pixel, std::size_t channel) const {
        if (channel < exact.size() && !exact[channel].empty()) return exact[channel][pixel];
        return image.pixel(pixel)[channel];
    }
};

struct PictureFile {
    int width = 0, height = 0;      // of every layer, pixels
    std::string format;             // "OpenEXR", "PNG", "Radiance HDR", "PFM"
    bool display_referred = false;  // sRGB-encoded, 0 to 1; else linear
    std::vector<PictureLayer> layers;
    // An EXR's string attributes, as the file has them (oneLine() before they are shown). Those that are
    // written here name settings, scene and device.
    std::map<std::string, std::string> attributes{};
    std::vector<std::string> notes{};  // what was left out or assumed, a line each without the file's name
};

}  // namespace diptych
