// SPDX-License-Identifier: MIT
#include "compare/render/encoding_bound.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace diptych {
namespace {

// The largest difference of a component; 0 where one is not finite.
float apart(const float* a, const float* b) {
    float largest = 0;
    for (int c = 0; c < 3; ++c) {
        const float difference = std::abs(a[c] - b[c]);
        if (std::isfinite(difference)) largest = std::max(largest, difference);
    }
    return largest;
}

template <class Visit>
void eachPixel(const Image& image, const Visit& visit) {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, image.pixels(), 16384), [&](const auto& range) {
        for (std::size_t i = range.begin(); i != range.end(); ++i) visit(i);
    });
}

}  // namespace

EncodingBound::EncodingBound(const Image& own)
    : own_(own), normal_(own.width, own.height, 1), roughness_(own.width, own.height, 1) {}

void EncodingBound::add(gpu::uint surface, Image shaded) {
    if (surface == gpu::SURFACE_RAISED) {
        raised_ = std::move(shaded);
        return;
    }
    if (raised_.pixels() != shaded.pixels())
        throw std::logic_error("an encoding's bound begins with SURFACE_RAISED, of the same size");
    Image& largest = surface < gpu::SURFACE_ROUGHNESS ? normal_ : roughness_;
    eachPixel(shaded, [&](std::size_t i) {
        float& here = *largest.pixel(i);
        here = std::max(here, apart(shaded.pixel(i), raised_.pixel(i)));
    });
}

Image EncodingBound::take() {
    Image bound = std::move(normal_);
    eachPixel(bound, [&](std::size_t i) {
        const float* const raised = raised_.pixel(i);
        const float n = *bound.pixel(i), r = *roughness_.pixel(i);
        const float light = std::max({std::abs(raised[0]), std::abs(raised[1]), std::abs(raised[2])});
        const float both = light > 0 ? n * (r / light) : 0;
        *bound.pixel(i) = apart(raised, own_.pixel(i)) + r + n + (std::isfinite(both) ? both : 0);
    });
    raised_ = roughness_ = Image();
    return bound;
}

}  // namespace diptych
