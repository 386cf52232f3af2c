// SPDX-License-Identifier: MIT
#include "shared/scene/lights/environment_sun.h"

#include "shared/scene/model/luminance.h"

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <numbers>
#include <optional>
#include <queue>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

namespace diptych {
namespace {

using std::numbers::pi;
using Texels = std::vector<std::size_t>;

// The image as texels by linear index: adjacency, solid angle and luminance.
class SkyTexels {
public:
    explicit SkyTexels(const Image& image) : image_(image) {
        for (int y = 0; y < image.height; ++y) {
            const double row = 2 * pi / image.width *
                               (std::cos(pi * y / image.height) - std::cos(pi * (y + 1) / image.height));
            solid_.push_back(row);
            for (int x = 0; x < image.width; ++x) all_ += row * light(index(x, y));
        }
    }

    const Image& image() const { return image_; }
    double all() const { return all_; }  // luminance integrated over all directions, W/m^2
    double solid(std::size_t i) const { return solid_[static_cast<std::size_t>(row(i))]; }  // sr
    double light(std::size_t i) const { return luminance(color(i)); }
    glm::dvec3 color(std::size_t i) const {
        const float* p = image_.pixel(i);
        return {double{p[0]}, double{p[1]}, double{p[2]}};
    }
    int column(std::size_t i) const { return static_cast<int>(i % static_cast<std::size_t>(image_.width)); }
    int row(std::size_t i) const { return static_cast<int>(i / static_cast<std::size_t>(image_.width)); }

