// SPDX-License-Identifier: MIT
#include "shared/scene/lights_json.h"
#include "tests/fuzz/fuzz.h"

#include <glm/geometric.hpp>

#include <cmath>

using namespace diptych;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    fuzz::readOrSayWhy([&] {
        for (const Light& light : lightsFromJson(fuzz::textAt(data, size), "fuzz.json")) {
            fuzz::require(std::abs(glm::length(light.direction) - 1) < 1e-12,
                          "a direction is of unit length");
            fuzz::require(std::isfinite(glm::dot(light.position, light.position)), "a position is finite");
            fuzz::require(light.intensity >= 0 && std::isfinite(light.intensity), "intensity is finite");
            for (int c = 0; c < 3; ++c)
                fuzz::require(light.color[c] >= 0 && std::isfinite(light.color[c]), "colour is finite");
            fuzz::require(light.range > 0, "a range is above 0");
            fuzz::require(light.inner_cone >= 0 && light.inner_cone < light.outer_cone, "a cone has an edge");
            fuzz::require(light.node == -1, "a light of a file is in world space");
        }
    });
    return 0;
}
