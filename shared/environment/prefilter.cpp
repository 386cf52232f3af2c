// SPDX-License-Identifier: MIT
#include "shared/environment/prefilter.h"

#include "shared/contract/constants.h"
#include "shared/contract/environment.h"

#include <tbb/parallel_for.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>

namespace diptych {

namespace {

constexpr int minSamples = 32;
// Cells per side of the widest lobe. With 12, dark areas next to a bright horizon had errors of up to 9 %.
constexpr int minNodes = 24;

// Light direction about the normal +Z, its weight, and the pyramid level to read, for texels of the solid
// angle at the centre of the square.
struct LobeSample {
    glm::vec3 direction;
    float weight, level;
};

// Half vectors distributed by D n.h (Walter et al. 2007, equation 35), from Hammersley points (van der
// Corput's radical inverse in base 2).
std::vector<LobeSample> lobeSamples(double alpha, int count, float bias, int sourceSide) {
    std::vector<LobeSample> samples;
    const double alpha2 = alpha * alpha, texel = 4.0 / sourceSide / sourceSide;
    for (int i = 0; i < count; ++i) {
        const double u = (i + 0.5) / count;
        std::uint32_t bits = 0;
        for (int bit = 0; bit < 32; ++bit) bits |= (static_cast<std::uint32_t>(i) >> bit & 1u) << (31 - bit);
        const double phi = 2 * std::numbers::pi * (bits * 0x1p-32 + 0.5 / count);
        const double c2 = (1 - u) / (1 + (alpha2 - 1) * u), cosine = 2 * c2 - 1;  // n.h^2, n.l
        if (!(cosine > 0)) continue;
        const double sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
        const double k = c2 * (alpha2 - 1) + 1, density = alpha2 / (4 * std::numbers::pi * k * k);
        const double solid = 1 / (count * density);
        samples.push_back({glm::vec3(sine * std::cos(phi), sine * std::sin(phi), cosine),
                           static_cast<float>(cosine),
                           static_cast<float>(0.5 * std::log2(solid / texel)) + bias});
    }
    // The only sample of the widest lobe lies on the horizon; the normal replaces it.
    if (samples.empty())
        samples.push_back(
            {{0, 0, 1}, 1, static_cast<float>(0.5 * std::log2(std::numbers::pi / texel)) + bias});
    return samples;
}

// Duff et al. 2017, "Building an Orthonormal Basis, Revisited".
struct LobeFrame {
    glm::vec3 x, y, z;
    explicit LobeFrame(const glm::vec3& n) : z(n) {
        const float sign = n.z >= 0 ? 1.0f : -1.0f, a = -1 / (sign + n.z), b = n.x * n.y * a;
        x = {1 + sign * n.x * n.x * a, sign * b, -sign * n.x};
        y = {b, sign + n.y * n.y * a, -n.y};
    }
    glm::vec3 world(const glm::vec3& v) const { return x * v.x + y * v.y + z * v.z; }
};

// log2 on 1 to sqrt(3), within 2e-3; precise enough to blend levels.
float smallLog2(float x) {
    const float t = x - 1;
    return t * (1.42f - t * (0.56f - 0.155f * t));
}

Texel trilinear(const std::vector<OctahedralMap>& source, glm::vec2 position, float level) {
    const float clamped = std::clamp(level, 0.0f, static_cast<float>(source.size() - 1));
    const auto lower = static_cast<std::size_t>(clamped);
    const float between = clamped - static_cast<float>(lower);
    const Texel fine = source[lower].bilinear(position);
    if (lower + 1 == source.size()) return fine;
    return fine + (source[lower + 1].bilinear(position) - fine) * between;
}

template <class F>
NodeMap mapOf(int side, const F& f) {
    NodeMap map(side);
    tbb::parallel_for(0, side, [&](int y) {
        for (int x = 0; x < side; ++x) map.at(x, y) = f(octahedralDirection(map.positionOf(x, y)));
    });
    return map;
}

// Weighted mean over all texels of `source`; the weight is `kernel` of the cosine to a direction.
template <class Kernel>
NodeMap summed(const OctahedralMap& source, int side, const Kernel& kernel) {
    struct Part {
        glm::vec3 direction;
        float solid;
        Texel radiance;
    };
    std::vector<Part> parts;
    for (int y = 0; y < source.side; ++y)
        for (int x = 0; x < source.side; ++x)
            parts.push_back({octahedralDirection(source.positionOf(x, y)),
                             static_cast<float>(source.solidAngle(x, y)), source.at(x, y)});
    return mapOf(side, [&](const glm::vec3& n) {
        Texel sum{};
        float weights = 0;
        for (const Part& part : parts) {
            const float weight = kernel(glm::dot(n, part.direction)) * part.solid;
            sum += part.radiance * weight;
            weights += weight;
        }
        return sum / weights;
    });
}

}  // namespace

NodeMap filtered(const std::vector<OctahedralMap>& source, double alpha, int side,
                 const FilterQuality& quality) {
    // At most twice as many samples as the source has texels under the lobe, about 4 pi alpha^2; more
    // would read the same ones. With half as many, a lobe of roughness 0.15 had 1.6 times the error.
    const int max = source.front().side, texels = static_cast<int>(2 * alpha * alpha * max * max);
    const std::vector<LobeSample> samples =
        lobeSamples(alpha, std::min(quality.samples, std::max(texels, minSamples)), quality.bias, max);
    return mapOf(side, [&](const glm::vec3& n) {
        const LobeFrame frame(n);
        Texel sum{};
        float weights = 0;
        for (const LobeSample& sample : samples) {
            const glm::vec3 d = frame.world(sample.direction);
            const float l1 = std::abs(d.x) + std::abs(d.y) + std::abs(d.z);
            sum +=
                trilinear(source, octahedralPosition(d), sample.level - 1.5f * smallLog2(l1)) * sample.weight;
            weights += sample.weight;
        }
        return sum / weights;
    });
}

std::vector<BrightTexel> takeBrightTexels(OctahedralMap& map) {
    const auto brightness = [](const Texel& t) { return std::max({t[0], t[1], t[2]}); };
    double mean = 0, whole = 0;
    struct Bright {
        float brightness;
        int x, y;
    };
    std::vector<Bright> found;
    for (int y = 0; y < map.side; ++y)
        for (int x = 0; x < map.side; ++x) {
            const double solid = map.solidAngle(x, y);
            mean += double{brightness(map.at(x, y))} * solid;
            whole += solid;
        }
    auto bound = static_cast<float>(8 * mean / whole);
    for (int y = 0; y < map.side; ++y)
        for (int x = 0; x < map.side; ++x)
            if (brightness(map.at(x, y)) > bound) found.push_back({brightness(map.at(x, y)), x, y});
    std::ranges::stable_sort(found, std::greater(), &Bright::brightness);
    if (found.size() > maxBrightTexels) {
        bound = found[maxBrightTexels].brightness;
        found.resize(maxBrightTexels);
    }
    std::vector<BrightTexel> taken;
    for (const Bright& bright : found) {
        Texel& t = map.at(bright.x, bright.y);
        const Texel above = t * (1 - bound / bright.brightness);
        taken.push_back({octahedralDirection(map.positionOf(bright.x, bright.y)),
                         above * static_cast<float>(map.solidAngle(bright.x, bright.y))});
        t -= above;
    }
    map.fillBorder();
    return taken;
}

void addBrightTexels(NodeMap& filtered, const std::vector<BrightTexel>& texels, double alpha) {
    if (texels.empty()) return;
    // Integral of the lobe over n.h^2 = (1 + n.l) / 2, from 4096 midpoints of its cumulative density.
    double sum = 0;
    constexpr int points = 4096;
    const double alpha2 = alpha * alpha;
    for (int i = 0; i < points; ++i) {
        const double u = (i + 0.5) / points, cosine = 2 * (1 - u) / (1 + (alpha2 - 1) * u) - 1;
        sum += std::max(cosine, 0.0);
    }
    const auto a2 = static_cast<float>(alpha2);
    const auto scale = static_cast<float>(alpha2 / (4 * std::numbers::pi) / (sum / points));
    tbb::parallel_for(0, filtered.side, [&](int y) {
        for (int x = 0; x < filtered.side; ++x) {
            const glm::vec3 n = octahedralDirection(filtered.positionOf(x, y));
            for (const BrightTexel& texel : texels) {
                // 1 - n.h^2 equals |n - l|^2 / 4, which avoids cancellation near the peak.
                const glm::vec3 apart = n - texel.direction;
                const float sine2 = 0.25f * glm::dot(apart, apart), n_dot_l = 1 - 2 * sine2;
                if (!(n_dot_l > 0)) continue;
                const float k = a2 + sine2 * (1 - a2);
                filtered.at(x, y) += texel.power * (scale * n_dot_l / (k * k));
            }
        }
    });
}

NodeMap filteredExhaustively(const OctahedralMap& source, double alpha, int side) {
    const auto a2 = static_cast<float>(alpha * alpha);
    return summed(source, side, [a2](float n_dot_l) {
        // n.h^2 = (1 + n.l) / 2 for a viewer at n; D / 4 is the density of l.
        const float k = 0.5f * (1 + n_dot_l) * (a2 - 1) + 1;
        return n_dot_l > 0 ? n_dot_l * a2 / (k * k) : 0;
    });
}

NodeMap irradiance(const OctahedralMap& source, int side, const std::vector<BrightTexel>& bright) {
    NodeMap map = summed(source, side, [](float n_dot_l) { return std::max(n_dot_l, 0.0f); });
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x)
            for (const BrightTexel& texel : bright)
                map.at(x, y) +=
                    texel.power *
                    (gpu::INVERSE_PI *
                     std::max(glm::dot(octahedralDirection(map.positionOf(x, y)), texel.direction), 0.0f));
    return map;
}

double levelAlpha(std::size_t level) {
    if (level == 0) return double{gpu::MIN_PERCEPTUAL_ROUGHNESS} * double{gpu::MIN_PERCEPTUAL_ROUGHNESS};
    return double{gpu::ENVIRONMENT_FIRST_ALPHA} *
           std::exp2(static_cast<double>(level - 1) / gpu::ENVIRONMENT_LEVELS_AN_OCTAVE);
}

// The lobe of a point light at distance x is (1 + (x / 2 alpha)^2)^-2. Bilinear interpolation over texels
// of size h has an error of h^2 / (8 alpha^2) of the peak: 1.6 % with 10 / alpha texels per side.
int levelSide(std::size_t level, int max) {
    if (level == 0) return max + 1;
    const auto wanted = static_cast<int>(std::ceil(5 / levelAlpha(level)));
    return std::min(std::max(2 * wanted, minNodes), max) + 1;
}

}  // namespace diptych
