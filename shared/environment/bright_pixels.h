// SPDX-License-Identifier: MIT
// What single pixels of a lat-long picture have far above its mean. A map that takes a fixed number of places
// a texel would miss a sun or count it twice; this light is added to maps by its solid angle.
#pragma once

#include "shared/environment/octahedral_map.h"

#include <vector>

namespace diptych {

class BrightPixels {
public:
    // Takes from the picture what its pixels have above 8 times its mean, by their largest component.
    explicit BrightPixels(Environment& picture);

    // Adds it. Integrals over all directions grow by what it has under the bilinear interpolation.
    void addTo(OctahedralMap& map) const;
    void addTo(NodeMap& map) const;

private:
    struct Pixel {
        int x, y;
        glm::vec3 radiance;
    };
    // Each pixel in parts that are small beside a map's texels: direction and W/m^2.
    template <class Visit>
    void eachPart(int side, const Visit& visit) const;

    int width_, height_;
    std::vector<double> solid_;  // of a pixel of each row
    std::vector<Pixel> pixels_;
};

}  // namespace diptych
