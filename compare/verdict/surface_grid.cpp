// SPDX-License-Identifier: MIT
#include "compare/verdict/surface_grid.h"

#include "compare/metrics/pixel.h"
#include "compare/verdict/tolerance.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace diptych {
namespace {

constexpr double roundoff = 0x1p-24;  // of one float32 operation

// Operations between a vertex and an interpolated value at a pixel: transform, division, plane equation,
// perspective.
constexpr double interpolatingOperations = 32;
// Vulkan permits 2.5 ULP for a division and half an ULP for a product or sum.
constexpr double ulpsOfOperation = 2.5;

// A triangle's normal is the cross product of differences of positions one pixel apart, four with some
// seven operations each.
constexpr double operationsOfFacet = 28;

// How much steeper the pixel's own triangle is than its neighbours show, for triangles smaller than a
// pixel and at outlines. At least 1.
class Steepness {
public:
    explicit Steepness(const Frame& frame)
        : frame_(frame),
          depth_(findChannel(frame, Channel::depth)),
          position_(findChannel(frame, Channel::position)),
          normal_(findChannel(frame, Channel::geometric_normal)) {
        const FrameCamera& c = frame.camera;
        for (int i = 0; i < 3; ++i) forward_[i] = c.target[i] - c.eye[i];
        normalize(forward_);
        right_ = cross(forward_, {c.up[0], c.up[1], c.up[2]});
        normalize(right_);
        up_ = cross(right_, forward_);
    }

    // Change of depth to the next pixel on the triangle's plane and `step` of a pixel beyond it, m.
    double slope(std::size_t i, double step) const {
        if (!depth_ || !position_ || !normal_ || *depth_->pixel(i) <= 0) return 0;
        const float *n = normal_->pixel(i), *p = position_->pixel(i);
        const double z = *depth_->pixel(i), pixel = z / pixelsPerRadian(frame_, i);
        double facing = 0;
        for (int c = 0; c < 3; ++c)
            facing += double{n[c]} * (frame_.camera.fov_degrees > 0 ? double{p[c]} / z : forward_[c]);
        const double across = pixel * (std::abs(dot(n, right_)) + std::abs(dot(n, up_)));
        const double left = std::abs(facing) - step * across / z;
        return left > 0 ? across / left : std::numeric_limits<double>::infinity();
    }

private:
    using Vector = std::array<double, 3>;
    static double dot(const float* a, const Vector& b) {
        return double{a[0]} * b[0] + double{a[1]} * b[1] + double{a[2]} * b[2];
    }
    static Vector cross(const Vector& a, const Vector& b) {
        return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
    }
    static void normalize(Vector& v) {
        const double length = std::hypot(v[0], v[1], v[2]);
        for (double& c : v) c = length > 0 ? c / length : 0;
    }

    const Frame& frame_;
    const Image *depth_, *position_, *normal_;
    Vector forward_{}, right_{}, up_{};
};

}  // namespace

double stepOf(const AcrossDevices& across, unsigned DevicePrecision::*bits) {
    return std::ldexp(1.0, -static_cast<int>(across.devices[0].*bits)) +
           std::ldexp(1.0, -static_cast<int>(across.devices[1].*bits));
}

double relativeRounding() {
    return 2 * interpolatingOperations * ulpsOfOperation * roundoff;
}

double pixelsPerRadian(const Frame& frame, std::size_t i) {
    const double height = frame.settings.size.height;
    if (frame.camera.fov_degrees > 0)
        return height / (2 * std::tan(frame.camera.fov_degrees / degreesPerRadian / 2));
    const Image* const depth = findChannel(frame, Channel::depth);
    return depth && frame.camera.ymag > 0 ? *depth->pixel(i) * height / (2 * frame.camera.ymag) : height;
}

FacetBound::FacetBound(const FramePair& pair)
    : frame_(pair.baseline), packed_(2 * encodingBound(debugMode(Channel::geometric_normal), pair)) {}

double FacetBound::operator()(std::size_t i) const {
    return 2 * operationsOfFacet * roundoff * pixelsPerRadian(frame_, i) * degreesPerRadian + packed_;
}

SurfaceGrid::SurfaceGrid(const FramePair& pair)
    : surface(pair.coverage.covered.size()),
      material(surface.size()),
      narrow(surface.size()),
      steeper(surface.size(), 1.0f) {
    const Image* const ids = findChannel(pair.baseline, Channel::material_id);
    if (!ids) return;
    const std::array sides{SurfaceAround(pair.baseline), SurfaceAround(pair.test)};
    const FacetBound facetOf(pair);
    const Steepness steepness(pair.baseline);
    const Image* const depth = findChannel(pair.baseline, Channel::depth);
    const double step = stepOf(*pair.across, &DevicePrecision::sub_pixel_bits);
    tbb::parallel_for(std::size_t{0}, surface.size(), [&](std::size_t i) {
        if (!pair.coverage.covered[i]) return;
        const double facet = facetOf(i);
        unsigned same = 0, alike = 0, triangle = 0;
        double shown = 0;
        aroundPixel(*ids, i, [&](std::size_t j, unsigned bit) {
            const auto both = [&](const auto& of) { return of(sides[0]) && of(sides[1]); };
            if (!both([&](const SurfaceAround& of) { return of.sameMaterial(i, j); })) return;
            alike |= bit;
            if (!both([&](const SurfaceAround& of) { return of.same(i, j); })) return;
            same |= bit;
            if (both([&](const SurfaceAround& of) { return of.turned(i, j) <= facet; })) triangle |= bit;
            if (depth) shown = std::max(shown, metrics::distance(*depth->pixel(i), *depth->pixel(j)));
        });
        surface[i] = static_cast<std::uint8_t>(same);
        material[i] = static_cast<std::uint8_t>(alike);
        narrow[i] = (triangle & across_bits) == 0 || (triangle & down_bits) == 0 ? 1 : 0;
        if (shown > 0) steeper[i] = static_cast<float>(std::max(1.0, steepness.slope(i, step) / shown));
    });
}

}  // namespace diptych
