// SPDX-License-Identifier: MIT
// Shading conventions that another renderer may use: choices that glTF leaves open or makes otherwise
// (shared/material/README.md). The image's conventions are found by trial.
#pragma once

#include "compare/render/renderer.h"
#include "shared/frame/frame.h"
#include "shared/frame/settings.h"
#include "shared/image/image.h"

#include <functional>
#include <string_view>
#include <vector>

namespace diptych {

struct Convention {
    std::string_view option, value;
    std::string_view description;  // of the cause
};

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

// Another renderer's image of the view of `ours`, as input of explain(). Settings and channels that it
// does not declare come from `ours`, so lit differences are attributed to lighting. Tries other skin
// normals (--skin-normals) and widened roughness (--spec-aa), and takes the channels that bring lit
// closer. `options`: of `ours`, with explainedChannels().
Frame substituteChannels(const Frame& external, const Frame& ours, Renderer& renderer,
                         const RenderOptions& options);

}  // namespace diptych
