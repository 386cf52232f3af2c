// SPDX-License-Identifier: MIT
// Classifies channels of an image file: light, vectors, numbers or ids.
#pragma once

#include "shared/frame/debug_modes.h"
#include "shared/image/image.h"

#include <string>
#include <vector>

namespace diptych {

// Component name after the last dot. Colour letters and words in any case become R, G, B or A.
std::string componentOf(const std::string& channel);

// By the name of a layer, the names of its channels and their type in the file.
ChannelKind kindOf(const std::string& name, const std::vector<std::string>& channels,
                   const std::string& type);

// Whether a tenth of the pixels that are not 0 have a negative component. Filters with negative lobes make
// fewer.
bool isNegative(const Image& image);

// Whether all values are integers, some beyond 1,024: ids as float32. Rendered light has fractions there.
bool isWhole(const Image& image);

// Whether the layer has the name and width of a debug mode.
bool isDebugMode(const std::string& name, std::size_t width);

ErrorKind errorKindOf(const std::string& name, std::size_t width, ChannelKind kind);

}  // namespace diptych
