// SPDX-License-Identifier: MIT
// The truth that paths are held against: direct light in double precision, written from the definitions. No
// Vulkan, no shader, no formula of theirs.
#pragma once

#include "compare/reference/request.h"
#include "shared/image/image.h"

#include <map>
#include <vector>

namespace diptych::reference {

struct Picture {
    std::map<int, Image> channels;  // by debug mode, all of them; the background as a Frame has it
    // Of lit, in its unit: half the 95 % confidence interval of what was sampled and what quadrature left
    // open. Empty where nothing was.
    Image uncertainty;
};

// What mode surface shades, as a path without any encoding captures it at one sample.
std::vector<int> surfaceChannels();

// Multithreaded; the same picture whatever the number of threads and however often it was interrupted. Throws
// std::runtime_error, one line, where what is done cannot be kept.
Picture draw(const Request& request);

}  // namespace diptych::reference
