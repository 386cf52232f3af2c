// SPDX-License-Identifier: MIT
// The result of explain(): causes with their contributions, the unexplained remainder, and maps.
#pragma once

#include "shared/image/image.h"

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace diptych {

// A material's or a light's part of a cause's contribution.
struct CausePart {
    int index = -1;           // of the material in the scene, -1: the background; or in SceneView::lights
    std::string name;         // a material's may be empty; without a name, a light has that of its type
    double contribution = 0;  // W/(sr m^2), as Cause::contribution
};

struct Cause {
    std::string name;  // "normals"; "--haze"; "samples of a pixel"
    std::string description;
    double contribution = 0;     // of Explanation::distance, W/(sr m^2)
    double interval = 0;         // half the 95 % confidence interval; 0: exact
    double alone = 0, last = 0;  // effect of swapping it alone; effect of swapping it last
    double worst = 0;            // the largest contribution of a pixel, W/(sr m^2)
    int worst_x = 0, worst_y = 0;
    double dominates = 0;  // fraction, 0 to 1, of the pixels with any cause where this one is the largest
    // Its contribution to the mean HDR-FLIP, by the same orders. These and Explanation::flip_unexplained sum
    // to Explanation::flip.
    double flip = 0;
    std::vector<CausePart> materials;  // of the baseline's pixels; descending
    // For direct light and shadows; descending. Excludes change that no light accounts for, and lights
    // that were not rendered.
    std::vector<CausePart> lights;
    // W x H x 1: the pixel's part of `contribution` times the number of pixels, W/(sr m^2). The mean is
    // `contribution`; negative where the cause compensates for others.
    Image map;
};

// Two causes whose joint effect differs from the sum of their effects.
struct CausePair {
    std::size_t first = 0, second = 0;  // indices into Explanation::causes
    double interaction = 0;             // Contributions::interaction, W/(sr m^2)
};

// A source's part of the distance between one path on two devices.
struct DeviceContribution {
    std::string name, description;  // name: "textures"
    double contribution = 0;        // W/(sr m^2), as Cause::contribution
};

struct Explanation {
    // The mean of |test - baseline| of lit over pixels and components, W/(sr m^2): before any cause is taken,
    // and after swapping all causes.
    double distance = 0, unexplained = 0;
    double flip = 0, flip_unexplained = 0;  // the same for mean HDR-FLIP
    std::vector<Cause> causes;              // descending by contribution
    std::vector<CausePair> pairs;           // those above 5 % of the distance, the largest first
    std::vector<DeviceContribution>
        devices;  // for two devices (device_contributions.h), descending; else empty
    // Relative residual of relighting, baseline and test: mean difference between the relit channels and
    // lit, as a fraction of the mean of lit.
    std::array<double, 2> reproduction{};
    std::size_t nonfinite = 0;  // pixels of lit that are NaN or infinite on a side; they count as equal
    std::size_t subsets = 0, frames = 0;      // numbers of relit subsets, and of frames rendered for Settings
    std::vector<std::string> without_effect;  // names of differences that change no pixel
    // Numbers of lights rendered alone for Cause::lights, and of those omitted as too many; 0: none.
    std::size_t lights_drawn = 0, lights_omitted = 0;
    // W x H x 1: index into `causes` of the largest contribution at the pixel; -1 where no cause brings lit
    // nearer.
    Image dominant;
    Image unexplained_map;  // W x H x 1, as Cause::map; all maps sum to the pixel's difference

    // A contribution as a fraction of the distance; 0 if the distance is 0.
    double fractionOf(double contribution) const { return distance > 0 ? contribution / distance : 0.0; }
    double fractionOfFlip(double contribution) const { return flip > 0 ? contribution / flip : 0.0; }
};

}  // namespace diptych
