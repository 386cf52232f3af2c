// SPDX-License-Identifier: MIT
#include "compare/verdict/surface_grid.h"

#include "compare/metrics/pixel.h"
#include "compare/verdict/tolerance.h"

#include <tbb/parallel_for.h>
#include <glm/geometric.hpp>
#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
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
        forward_ = normalized(glm::make_vec3(c.target) - glm::make_vec3(c.eye));
        right_ = normalized(glm::cross(forward_, glm::make_vec3(c.up)));
        up_ = glm::cross(right_, forward_);
    }

    // Change of depth to the next pixel on the triangle's plane and `step` of a pixel beyond it, m.
    double slope(std::size_t i, double step) const {
        if (!depth_ || !position_ || !normal_ || *depth_->pixel(i) <= 0) return 0;
        const glm::dvec3 n = glm::make_vec3(normal_->pixel(i)), p = glm::make_vec3(position_->pixel(i));
        const double z = *depth_->pixel(i), pixel = z / pixelsPerRadian(frame_, i);
        double facing = 0;
        for (int c = 0; c < 3; ++c) facing += n[c] * (frame_.camera.fov_degrees > 0 ? p[c] / z : forward_[c]);
        const double across = pixel * (std::abs(glm::dot(n, right_)) + std::abs(glm::dot(n, up_)));
        const double left = std::abs(facing) - step * across / z;
        return left > 0 ? across / left : std::numeric_limits<double>::infinity();
    }

private:
    static glm::dvec3 normalized(const glm::dvec3& v) {
        const double length = std::hypot(v.x, v.y, v.z);
        return length > 0 ? v / length : glm::dvec3(0);
    }

    const Frame& frame_;
    const Image *depth_, *position_, *normal_;
    glm::dvec3 forward_, right_, up_;
};

}  // namespace

double stepOf(const std::array<DevicePrecision, 2>& devices, unsigned DevicePrecision::*bits) {
    return std::ldexp(1.0, -static_cast<int>(devices[0].*bits)) +
           std::ldexp(1.0, -static_cast<int>(devices[1].*bits));
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
    const double step = stepOf(pair.across->devices, &DevicePrecision::sub_pixel_bits);
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
            if (both([&](const SurfaceAround& of) { return of.normalAngle(i, j) <= facet; })) triangle |= bit;
            if (depth) shown = std::max(shown, metrics::distance(*depth->pixel(i), *depth->pixel(j)));
        });
        surface[i] = static_cast<std::uint8_t>(same);
        material[i] = static_cast<std::uint8_t>(alike);
        narrow[i] = (triangle & across_bits) == 0 || (triangle & down_bits) == 0 ? 1 : 0;
        if (shown > 0) steeper[i] = static_cast<float>(std::max(1.0, steepness.slope(i, step) / shown));
    });
}

}  // namespace diptych