    // Columns wrap around. Rows beyond a pole are reflected and rotated by half a turn.
    std::size_t index(int x, int y) const {
        const int width = image_.width, height = image_.height;
        if (y < 0 || y >= height) {
            y = std::clamp(y < 0 ? -1 - y : 2 * height - 1 - y, 0, height - 1);
            x += width / 2;
        }
        x = (x % width + width) % width;
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
    }
    // The texel and its eight neighbours; a narrow image may repeat some.
    std::array<std::size_t, 9> around(std::size_t i) const {
        std::array<std::size_t, 9> result{};
        for (int k = 0; k < 9; ++k)
            result[static_cast<std::size_t>(k)] = index(column(i) + k % 3 - 1, row(i) + k / 3 - 1);
        return result;
    }
    // x, y in texels.
    glm::dvec3 direction(double x, double y) const {
        const double azimuth = 2 * pi * x / image_.width - pi, polar = pi * y / image_.height;
        return {std::sin(polar) * std::sin(azimuth), std::cos(polar), -std::sin(polar) * std::cos(azimuth)};
    }

private:
    const Image& image_;
    std::vector<double> solid_;  // per row
    double all_ = 0;
};

struct Spot {
    Texels texels;
    double light = 0;  // luminance times solid angle
};

// Flood fill from `first` over texels at least as bright as `min`; marks them.
Texels connected(const SkyTexels& sky, std::size_t first, double min, std::vector<bool>& marked) {
    Texels found{first};
    marked[first] = true;
    for (std::size_t next = 0; next < found.size(); ++next)
        for (const std::size_t i : sky.around(found[next]))
            if (!marked[i] && sky.light(i) >= min) {
                marked[i] = true;
                found.push_back(i);
            }
    return found;
}

// The largest region around the brightest of `texels` that a brightness level encloses and that is no
// larger than a sun. Empty if it does not fall off enough. Texels are visited by brightness. When all
// visited ones are at least as bright as a level, they are the connected region above it.
Texels peakOf(const SkyTexels& sky, const Texels& texels) {
    const std::size_t peak = *std::ranges::max_element(texels, {}, [&](auto i) { return sky.light(i); });
    using Entry = std::pair<double, std::size_t>;
    std::priority_queue<Entry> edge;
    std::unordered_set<std::size_t> reached{peak};
    edge.emplace(sky.light(peak), peak);
    Texels visited;
    std::size_t closed = 0;  // number of texels above the level
    double level = sky.light(peak), above = level, solid = 0;
    while (!edge.empty()) {
        const auto [light, i] = edge.top();
        edge.pop();
        if (light < level) {
            closed = visited.size();
            above = level;
            level = light;
        }
        visited.push_back(i);
        solid += sky.solid(i);
        if (solid > sun_spot::largestSolidAngle) break;
        for (const std::size_t next : sky.around(i))
            if (reached.insert(next).second) edge.emplace(sky.light(next), next);
    }
    if (closed == 0 || above * sun_spot::minFall > sky.light(peak)) return {};
    visited.resize(closed);
    return visited;
}

// Candidate spots, the one with the most light first.
std::vector<Spot> spotsOf(const SkyTexels& sky) {
    const double min = sun_spot::minContrast * sky.all() / (4 * pi);
    std::vector<bool> marked(sky.image().pixels(), false);
    std::vector<Spot> spots;
    for (std::size_t i = 0; i < sky.image().pixels(); ++i) {
        if (marked[i] || !(sky.light(i) >= min) || !(min > 0)) continue;
        Spot spot{connected(sky, i, min, marked)};
        double solid = 0;
        for (const std::size_t texel : spot.texels) solid += sky.solid(texel);
        if (solid > sun_spot::largestSolidAngle) spot.texels = peakOf(sky, spot.texels);
        for (const std::size_t texel : spot.texels) spot.light += sky.light(texel) * sky.solid(texel);
        if (spot.light >= sun_spot::minFraction * sky.all()) spots.push_back(std::move(spot));
    }
    std::ranges::stable_sort(spots, std::greater(), &Spot::light);
    return spots;
}

// Component-wise median of the texels within two steps of the spot.
glm::dvec3 aroundSpot(const SkyTexels& sky, const Texels& spot) {
    std::unordered_set<std::size_t> seen(spot.begin(), spot.end());
    Texels ring, last = spot;
    for (int step = 0; step < 2; ++step) {
        Texels next;
        for (const std::size_t i : last)
            for (const std::size_t n : sky.around(i))
                if (seen.insert(n).second) next.push_back(n);
        ring.insert(ring.end(), next.begin(), next.end());
        last = std::move(next);
    }
    glm::dvec3 result(0);
    if (ring.empty()) return result;
    for (int c = 0; c < 3; ++c) {
        const auto middle = ring.begin() + static_cast<std::ptrdiff_t>(ring.size() / 2);
        std::ranges::nth_element(ring, middle, {}, [&](std::size_t i) { return sky.color(i)[c]; });
        result[c] = sky.color(*middle)[c];
    }
    return result;
}

// Integrals of an image that is 0 except at some texels, bilinear between their centres.
struct Moments {
    // Integral of the radiance, W/m^2.
    glm::dvec3 power{0};
    glm::dmat3 along{0};  // columns: times x, y, z
};

// Integrates quarters of texels, in which the image is bilinear, by Gauss quadrature with 3 x 3 points.
Moments momentsOf(const SkyTexels& sky, const std::unordered_map<std::size_t, glm::dvec3>& radiance) {
    static constexpr std::array<double, 3> nodes{0.1127016653792583, 0.5, 0.8872983346207417},
        weights{5 / 18.0, 4 / 9.0, 5 / 18.0};
    const auto at = [&](int x, int y) {
        const auto found = radiance.find(sky.index(x, y));
        return found == radiance.end() ? glm::dvec3(0) : found->second;
    };
    const double area = pi / sky.image().height * 2 * pi / sky.image().width / 4;
    Moments sum;
    const auto addQuarter = [&](int x, int y, int right, int down) {
        // The quarter lies between these texel centres.
        const int left = x + right - 1, top = y + down - 1;
        const glm::dvec3 a = at(left, top), b = at(left + 1, top), c = at(left, top + 1),
                         d = at(left + 1, top + 1);
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t j = 0; j < 3; ++j) {
                const double u = x + 0.5 * (right + nodes[i]), v = y + 0.5 * (down + nodes[j]);
                const double fx = u - 0.5 - left, fy = v - 0.5 - top;
                const double sine = std::sin(pi * v / sky.image().height);
                const glm::dvec3 light = ((a * (1 - fx) + b * fx) * (1 - fy) + (c * (1 - fx) + d * fx) * fy) *
                                         (weights[i] * weights[j] * area * sine);
                const glm::dvec3 direction = sky.direction(u, v);
                sum.power += light;
                for (int k = 0; k < 3; ++k) sum.along[k] += light * direction[k];
            }
    };
    std::unordered_set<std::size_t> touched;
    for (const auto& [texel, value] : radiance)
        for (const std::size_t i : sky.around(texel))
            if (touched.insert(i).second)
                for (int quarter = 0; quarter < 4; ++quarter)
                    addQuarter(sky.column(i), sky.row(i), quarter % 2, quarter / 2);
    return sum;
}

// The light of a spot; none if it is not compact.
std::optional<EnvironmentSun> taken(const SkyTexels& sky, const Texels& spot, const glm::dvec3& around) {
    std::unordered_map<std::size_t, glm::dvec3> radiance;
    double light = 0, squared = 0;
    for (const std::size_t i : spot) {
        const glm::dvec3 removed = sky.color(i) - glm::min(sky.color(i), around);
        radiance.emplace(i, removed);
        light += luminance(removed) * sky.solid(i);
        squared += luminance(removed) * luminance(removed) * sky.solid(i);
    }
    const Moments moments = momentsOf(sky, radiance);
    glm::dvec3 mean(0);
    for (int k = 0; k < 3; ++k) mean[k] = luminance(moments.along[k]);
    const double facing = glm::length(mean);
    const double power = luminance(moments.power);
    if (!(facing >= sun_spot::minFacing * power) || !(facing > 0) ||
        power - facing > sun_spot::maxLost * sky.all())
        return {};
    const glm::dvec3 centre = mean / facing;
    const glm::dvec3 irradiance = moments.along * centre;
    EnvironmentSun sun;
    sun.found = true;
    sun.light.name = "sun of the environment";
    sun.light.kind = LightKind::directional;
    sun.light.direction = -centre;
    const double max = std::max({irradiance.r, irradiance.g, irradiance.b});
    sun.light.intensity = static_cast<float>(max);
    sun.light.color = glm::max(irradiance, glm::dvec3(0)) / max;
    // A cap of angular diameter a has the solid angle 4 pi sin^2(a / 4).
    sun.light.angle =
        static_cast<float>(4 * std::asin(std::sqrt(std::min(light * light / squared / (4 * pi), 1.0))));
    sun.fraction = power / sky.all();
    return sun;
}

}  // namespace

