// SPDX-License-Identifier: MIT
#include "compare/external/placement.h"

#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace diptych::external {
namespace {

// A mark: centroid, pixels from the image's centre, and area, pixels.
struct Mark {
    glm::dvec2 position{0};
    double area = 0;
};

glm::dvec2 fromMiddle(const Image& image, int x, int y) {
    return {x + 0.5 - image.width / 2.0, y + 0.5 - image.height / 2.0};
}

std::optional<Mark> markOf(const Image& ids, int material) {
    Mark mark;
    for (int y = 0; y < ids.height; ++y)
        for (int x = 0; x < ids.width; ++x)
            if (ids.at(x, y) == static_cast<float>(material)) {
                mark.position += fromMiddle(ids, x, y);
                ++mark.area;
            }
    if (mark.area == 0) return {};
    mark.position /= mark.area;
    return mark;
}

double brightness(const Image& image, int x, int y) {
    double max = 0;
    for (int c = 0; c < std::min(image.components, 3); ++c) {
        const double value = image.at(x, y, c);
        if (std::isfinite(value)) max = std::max(max, value);
    }
    return max;
}

// Pixels around `position` with more than half of the maximum, which also works under a tone curve.
std::optional<Mark> findMark(const Image& image, const glm::dvec2& position, double reach) {
    const glm::dvec2 corner = position + glm::dvec2(image.width, image.height) / 2.0;
    const int left = std::max(0, static_cast<int>(corner.x - reach)),
              right = std::min(image.width, static_cast<int>(corner.x + reach) + 1),
              top = std::max(0, static_cast<int>(corner.y - reach)),
              bottom = std::min(image.height, static_cast<int>(corner.y + reach) + 1);
    double max = 0;
    for (int y = top; y < bottom; ++y)
        for (int x = left; x < right; ++x) max = std::max(max, brightness(image, x, y));
    if (!(max > 1e-6)) return {};
    Mark mark;
    for (int y = top; y < bottom; ++y)
        for (int x = left; x < right; ++x)
            if (brightness(image, x, y) > 0.5 * max) {
                mark.position += fromMiddle(image, x, y);
                ++mark.area;
            }
    mark.position /= mark.area;
    return mark;
}

// Least-squares line b = slope a + offset; slope 1 if all a are equal.
struct Line {
    double slope = 1, offset = 0;
};
Line lineThrough(const std::vector<double>& a, const std::vector<double>& b) {
    const auto n = static_cast<double>(a.size());
    double ma = 0, mb = 0, saa = 0, sab = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        ma += a[i] / n;
        mb += b[i] / n;
    }
    for (std::size_t i = 0; i < a.size(); ++i) {
        saa += (a[i] - ma) * (a[i] - ma);
        sab += (a[i] - ma) * (b[i] - mb);
    }
    const double slope = saa > 0 ? sab / saa : 1;
    return {slope, mb - slope * ma};
}

// Refines `guess` from at least `min` marks. Empty if a mark that must be visible is not found.
std::optional<Placement> fitted(const std::vector<Mark>& marks, const Image& image, const Placement& guess) {
    constexpr std::size_t min = 4;
    std::vector<double> expected_x, expected_y, actual_x, actual_y;
    for (const Mark& mark : marks) {
        const double radius = 1.3 * std::sqrt(mark.area / glm::pi<double>()) * guess.scale.x;
        const double reach = radius + 5;
        const glm::dvec2 position = guess(mark.position);
        if (std::abs(position.x) + reach > image.width / 2.0 ||
            std::abs(position.y) + reach > image.height / 2.0)
            continue;  // may be clipped
        const std::optional<Mark> actual = findMark(image, position, reach);
        const double area = mark.area * guess.scale.x * guess.scale.y;
        if (!actual || actual->area < 0.6 * area || actual->area > 1.6 * area) return {};
        expected_x.push_back(guess.mirrored ? -mark.position.x : mark.position.x);
        expected_y.push_back(guess.upside_down ? -mark.position.y : mark.position.y);
        actual_x.push_back(actual->position.x);
        actual_y.push_back(actual->position.y);
    }
    if (expected_x.size() < min) return {};
    const Line x = lineThrough(expected_x, actual_x), y = lineThrough(expected_y, actual_y);
    Placement found = guess;
    found.scale = {x.slope, y.slope};
    found.shift = {x.offset, y.offset};
    double squares = 0;
    for (std::size_t i = 0; i < expected_x.size(); ++i)
        squares += std::pow(x.slope * expected_x[i] + x.offset - actual_x[i], 2) +
                   std::pow(y.slope * expected_y[i] + y.offset - actual_y[i], 2);
    found.residual = std::sqrt(squares / static_cast<double>(expected_x.size()));
    return found;
}

}  // namespace

std::optional<Placement> findPlacement(const Image& ids, const std::vector<int>& marks, const Image& image) {
    std::vector<Mark> expected;
    for (const int material : marks)
        if (const std::optional<Mark> mark = markOf(ids, material)) expected.push_back(*mark);
    std::optional<Placement> best;
    constexpr double step = 1.02;  // scale step: 4 pixels at the edge of a 400 pixel image
    for (const bool upside_down : {false, true})
        for (const bool mirrored : {false, true})
            for (double scale = 0.5; scale < 2.05; scale *= step) {
                Placement guess{upside_down, mirrored, glm::dvec2(scale), glm::dvec2(0), 0};
                std::optional<Placement> found = fitted(expected, image, guess);
                if (found)
                    found = fitted(expected, image, *found);  // search windows around the refined
                                                              // positions
                if (found && (!best || found->residual < best->residual)) best = found;
            }
    constexpr double max = 1;  // pixels; squares sampled at pixel centres have an error of 0.1
    return best && best->residual < max ? best : std::nullopt;
}

std::optional<glm::dvec3> medianColor(const Image& ids, int material, const Image& image,
                                      const Placement& placement) {
    constexpr int edge = 3;  // pixels that a filter may mix with neighbours
    std::vector<double> values[3];
    const auto isInside = [&](int x, int y) {
        for (int v = -edge; v <= edge; ++v)
            for (int u = -edge; u <= edge; ++u)
                if (x + u < 0 || y + v < 0 || x + u >= ids.width || y + v >= ids.height ||
                    ids.at(x + u, y + v) != static_cast<float>(material))
                    return false;
        return true;
    };
    for (int y = 0; y < ids.height; ++y)
        for (int x = 0; x < ids.width; ++x) {
            if (ids.at(x, y) != static_cast<float>(material) || !isInside(x, y)) continue;
            const glm::dvec2 at =
                placement(fromMiddle(ids, x, y)) + glm::dvec2(image.width, image.height) / 2.0;
            const int px = static_cast<int>(std::floor(at.x)), py = static_cast<int>(std::floor(at.y));
            if (px < 0 || py < 0 || px >= image.width || py >= image.height) continue;
            for (int c = 0; c < 3; ++c)
                values[c].push_back(image.at(px, py, std::min(c, image.components - 1)));
        }
    if (values[0].empty()) return {};
    glm::dvec3 median;
    for (int c = 0; c < 3; ++c) {
        const auto middle = values[c].begin() + static_cast<std::ptrdiff_t>(values[c].size() / 2);
        std::ranges::nth_element(values[c], middle);
        median[c] = *middle;
    }
    return median;
}

}  // namespace diptych::external
