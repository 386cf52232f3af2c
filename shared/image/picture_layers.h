// SPDX-License-Identifier: MIT
// The contents of a picture file of any renderer: layers of float32.
#pragma once

#include "shared/image/image.h"
#include "shared/image/png.h"
#include "shared/image/primaries.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace diptych {

// Component i of `image` is the channel `channels[i]`.
struct PictureLayer {
    // "" for channels without a layer name (R, G, B, A; Y; Z). For an EXR of several parts "PART.LAYER", or
    // LAYER alone if it begins with the part's name, or PART for channels without a layer name.
    std::string name;
    // Full names: "R", "albedo.R", "beauty.albedo.R". In the order R G B A, X Y Z, U V; others in the file's
    // order.
    std::vector<std::string> channels;
    // The type stored in the file: "half", "float", "uint", or "mixed" if the channels of an EXR's layer
    // differ; "8 bit", "16 bit"; "RGBE".
    std::string sample;
    Image image;
    // For each channel the stored uint32 of every pixel, if float32 has rounded some of them (above 2^24);
    // empty if the image holds all of them exactly. The outer vector is empty if there is no such channel.
    std::vector<std::vector<std::uint32_t>> exact{};
    Image8 coded{};  // in place of `image`, if the reader was asked to keep 8 bits
    // Of an EXR's colours that are not Rec. 709's: convertColors() of those channels is the caller's, who
    // knows which are colours. Other formats' colours are converted.
    std::optional<glm::dmat3> to_rec709{};

    // The value in the file, not rounded: two values are equal only if they are equal in the files. For PNG
    // and for scaled files it is the image's value.
    double value(std::size_t pixel, std::size_t channel) const {
        if (channel < exact.size() && !exact[channel].empty()) return exact[channel][pixel];
        return image.pixel(pixel)[channel];
    }
};

struct PictureFile {
    int width = 0, height = 0;      // of every layer, pixels
    std::string format;             // "OpenEXR", "PNG", "JPEG", "TIFF", "Radiance HDR", "PFM"
    bool display_referred = false;  // sRGB-encoded, 0 to 1; else linear
    std::vector<PictureLayer> layers;
    // An EXR's string attributes as they are in the file (to be passed through oneLine() before they are
    // shown). In files of this program they describe settings, scene and device.
    std::map<std::string, std::string> attributes{};
    FileNotes notes{};
    bool straight_alpha = false;  // colours are not multiplied by alpha: PNG's are not, OpenEXR's are
};

}  // namespace diptych
