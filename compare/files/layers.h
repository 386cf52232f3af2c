// SPDX-License-Identifier: MIT
// Matches layers of two image files by name.
#pragma once

#include "shared/frame/debug_modes.h"
#include "shared/image/image_file.h"
#include "shared/image/image_rows.h"

#include <cstdint>
#include <string>
#include <vector>

namespace diptych {

// A channel of an image file, as compared. R, G, B without a layer name are "lit", Z is "depth". Layers
// with the name and width of a debug mode are that mode. Alpha and other components are separate:
// "albedo.A", "A".
struct ImageChannel {
    std::string name;
    std::vector<std::string> channels;  // names in the file: "albedo.R", ...
    std::string type;                   // "half", "8 bit", ...
    ChannelKind kind = ChannelKind::scalar;
    Image image;
    // Exact integers of a single channel if float32 would round them; else empty.
    std::vector<std::uint32_t> exact{};
    Image8 coded{};  // replaces `image`: 8 bits per component, one component for grey

    int components() const {
        const bool grey = kind == ChannelKind::color && channels.size() == 1;
        return grey ? 3 : static_cast<int>(channels.size());
    }
};

// `names`: renames channels, for example "albedo=diffuse.R,diffuse.G,diffuse.B"; not for 8-bit layers.
// Renamed channels leave their layers. Omits the uncertainty of our own files. Throws std::runtime_error
// for malformed names.
std::vector<ImageChannel> channelsOf(ImageFile file, const std::vector<std::string>& names);

// Throws std::runtime_error if neither file has all channels of one of `names`.
void checkNames(ImageFile& reference, ImageFile& test, const std::vector<std::string>& names);

// Channel of a reference's EXR with Frame::uncertainty. In files of diptych it is not part of the image
// and is not compared; --map can rename it to compare it.
inline constexpr const char* uncertainty_channel = "uncertainty.Y";

// Removes the uncertainty from one of our files: W x H x 1, empty if absent.
Image takeUncertainty(ImageFile& file);

struct MatchedChannel {
    std::string name;
    ChannelKind kind = ChannelKind::scalar;
    ErrorKind error_kind = ErrorKind::absolute;  // from the debug mode if an angle or exact
    std::string reference_type, test_type;
    std::vector<std::string> channels;  // names in the reference
    StoredImage reference, test;
};

// A channel of only one image.
struct OneSidedChannel {
    std::string name;
    std::string owner;  // "the reference"
};

struct MatchedChannels {
    std::vector<MatchedChannel> channels;  // in the reference's order
    std::vector<std::string> notes;        // renamed colours, added alpha, differing types
    std::vector<OneSidedChannel> one_sided;
};

// `wanted`: name patterns (* and ?); empty: all. If only one image has the alpha of a common colour, the
// other's is 1. Throws std::runtime_error if a pattern matches no common channel, if widths differ, or if
// there is no common channel.
MatchedChannels matchChannels(std::vector<ImageChannel> reference, std::vector<ImageChannel> test,
                              const std::vector<std::string>& wanted);

}  // namespace diptych
