// SPDX-License-Identifier: MIT
// What explain() finds: causes with their shares, what is left, and where.
#pragma once

#include "shared/image/image.h"

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace diptych {

// What a material has of a cause's share.
struct MaterialShare {
    int material = -1;  // -1: the background
    std::string name;   // may be empty
    double share = 0;   // W/(sr m^2), as Cause::share
};

// What a light has of a cause's share.
struct LightShare {
    std::size_t light = 0;  // place in SceneView::lights
    std::string name;       // "Lamp"; else its kind
    double share = 0;       // W/(sr m^2), as Cause::share
};

struct Cause {
    std::string name;            // "normals"; "--haze"; "samples of a pixel"
    std::string shows;           // what it is, in words
    double share = 0;            // of Explanation::distance, W/(sr m^2)
    double interval = 0;         // half the 95 % confidence interval; 0: exact
    double alone = 0, last = 0;  // swapped alone; when all others are
    double worst = 0;            // the share at the pixel where it is largest, W/(sr m^2)
    int worst_x = 0, worst_y = 0;
    // Its share of the mean HDR-FLIP: what swapping it brings of that, by the same orders. All shares and
    // Explanation::flip_unexplained are Explanation::flip.
    double flip = 0;
    std::vector<MaterialShare> materials;  // of the baseline's pixels; descending
    // Of direct light and shadows; descending. What no light accounts for, or lights that were not drawn, is
    // in none of them.
    std::vector<LightShare> lights;
    // W x H x 1: what the pixel adds to the share, times the number of pixels: W/(sr m^2). Its mean is the
    // share; it is negative where the cause makes up for others.
    Image map;
};

// Two causes that do more or less together than each by itself.
struct CausePair {
    std::size_t first = 0, second = 0;  // of Explanation::causes
    double interaction = 0;             // Shares::interaction, W/(sr m^2)
};

// A part of the distance between one path on two devices, by where it comes from.
struct DeviceShare {
    std::string name, shows;  // "textures"; what it is, in words
    double share = 0;         // W/(sr m^2), as Cause::share
};

struct Explanation {
    // The mean over the picture's pixels and components of |test - baseline| of lit, W/(sr m^2): as it is,
    // and as it is left when all causes are swapped.
    double distance = 0, unexplained = 0;
    double flip = 0, flip_unexplained = 0;  // likewise the mean of HDR-FLIP
    std::vector<Cause> causes;              // descending by share
    std::vector<CausePair> pairs;           // those of over 5 % of the distance, the largest first
    std::vector<DeviceShare> devices;       // of two devices (device_shares.h), descending; else none
    // How far the lighting of a side's own channels is from that side's lit: the mean difference, as a share
    // of the mean of lit: baseline, test. That is the rest.
    std::array<double, 2> reproduction{};
    std::size_t nonfinite = 0;  // pixels of lit that are NaN or infinite on a side, which count as alike
    std::size_t subsets = 0, frames = 0;  // that were shaded, and drawn for Settings
    std::vector<std::string> inert;       // what differs and yet changes no pixel
    // Lights that were drawn alone for Cause::lights, and those that were not, as too many; 0: none was.
    std::size_t lights_drawn = 0, lights_left_out = 0;
    // W x H x 1: the place in `causes` of that with the largest share at the pixel; -1 where no cause brings
    // lit nearer.
    Image dominant;
    Image unexplained_map;  // W x H x 1, as Cause::map; all maps together are the difference at the pixel

    // What all causes bring, as a share of the distance: 0 where there is none.
    double shareOf(double share) const { return distance > 0 ? share / distance : 0.0; }
    double shareOfFlip(double share) const { return flip > 0 ? share / flip : 0.0; }
};

}  // namespace diptych
