// SPDX-License-Identifier: MIT
// The contents of an image file of any renderer: layers of float32.
#pragma once

#include "shared/image/claims.h"
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
struct ImageLayer {
    // "" for channels without a layer name (R, G, B, A; Y; Z). For a multi-part EXR: "PART.LAYER"; only
    // LAYER if it begins with the part's name; only PART for channels without a layer name.
    std::string name;
    // Full names: "R", "albedo.R", "beauty.albedo.R". Ordered R G B A, X Y Z, U V; others follow in the
    // file's order.
    std::vector<std::string> channels;
    // Type in the file: "half", "float", "uint", or "mixed" if the channels of an EXR layer differ; "8
    // bit", "16 bit"; "RGBE".
    std::string sample;
    Image image;
    // By channel, the stored uint32 values if float32 rounded any of them (above 2^24); else empty. The
    // outer vector is empty if there is no such channel.
    std::vector<std::vector<std::uint32_t>> exact{};
    Image8 coded{};  // replaces `image` if the reader was asked to keep 8 bits
    // For an EXR with other primaries than Rec. 709: the conversion. The caller applies it by
    // convertColors(), because it knows which channels are colours. Other formats are already converted.
    std::optional<glm::dmat3> to_rec709{};

    // The unrounded value in the file: equal only if the values in the files are equal. For PNG and scaled
    // files it is the image's value.
    double value(std::size_t pixel, std::size_t channel) const {
        if (channel < exact.size() && !exact[channel].empty()) return exact[channel][pixel];
        return image.pixel(pixel)[channel];
    }
};

struct ImageFile {
    int width = 0, height = 0;      // pixels, of every layer
    std::string format;             // "OpenEXR", "PNG", "JPEG", "TIFF", "Radiance HDR", "PFM"
    bool display_referred = false;  // sRGB-encoded, 0 to 1; else linear
    std::vector<ImageLayer> layers;
    // String attributes of an EXR, raw: pass them through oneLine() before printing. In this program's
    // files they describe settings, scene and device.
    std::map<std::string, std::string> attributes{};
    FileNotes notes{};
    // Colours are not premultiplied by alpha: true for PNG, false for OpenEXR.
    bool straight_alpha = false;
    Claim claim{};
};

}  // namespace diptych
