// SPDX-License-Identifier: MIT
// Synthetic Frames.
#pragma once

#include "shared/frame/frame.h"

#include <string>

namespace diptych {

// lit is `value` in every component; every pixel has material `id` (-1: background).
inline Frame flatFrame(Path path, int width, int height, float value = 0, float id = 0) {
    Frame frame;
    frame.name = std::string(nameOf(path));
    frame.settings.path = path;
    frame.settings.size = {width, height};
    frame.channels[Channel::lit] = Image(width, height, 3, value);
    frame.channels[Channel::material_id] = Image(width, height, 1, id);
    return frame;
}

}  // namespace diptych
