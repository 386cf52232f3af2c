// SPDX-License-Identifier: MIT
// Matches the layers of two picture files by name.
#pragma once

#include "shared/frame/debug_modes.h"
#include "shared/image/picture_file.h"
#include "shared/image/picture_rows.h"

#include <cstdint>
#include <string>
#include <vector>

namespace diptych {

// One channel of a picture file as it is compared. R, G, B without a layer's name are "lit", Z is "depth",
// layers that are called like a debug mode and are as wide are that mode; alpha and whatever else a layer
// holds stands alone: "albedo.A", "A".
struct PictureChannel {
    std::string name;
    std::vector<std::string> channels;  // in the file: "albedo.R", ...
    std::string type;                   // "half", "8 bit", ...
    ChannelKind kind = ChannelKind::scalar;
    Image image;
    // Of a single channel: the exact integers, where float32 rounds them; else empty.
    std::vector<std::uint32_t> exact{};
    Image8 coded{};  // in place of `image`: 8 bits a component, of a grey colour one

    int components() const {
        const bool grey = kind == ChannelKind::color && channels.size() == 1;
        return grey ? 3 : static_cast<int>(channels.size());
    }
};

// `names`: renames another renderer's channels, e.g. "albedo=diffuse.R,diffuse.G,diffuse.B" (not of layers
// that are kept in 8 bits). Used
// channels are taken out of the layers they were in. Of our own files the uncertainty is left out. Throws
// std::runtime_error where such words are wrong.
std::vector<PictureChannel> channelsOf(PictureFile file, const std::vector<std::string>& names);

// Throws std::runtime_error where the channels of one of `names` are not together in either file.
void checkNames(PictureFile& reference, PictureFile& test, const std::vector<std::string>& names);

// The channel in which a reference's EXR says how far its lit is known (Frame::uncertainty). In a file that
// diptych wrote it is no channel of the picture, and nothing compares it; --map can give it a name that is
// compared.
inline constexpr const char* uncertainty_channel = "uncertainty.Y";

// Takes it out of such a file: W x H x 1, empty where there is none.
Image takeUncertainty(PictureFile& file);

struct MatchedChannel {
    std::string name;
    ChannelKind kind = ChannelKind::scalar;
    Metric metric = Metric::absolute;  // of the debug mode of that name where it is angular or exact
    std::string reference_type, test_type;
    std::vector<std::string> channels;  // in the reference
    StoredPicture reference, test;
};

// A channel that only one of two pictures has.
struct OneSidedChannel {
    std::string name;
    std::string owner;  // "the reference"
};

struct MatchedChannels {
    std::vector<MatchedChannel> channels;  // in the reference's order
    std::vector<std::string> notes;        // channels that have two types
    std::vector<OneSidedChannel> one_sided;
};

// `wanted`: patterns of names (* and ?), empty: all. Where one picture alone has the alpha of a colour that
// both have, the other's is 1. Throws std::runtime_error where a pattern names nothing that both have, where
// one name is of different widths, or where nothing is in both.
MatchedChannels matchChannels(std::vector<PictureChannel> reference, std::vector<PictureChannel> test,
                              const std::vector<std::string>& wanted);

}  // namespace diptych
