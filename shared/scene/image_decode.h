// SPDX-License-Identifier: MIT
#pragma once

#include "shared/scene/scene.h"

#include <span>
#include <string>

namespace diptych {

// A PNG or JPEG as RGBA, 8 bits a component; `sixteenBits` says that the file held more. Throws
// std::runtime_error without a name: "is neither PNG nor JPEG", "does not decode: bad huffman code".
TextureImage decodeImage(std::span<const unsigned char> encoded, bool& sixteenBits);

}  // namespace diptych
