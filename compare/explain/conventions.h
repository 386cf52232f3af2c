// SPDX-License-Identifier: MIT
// Conventions of shading that another program may have: what glTF leaves open or has otherwise
// (shared/material/README.md). Which of them its picture shows is sought by trying.
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
    std::string_view shows;  // what a cause of it shows
};

// Whether a picture is another program's: its Settings are what it was asked for, and not what it does.
bool isForeign(const Frame& frame);

// What another program's picture is held against.
struct ConventionTrial {
    std::function<Image(const Settings&)> draw;      // lit under some Settings, W x H x 3
    std::function<double(const Image&)> distance{};  // of such a picture from theirs, a mean over pixels
};

// The conventions, beside those that `said` has, with which ours is nearest to theirs: the best of all
// subsets of those that change the picture, since two may cancel in it, without those that bring it nearer by
// less than half of what they change. Each option once.
std::vector<Convention> nearestConventions(const Settings& said, const ConventionTrial& trial);

// `said` with these.
Settings withConventions(Settings said, const std::vector<Convention>& conventions);

}  // namespace diptych
