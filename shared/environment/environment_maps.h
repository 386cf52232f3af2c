// SPDX-License-Identifier: MIT
// Maps of an environment for shading, computed on the CPU.
#pragma once

#include "shared/contract/environment.h"
#include "shared/environment/harmonics.h"
#include "shared/environment/prefilter.h"

#include <glm/mat3x3.hpp>
#include <glm/vec4.hpp>

#include <array>
#include <string>
#include <vector>

namespace diptych {

struct EnvironmentRequest {
    FilterQuality quality;
    bool prefilter = true;  // else a mip pyramid of the environment, sampled at every pixel
    bool operator==(const EnvironmentRequest&) const = default;
};

struct EnvironmentMaps {
    Harmonics harmonics{};
    NodeMap diffuse;              // irradiance / pi
    std::vector<NodeMap> levels;  // as in contract/environment.h
};

// Nodes per side of the maps of an image of a given size.
struct MapSides {
    int diffuse = 0;
    std::vector<int> levels;
};
MapSides mapSides(int width, int height, bool prefilter);

EnvironmentMaps makeEnvironmentMaps(const Environment& environment, const EnvironmentRequest& request);

// All maps in one image, with the corner of each.
struct EnvironmentAtlas {
    int width = 0, height = 0;
    std::vector<glm::vec4> texels{};  // row by row
    glm::vec4 diffuse{0};             // x, y, side
    std::vector<glm::vec4> levels{};
};
EnvironmentAtlas layOut(const EnvironmentMaps& maps);

// Error of spherical harmonics irradiance against the sum over all texels, relative to the largest
// irradiance.
struct TruncationError {
    double mean = 0, worst = 0;
};
TruncationError truncationError(const EnvironmentMaps& maps, double window);

}  // namespace diptych