EnvironmentSun environmentSun(const Environment& environment) {
    const SkyTexels sky(environment.radiance);
    const std::vector<Spot> spots = spotsOf(sky);
    for (const Spot& spot : spots) {
        const glm::dvec3 around = aroundSpot(sky, spot.texels);
        std::optional<EnvironmentSun> sun = taken(sky, spot.texels, around);
        if (!sun || sun->fraction < sun_spot::minFraction) continue;
        sun->residual = environment;
        for (const std::size_t i : spot.texels) {
            const glm::dvec3 left(glm::min(sky.color(i), around));
            for (int c = 0; c < 3; ++c) sun->residual.radiance.pixel(i)[c] = static_cast<float>(left[c]);
        }
        return std::move(*sun);
    }
    EnvironmentSun none;
    none.why = fmt::format(
        "no compact spot of at most {} sr is {:g} times as bright as the mean and has {:g} % of the light",
        sun_spot::largestSolidAngle, sun_spot::minContrast, 100 * sun_spot::minFraction);
    return none;
}

Light rotatedSun(const Light& light, double degrees, double factor) {
    const double turn = glm::radians(degrees), c = std::cos(turn), s = std::sin(turn);
    const glm::dvec3& d = light.direction;
    Light result = light;
    result.direction = {c * d.x + s * d.z, d.y, c * d.z - s * d.x};
    result.intensity = static_cast<float>(double{light.intensity} * factor);
    return result;
}

std::string describe(const Light& sun, double fraction) {
    const glm::dvec3 irradiance = glm::dvec3(sun.color) * double{sun.intensity};
    const glm::dvec3 to_light = glm::round(-1000.0 * sun.direction) / 1000.0 + 0.0;  // avoids -0
    return fmt::format(
        "of {:.3g} degrees towards ({:.3f}, {:.3f}, {:.3f}), {:.4g} lux ({:.4g}, {:.4g}, {:.4g}), {:.3g} % "
        "of the environment's light",
        glm::degrees(double{sun.angle}), to_light.x, to_light.y, to_light.z, luminance(irradiance),
        irradiance.r, irradiance.g, irradiance.b, 100 * fraction);
}

}  // namespace diptych
