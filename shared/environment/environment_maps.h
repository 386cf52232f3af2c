// SPDX-License-Identifier: MIT
// All that shading needs of an environment, made on the CPU.
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
    bool prefilter = true;  // else the environment's own pyramid, for samples at every pixel
    bool operator==(const EnvironmentRequest&) const = default;
};

struct EnvironmentMaps {
    Harmonics harmonics{};
    NodeMap diffuse;              // irradiance over pi
    std::vector<NodeMap> levels;  // as of contract/environment.h
};

// How many nodes a side the maps have that are made of a picture so large.
struct MapSides {
    int diffuse = 0;
    std::vector<int> levels;
};
MapSides mapSides(int width, int height, bool prefilter);

EnvironmentMaps makeEnvironmentMaps(const Environment& environment, const EnvironmentRequest& request);

// Where each map's texels begin, in one picture of all of them.
struct EnvironmentAtlas {
    int width = 0, height = 0;
    std::vector<glm::vec4> texels{};  // row by row
    glm::vec4 diffuse{0};             // x, y, side
    std::vector<glm::vec4> levels{};
};
EnvironmentAtlas layOut(const EnvironmentMaps& maps);

// What SH keeps of the irradiance, against the sum over all texels: shares of the largest irradiance.
struct TruncationError {
    double mean = 0, worst = 0;
};
TruncationError truncationError(const EnvironmentMaps& maps, double window);

}  // namespace diptych
