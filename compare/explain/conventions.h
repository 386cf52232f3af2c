// SPDX-License-Identifier: MIT
// Shading conventions that another renderer may use: choices that glTF leaves open or makes otherwise
// (shared/material/README.md). The image's conventions are found by trial.
#pragma once

#include "shared/frame/frame.h"
#include "shared/frame/settings.h"
#include "shared/image/image.h"

#include <functional>
#include <string_view>
#include <vector>

namespace diptych {

struct Convention {
    std::string_view option, value;
    std::string_view shows;  // description of the cause
};

// Whether an image is from another renderer: its Settings are the request, not necessarily what it does.
bool isForeign(const Frame& frame);

// Renders and compares trials with another renderer's image.
struct ConventionTrial {
    std::function<Image(const Settings&)> draw;      // lit under Settings, W x H x 3
    std::function<double(const Image&)> distance{};  // from its image to theirs, a mean over pixels
};

// The conventions, beside those in `said`, that bring our image nearest to theirs. Tries all subsets of
// the conventions that change the image, because two may cancel. Removes those that bring it nearer by
// less than half of their change. Each option occurs once.
std::vector<Convention> nearestConventions(const Settings& said, const ConventionTrial& trial);

// `said` with these conventions.
Settings withConventions(Settings said, const std::vector<Convention>& conventions);

}  // namespace diptych
