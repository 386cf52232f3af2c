// SPDX-License-Identifier: MIT
// The confidence interval of a mean of independent estimates, and the sample points.
#include "compare/reference/scattering/sampling.h"

#include "compare/reference/scattering/lobe_sampler.h"
#include "compare/reference/scattering/sheen.h"
#include "tests/support/reference_builder.h"

#include <set>

namespace diptych::reference {
namespace {

Reflected diffuseOf(const glm::dvec3& value) {
    Reflected reflected;
    reflected.diffuse = value;
    return reflected;
}

// Probability that Student's distribution is between -t and t: its density integrated by Simpson's rule.
double studentWithin(double t, int freedom) {
    const double n = freedom;
    const double scale = std::exp(std::lgamma((n + 1) / 2) - std::lgamma(n / 2)) / std::sqrt(n * pi);
    const auto density = [&](double x) { return scale * std::pow(1 + x * x / n, -(n + 1) / 2); };
    constexpr int steps = 20000;
    double sum = density(0) + density(t);
    for (int i = 1; i < steps; ++i) sum += (i % 2 == 1 ? 4 : 2) * density(t * i / steps);
    return 2 * sum * t / (3 * steps);
}

// Alternately 1 - 0.25 and 1 + 0.25 in green, less in the others. The table has t to four digits.
TEST(ReferenceSampling, TheIntervalIsStudentsOf95Percent) {
    for (int count = 2; count <= 40; ++count) {
        Rounds rounds;
        double mean = 0, squares = 0;
        const auto green = [](int i) { return 1 + (i % 2 == 0 ? -0.25 : 0.25); };
        for (int i = 0; i < count; ++i) {
            rounds.add(diffuseOf({1, green(i), 1 + (green(i) - 1) / 4}));
            mean += green(i) / count;
        }
        for (int i = 0; i < count; ++i) squares += (green(i) - mean) * (green(i) - mean);
        const int freedom = count - 1;
        const double error = std::sqrt(squares / freedom / count);
        const double within = studentWithin(rounds.halfWidth() / error, freedom);
        EXPECT_NEAR(rounds.mean().diffuse.g, mean, 1e-12);
        EXPECT_NEAR(within, freedom <= 15 ? 0.95 : 0.951, freedom <= 15 ? 1e-4 : 1.1e-3) << freedom;
        EXPECT_GT(within, 0.9499) << freedom;
    }
}

// The table of t has 2.364624 for 7 degrees of freedom at 95 %.
TEST(ReferenceSampling, TheSurerIntervalIsStudentsOf99Point9Percent) {
    EXPECT_NEAR(studentWithin(surerThan95 * 2.364624, 7), 0.999, 2e-5);
}

TEST(ReferenceSampling, OneEstimateSaysNothingOfItsError) {
    Rounds rounds;
    EXPECT_EQ(rounds.halfWidth(), std::numeric_limits<double>::infinity());
    rounds.add(diffuseOf({1, 1, 1}));
    EXPECT_EQ(rounds.halfWidth(), std::numeric_limits<double>::infinity());
    rounds.add(diffuseOf({1, 1, 1}));
    EXPECT_EQ(rounds.halfWidth(), 0);
}

// Opposite errors of the two lobes cancel in their sum.
TEST(ReferenceSampling, TheErrorIsOfBothLobesTogether) {
    Rounds rounds;
    for (const double more : {0.25, -0.25, 0.125}) {
        Reflected estimate;
        estimate.diffuse = glm::dvec3(1 + more);
        estimate.specular = glm::dvec3(1 - more);
        rounds.add(estimate);
    }
    EXPECT_NEAR(rounds.halfWidth(), 0, 1e-12);
}

// In every run of n points, each half and each quarter of the square gets its share.
TEST(ReferenceSampling, PointsAreSpreadEvenly) {
    for (const std::uint64_t first : {0u, 1000u})
        for (const glm::dvec2& shift : {glm::dvec2(0), glm::dvec2(0.7, 0.9)}) {
            constexpr int points = 256;
            int west = 0, south = 0, both = 0;
            for (std::uint64_t i = first; i < first + points; ++i) {
                const glm::dvec2 p = evenly(i, shift);
                ASSERT_TRUE(p.x >= 0 && p.x < 1 && p.y >= 0 && p.y < 1) << i;
                west += p.x < 0.5;
                south += p.y < 0.5;
                both += p.x < 0.5 && p.y < 0.5;
            }
            EXPECT_NEAR(west, points / 2, 4);
            EXPECT_NEAR(south, points / 2, 4);
            EXPECT_NEAR(both, points / 4, 8);
        }
}

TEST(ReferenceSampling, StreamsHaveNoNumberInCommon) {
    std::set<double> numbers;
    for (const std::uint64_t seed : {1u, 2u})
        for (std::uint64_t stream = 0; stream < 16; ++stream) {
            Random random(streamOf(seed, stream));
            double mean = 0;
            for (int i = 0; i < 256; ++i) {
                const double value = random();
                ASSERT_TRUE(value >= 0 && value < 1);
                EXPECT_TRUE(numbers.insert(value).second) << seed << " " << stream << " " << i;
                mean += value / 256;
            }
            EXPECT_NEAR(mean, 0.5, 4 * std::sqrt(1.0 / 12 / 256));
        }
}

// Fractions of samples by equal solid angles: rows of the cosine to +Z, columns of the azimuth.
constexpr int histogramRows = 20, histogramColumns = 24;
using Histogram = std::vector<double>;
std::size_t binAround(const glm::dvec3& l) {
    const int band = static_cast<int>((l.z + 1) / 2 * histogramRows),
              column = static_cast<int>((std::atan2(l.y, l.x) / (2 * pi) + 0.5) * histogramColumns);
    return static_cast<std::size_t>(std::clamp(band, 0, histogramRows - 1) * histogramColumns +
                                    std::clamp(column, 0, histogramColumns - 1));
}
bool isBeside(std::size_t a, std::size_t b) {
    const int rows = static_cast<int>(a / histogramColumns) - static_cast<int>(b / histogramColumns),
              columns = static_cast<int>((a + std::size_t{histogramRows} * histogramColumns - b) %
                                         histogramColumns);
    return std::abs(rows) <= 1 && (columns <= 1 || columns == histogramColumns - 1);
}
Histogram drawnBy(const LobeSampler& lobe) {
    Histogram drawn(std::size_t{histogramRows} * histogramColumns);
    constexpr int steps = 512;
    for (int i = 0; i < steps; ++i)
        for (int j = 0; j < steps; ++j)
            drawn[binAround(lobe({(i + 0.5) / steps, (j + 0.5) / steps}))] += 1.0 / (steps * steps);
    return drawn;
}
Histogram saidBy(const LobeSampler& lobe) {
    Histogram said(std::size_t{histogramRows} * histogramColumns);
    constexpr int rows = 30 * histogramRows, columns = 30 * histogramColumns;
    for (int i = 0; i < rows; ++i)
        for (int j = 0; j < columns; ++j) {
            // Denser at the horizon, where a sheen's density is infinite.
            const double t = 2 * (i + 0.5) / rows - 1, z = t * std::abs(t), out = std::sqrt(1 - z * z),
                         turn = 2 * pi * ((j + 0.5) / columns - 0.5);
            const glm::dvec3 l(out * std::cos(turn), out * std::sin(turn), z);
            said[binAround(l)] += lobe.density(l) * 2 * std::abs(t) * 4 * pi / (double{rows} * columns);
        }
    return said;
}

// Every lobe, seen from all sides, also from below a mapped normal.
TEST(ReferenceSampling, EveryLobesDensityIsThatOfItsSamplesAndIntegratesToOne) {
    for (const double roughness : {0.5, 1.0})
        for (const double angle : {0.0, 0.8, 1.4, 1.7})
            for (const double stretched : {0.0, 0.7}) {
                Surface s = mirror(roughness, angle);
                if (stretched > 0) s.stretch(stretched, {0.6, 0.8, 0});
                Surface velvet = s;
                velvet.sheen_color = glm::dvec3(1);
                velvet.sheen_roughness = roughness;
                const bool sheen = stretched > 0 && angle < 1.5;
                const LobeSampler lobe{Brdf(sheen && roughness == 0.5 ? sheenOf(velvet) : s)};
                const Histogram drawn = drawnBy(lobe), said = saidBy(lobe);
                EXPECT_NEAR(std::accumulate(said.begin(), said.end(), 0.0), 1, 0.02)
                    << roughness << " " << angle << " " << stretched;
                for (std::size_t i = 0; i < said.size(); ++i) {
                    // The density is infinite opposite to the viewer, where its sum converges slowly.
                    const bool opposite = isBeside(i, binAround(-s.to_viewer));
                    EXPECT_NEAR(drawn[i], said[i], (opposite ? 0.5 : 0.03) * said[i] + 5e-4)
                        << roughness << " " << angle << " " << stretched << ", bin " << i;
                }
            }
}

}  // namespace
}  // namespace diptych::reference
