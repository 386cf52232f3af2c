// SPDX-License-Identifier: MIT
#include "shared/image/primaries.h"

#include "shared/image/srgb.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>

namespace diptych {
namespace {

constexpr Primaries rec709{0.64, 0.33, 0.30, 0.60, 0.15, 0.06, 0.3127, 0.3290};

// X, Y, Z for Y = 1.
glm::dvec3 xyzOf(const Primaries& primaries, std::size_t color) {
    const double x = primaries[2 * color], y = primaries[2 * color + 1];
    return {x / y, 1, (1 - x - y) / y};
}

// SMPTE RP 177-1993: the columns are the primaries, scaled so that their sum is the white point.
glm::dmat3 xyzFromRgb(const Primaries& primaries) {
    const glm::dmat3 columns(xyzOf(primaries, 0), xyzOf(primaries, 1), xyzOf(primaries, 2));
    const glm::dvec3 scale = glm::inverse(columns) * xyzOf(primaries, 3);
    return {columns[0] * scale.r, columns[1] * scale.g, columns[2] * scale.b};
}

glm::dmat3 adapted(const glm::dvec3& from, const glm::dvec3& to) {
    const glm::dmat3 cones(0.8951, -0.7502, 0.0389, 0.2664, 1.7135, -0.0685, -0.1614, 0.0367, 1.0296);
    const glm::dvec3 gain = (cones * to) / (cones * from);
    return glm::inverse(cones) * glm::dmat3(gain.x, 0, 0, 0, gain.y, 0, 0, 0, gain.z) * cones;
}

double mirrored(double (*curve)(double), double value) {
    return std::copysign(curve(std::abs(value)), value);
}

}  // namespace

std::optional<glm::dmat3> matrixToRec709(const Primaries& primaries, FileNotes& notes) {
    const std::string text =
        fmt::format("the primaries x, y {:.4f} (red, green, blue, white)", fmt::join(primaries, " "));
    const glm::dmat3 matrix = glm::inverse(xyzFromRgb(rec709)) *
                              adapted(xyzOf(primaries, 3), xyzOf(rec709, 3)) * xyzFromRgb(primaries);
    // The matrix is singular if the primaries are collinear or have zero luminance.
    constexpr double largest = 1e6;
    for (int i = 0; i < 9; ++i)
        if (!(std::abs(matrix[i / 3][i % 3]) < largest)) {
            notes.not_applied.push_back(text + " do not span a colour space; Rec. 709 is assumed");
            return {};
        }
    // Four digits of 0.06, the smallest coordinate of Rec. 709, cause such an error; so does adaptation to
    // D50.
    constexpr double rounding = 1e-3;
    double max = 0;
    for (int i = 0; i < 9; ++i) max = std::max(max, std::abs(matrix[i / 3][i % 3] - (i / 3 == i % 3)));
    if (max <= rounding) return {};
    notes.lines.push_back("its colours were converted from " + text + " to Rec. 709's");
    return matrix;
}

void convertColors(Image& image, const glm::dmat3& matrix, bool encoded) {
    constexpr double largest = std::numeric_limits<float>::max();
    for (std::size_t i = 0; i < image.pixels(); ++i) {
        float* const pixel = image.pixel(i);
        glm::dvec3 color(pixel[0], pixel[1], pixel[2]);
        if (!std::isfinite(color.r + color.g + color.b)) continue;
        for (int c = 0; encoded && c < 3; ++c) color[c] = mirrored(linearFromSrgb, color[c]);
        color = matrix * color;
        for (int c = 0; c < 3; ++c)
            pixel[c] = static_cast<float>(
                std::clamp(encoded ? mirrored(encodedBySrgb, color[c]) : color[c], -largest, largest));
    }
}

void noteAspect(double aspect, FileNotes& notes) {
    // Tolerance for resolutions that are rounded to dots per inch.
    constexpr double rounding = 1e-3;
    if (std::isfinite(aspect) && aspect > 0 && std::abs(aspect - 1) > rounding)
        notes.not_applied.push_back(
            fmt::format("its pixels are not square (aspect {:.4g}) but are shown square", aspect));
}

void noteProfile(std::string_view profile, std::string_view taken_as, FileNotes& notes) {
    const auto mark = static_cast<std::uint32_t>(std::hash<std::string_view>()(profile));
    notes.not_applied.push_back(
        fmt::format("its colour profile ({} bytes, {:08x}) is not applied; its values are read as {}",
                    profile.size(), mark, taken_as));
}

}  // namespace diptych
