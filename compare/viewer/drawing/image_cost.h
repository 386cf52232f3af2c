// SPDX-License-Identifier: MIT
// Chooses the size of moving images.
#pragma once

#include "shared/frame/settings.h"

namespace diptych::viewer {

// Time to render both paths, ms: `fixed` + `per_pixel` times the pixels. Fitted to images of two sizes;
// the cost of shadow maps and triangles does not depend on the size.
class ImageCost {
public:
    void add(double pixels, double ms);
    bool known() const { return small_.pixels > 0; }
    double of(double pixels) const;  // ms
    double fixed() const;            // ms
    double perPixel() const;         // ms

private:
    struct Point {
        double pixels = 0, ms = 0;
    };
    Point small_, large_;  // the last image, and the last one of at least twice its pixels
};

// The size of a moving image: `full` divided by an integer, so that it takes about `milliseconds`. At
// least half of that is spent on pixels; a smaller image would hardly be faster.
Size movingSize(const Size& full, double milliseconds, const ImageCost& cost);

}  // namespace diptych::viewer
