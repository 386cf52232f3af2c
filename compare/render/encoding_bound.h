// SPDX-License-Identifier: MIT
// How far the G-buffer's encoding may move a lit channel at each pixel: its fields' bounds, which their bits
// give, propagated through the shading.
#pragma once

#include "shared/contract/encoded_surface.h"
#include "shared/image/image.h"

namespace diptych {

// Gathers what forward+ shades from surfaces that were moved by as much as the bits allow. With c the
// light of SURFACE_RAISED, the bound is
//     |c - own| + r + n + n r / |c|,   n = max |normal moved - c|,   r = max |roughness moved - c|,
// each | | the largest component, for |a + b| <= |a| + |b|; the product is of what both move together, as
// factors of one lobe.
class EncodingBound {
public:
    // `own`: what forward+ shades from its own surfaces, W x H x 3, W/(sr m^2). It must outlive this.
    explicit EncodingBound(const Image& own);

    // `shaded`: the same of `surface`. SURFACE_RAISED comes first; the others in any order.
    void add(gpu::uint surface, Image shaded);

    // W x H x 1, W/(sr m^2). A moved surface whose light is NaN or infinite adds nothing. Nothing may be
    // added after it.
    Image take();

private:
    const Image& own_;
    Image raised_, normal_, roughness_;
};

}  // namespace diptych
