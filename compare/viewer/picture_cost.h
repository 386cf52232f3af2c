// SPDX-License-Identifier: MIT
// How large a picture that moves may be.
#pragma once

#include "shared/frame/settings.h"

namespace diptych::viewer {

// What a picture of both paths takes, by its pixels: `fixed` + `per_pixel` times these, ms. Learned from
// pictures of two sizes; what shadow maps and triangles cost does not shrink with the picture.
class PictureCost {
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
    Point small_, large_;  // the last picture, and the last one of at least twice its pixels
};

// The size at which a picture that moves is drawn: `full` divided by a whole number, so that it takes about
// `milliseconds`, of which at least half goes into pixels: beyond that a smaller picture would be hardly
// faster.
Size movingSize(const Size& full, double milliseconds, const PictureCost& cost);

}  // namespace diptych::viewer
