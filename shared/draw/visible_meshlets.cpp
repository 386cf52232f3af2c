// SPDX-License-Identifier: MIT
#include "shared/draw/visible_meshlets.h"

#include "shared/contract/samples.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace diptych {

namespace {

// Relative error bound of a shader's matrix-vector product, as a fraction of the sum of its terms'
// absolute values. The rounded matrix, three products and three sums contribute 2^-24 each. Doubled.
constexpr double productError = 14.0 / (1 << 24);
// The same for a window position, as a fraction of the image size: a division, a product and a sum.
constexpr double positionRounding = 8.0 / (1 << 24);
// For MeshletTriangles::facing(): four products of rounded factors and three sums.
constexpr double facingError = 16.0 / (1 << 24);

// Whether an interval contains the sample at `location`, in pixels from a pixel's left or upper edge, of any
// pixel.
bool holdsSample(double low, double high, double location) {
    return std::floor(high - location) >= std::ceil(low - location);
}

bool holdsSample(double low, double high, int samples, int shift) {
    if (samples <= 1) return holdsSample(low, high, 0.5);
    for (int i = 0; i < samples; ++i) {
        unsigned location = 0;
        if (samples == 4)
            location = gpu::SAMPLE_LOCATIONS_4 >> (8 * i);
        else if (samples == 8)
            location = (i < 4 ? gpu::SAMPLE_LOCATIONS_8_LOW : gpu::SAMPLE_LOCATIONS_8_HIGH) >> (8 * (i % 4));
        else
            return true;
        if (holdsSample(low, high, ((location >> shift) & 15u) / 16.0)) return true;
    }
    return false;
}

}  // namespace

double positionError(const SampleGrid& grid) {
    return positionRounding * std::max(grid.width, grid.height);
}

VisibleMeshlets::VisibleMeshlets(const SampleGrid& grid, const glm::dmat4& clip_from_object,
                                 const glm::dvec3& min, const glm::dvec3& max, bool culls_backs,
                                 bool mirrored)
    : grid_(grid),
      rows_(glm::transpose(clip_from_object)),
      error_(0),
      culls_backs_(culls_backs),
      mirrored_(mirrored) {
    const glm::dvec3 farthest = glm::max(glm::abs(min), glm::abs(max));
    for (int c = 0; c < 4; ++c)
        error_[c] =
            productError * (glm::dot(glm::abs(glm::dvec3(rows_[c])), farthest) + std::abs(rows_[c].w));
    const glm::dvec3 middle = (min + max) * 0.5, half = (max - min) * 0.5;
    const auto side = [&](std::size_t i, const glm::dvec4& inside, double slack) {
        const glm::dvec3 normal(inside);
        sides_[i] = {normal, glm::abs(normal), inside.w, slack};
    };
    side(0, rows_[3] + rows_[0], error_.x + error_.w);
    side(1, rows_[3] - rows_[0], error_.x + error_.w);
    side(2, rows_[3] + rows_[1], error_.y + error_.w);
    side(3, rows_[3] - rows_[1], error_.y + error_.w);
    side(4, rows_[3] - rows_[2], error_.z + error_.w);
    side(5, rows_[2], error_.z);
    within_ = std::ranges::all_of(sides_, [&](const Side& s) {
        return glm::dot(s.normal, middle) - glm::dot(s.size, half) + s.w >= s.slack;
    });
    const double across = 0.5 * grid.width, down = 0.5 * grid.height;
    const glm::dvec3 x(rows_[0]), y(rows_[1]), w(rows_[3]);
    pixels_.x = across * (glm::length(x) + glm::length(w));
    pixels_.y = down * (glm::length(y) + glm::length(w));
    pixels_.z = std::hypot(pixels_.x, pixels_.y);
    // The eye is where x, y and w are 0: at infinity if w is constant.
    eye_at_infinity_ = w == glm::dvec3(0);
    double volume = 0;
    if (eye_at_infinity_) {
        const glm::dvec3 along = glm::cross(x, y);
        volume = glm::length(along);
        // Depth is reversed: z grows towards the eye.
        eye_ = along * ((glm::dot(along, glm::dvec3(rows_[2])) < 0 ? -1.0 : 1.0) / volume);
        volume *= std::abs(rows_[3].w);
    } else {
        const glm::dmat3 linear = glm::transpose(glm::dmat3(x, y, w));
        volume = std::abs(glm::determinant(linear));
        eye_ = -(glm::inverse(linear) * glm::dvec3(rows_[0].w, rows_[1].w, rows_[3].w));
    }
    area_scale_ = across * down * volume;
    const auto finite = [](const glm::dvec3& v) {
        return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
    };
    faces_ = culls_backs && area_scale_ > 0 && std::isfinite(area_scale_) && finite(eye_);
}

