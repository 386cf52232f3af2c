// SPDX-License-Identifier: MIT
// Radiance of single pixels far above the mean of a lat-long image. A map that samples each texel a fixed
// number of times would miss a sun or count it twice, so this light is added to maps by its solid angle.
#pragma once

#include "shared/environment/octahedral_map.h"

#include <vector>

namespace diptych {

class BrightPixels {
public:
    // Removes from the image the part of its pixels above 8 times its mean, by the largest component.
    explicit BrightPixels(Environment& image);

    // Adds the removed light. Integrals over all directions grow by its integral under bilinear
    // interpolation.
    void addTo(OctahedralMap& map) const;
    void addTo(NodeMap& map) const;

private:
    struct Pixel {
        int x, y;
        glm::vec3 radiance;
    };
    // Visits each pixel in parts that are small compared to a map's texels: direction and W/m^2.
    template <class Visit>
    void eachPart(int side, const Visit& visit) const;

    int width_, height_;
    std::vector<double> solid_;  // solid angle of a pixel in each row, sr
    std::vector<Pixel> pixels_;
};

}  // namespace diptych