bool VisibleMeshlets::isBetweenSamples(const Meshlet& meshlet, double nearest, double off) const {
    const glm::dvec3 size = glm::dvec3(meshlet.max) - glm::dvec3(meshlet.min);
    // Geometry between samples is less than a pixel wide or high, so larger boxes are not tested.
    if (!(glm::length(size) * std::min(pixels_.x, pixels_.y) < 4 * nearest)) return false;
    glm::dvec2 low(std::numeric_limits<double>::infinity()), high(-low);
    for (unsigned corner = 0; corner < 8; ++corner) {
        const glm::dvec4 p(double{(corner & 1u) != 0 ? meshlet.max.x : meshlet.min.x},
                           double{(corner & 2u) != 0 ? meshlet.max.y : meshlet.min.y},
                           double{(corner & 4u) != 0 ? meshlet.max.z : meshlet.min.z}, 1.0);
        const double w = glm::dot(rows_[3], p);
        const glm::dvec2 at((glm::dot(rows_[0], p) / w + 1) * 0.5 * grid_.width,
                            (glm::dot(rows_[1], p) / w + 1) * 0.5 * grid_.height);
        low = glm::min(low, at);
        high = glm::max(high, at);
    }
    return !holdsSample(low.x - off, high.x + off, grid_.samples, 0) ||
           !holdsSample(low.y - off, high.y + off, grid_.samples, 4);
}

double VisibleMeshlets::positionErrorOf(double nearest) const {
    return positionError(grid_) +
           0.5 * std::max(grid_.width * (error_.x + error_.w), grid_.height * (error_.y + error_.w)) /
               nearest;
}

TriangleSet VisibleMeshlets::of(const Meshlet& meshlet, const MeshletTriangles& triangles,
                                const MeshletTriangles::Entry& entry) const {
    const glm::dvec3 middle = middleOf(meshlet), half = glm::dvec3(meshlet.max) - middle;
    bool within = within_;
    if (!within) {
        within = true;
        for (const Side& side : sides_) {
            const double at = glm::dot(side.normal, middle) + side.w, extent = glm::dot(side.size, half);
            if (at + extent < -side.slack) return 0;
            within = within && at - extent >= side.slack;
        }
        // Clipping creates other corners, which may lie on the lines between samples.
        if (!within) return entry.all();
    }
    const glm::dvec3 w(rows_[3]);
    const double deep = glm::dot(glm::abs(w), half), at = glm::dot(w, middle) + rows_[3].w,
                 nearest = at - deep - error_.w, farthest = at + deep;
    if (!(nearest > 0)) return entry.all();
    const double placed = positionErrorOf(nearest), off = grid_.snap + placed;
    if (isBetweenSamples(meshlet, nearest, off)) return 0;
    TriangleSet set = entry.all();
    if (!(entry.largest_circle > 0)) return set;
    if (faces_) {
        // Corners off by at most `wide` pixels change the doubled area of a triangle on screen by at most
        // wide * perimeter + 3 wide^2. Triangles with a smaller area may still show their front. The area
        // is area_scale_ / w^3 * r * perimeter * distance from the plane, with perimeter and distance in
        // object space. facing() computes r * distance.
        const double wide = std::sqrt(2.0) * off;
        const double area = wide * (pixels_.z / nearest + 3 * wide / double{entry.shortest_perimeter});
        const glm::dvec3 eye = eye_at_infinity_ ? eye_ : eye_ - middle;
        const double behind =
            area * farthest * farthest * farthest / area_scale_ +
            facingError * double{entry.largest_circle} * (glm::length(eye) + double{entry.radius});
        const auto min = static_cast<float>(-behind * (1 + 1e-6));
        set = triangles.facing(entry, glm::vec3(eye), eye_at_infinity_ ? 0.0f : 1.0f, min);
    }
    // Inradius in pixels, overestimated by pixels_ by up to 2.5 times. Larger triangles nearly always
    // cover a sample.
    constexpr double small = 6;
    if (grid_.samples > 1 || !(double{entry.largest_circle} * pixels_.z < small * nearest)) return set;
    MeshletTriangles::Projection projection;
    const auto row = [&](int r, double scale) {
        return glm::vec4(scale * glm::dvec4(glm::dvec3(rows_[r]), glm::dot(rows_[r], glm::dvec4(middle, 1))));
    };
    projection.x = row(0, 0.5 * grid_.width);
    projection.y = row(1, 0.5 * grid_.height);
    projection.w = row(3, 1);
    projection.half = {0.5f * static_cast<float>(grid_.width), 0.5f * static_cast<float>(grid_.height)};
    projection.off = static_cast<float>(off + placed);  // includes the rounding of this test
    projection.either_side = !culls_backs_;
    projection.clockwise = mirrored_;
    return triangles.covering(entry, set, projection);
}

}  // namespace diptych
