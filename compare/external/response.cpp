// SPDX-License-Identifier: MIT
#include "compare/external/response.h"

#include "shared/image/srgb.h"

#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <span>

namespace diptych::external {
namespace {

constexpr double max_off = 0.06;  // natural logarithm; sRGB and gamma 2.2 differ by 0.1 at 0.02

double medianOf(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::ranges::nth_element(values, middle);
    return *middle;
}

// Pixel values of Rec.709 primaries in other primaries, column by column, for equal white points. Inverse
// of the matrices in external_frame.cpp.
const glm::dmat3 p3_from_rec709{
    {0.8224622, 0.0331942, 0.0170827}, {0.1775378, 0.9668058, 0.0723974}, {0.0, 0.0, 0.9105199}};
const glm::dmat3 rec2020_from_rec709{
    {0.6274039, 0.0690973, 0.0163914}, {0.3292830, 0.9195404, 0.0880133}, {0.0433131, 0.0113623, 0.8955953}};

double distance(const glm::dmat3& a, const glm::dmat3& b) {
    double max = 0;
    for (int c = 0; c < 3; ++c)
        for (int r = 0; r < 3; ++r) max = std::max(max, std::abs(a[c][r] - b[c][r]));
    return max;
}

}  // namespace

Response::Response(std::vector<RampStep> ramp) {
    // Skips steps that are written as 0 or like their predecessor.
    for (const RampStep& step : ramp)
        if (step.actual > 1e-9 && (ramp_.empty() || step.actual > 1.02 * ramp_.back().actual))
            ramp_.push_back(step);
    if (ramp_.size() < 2) return;
    if (ramp.back().actual <= 1.02 * ramp_.back().actual && ramp_.back().expected < ramp.back().expected)
        cut_off_ = ramp_.back().expected;
    // The step at the limit is clipped already.
    const std::span<const RampStep> sound(ramp_.data(), ramp_.size() - (cut_off_ ? 1 : 0));
    const auto fits = [&](const auto& decoded, std::size_t max_steps) {
        std::vector<double> logs;
        for (const RampStep& step : sound.first(std::min(max_steps, sound.size())))
            logs.push_back(std::log(decoded(step.actual) / step.expected));
        const double middle = medianOf(logs);
        if (!std::ranges::all_of(logs, [&](double log) { return std::abs(log - middle) < max_off; }))
            return false;
        exposure_ = std::exp(middle);
        return true;
    };
    if (fits([](double actual) { return actual; }, sound.size())) {
        kind_ = CurveKind::linear;
    } else {
        // sRGB is undefined above 1: renderers extrapolate or clip.
        std::size_t below = 0;
        while (below < sound.size() && sound[below].actual <= 1.001) ++below;
        if (below >= 4 && fits(linearFromSrgb, below)) kind_ = CurveKind::srgb;
    }
    if (kind_ == CurveKind::linear && cut_off_) cut_off_ = ramp_.back().actual / exposure_;
}

double Response::straight(double actual) const {
    if (!(actual > 0) || ramp_.size() < 2) return 0;
    if (kind_ == CurveKind::linear) return actual / exposure_;
    if (kind_ == CurveKind::srgb) return linearFromSrgb(actual) / exposure_;
    // Power-law interpolation between steps, and extrapolation beyond them.
    auto next = std::ranges::lower_bound(ramp_, actual, {}, &RampStep::actual);
    next = std::clamp(next, ramp_.begin() + 1, ramp_.end() - 1);
    const RampStep &a = *(next - 1), &b = *next;
    const double exponent = std::log(actual / a.actual) / std::log(b.actual / a.actual);
    return a.expected * std::pow(b.expected / a.expected, exponent);
}

void Response::measurePrimaries(const std::array<glm::dvec3, 3>& columns, double expected) {
    glm::dmat3 measured(0.0);
    for (int c = 0; c < 3; ++c)
        for (int r = 0; r < 3; ++r)
            measured[c][r] = straight(columns[static_cast<std::size_t>(c)][r]) / expected;
    primaries_.reset();
    double min = 0.06;
    const std::array candidates{std::pair{Primaries::rec709, glm::dmat3(1.0)},
                                std::pair{Primaries::display_p3, p3_from_rec709},
                                std::pair{Primaries::rec2020, rec2020_from_rec709}};
    for (const auto& [primaries, matrix] : candidates)
        if (const double far = distance(measured, matrix); far < min) {
            min = far;
            primaries_ = primaries;
            expected_from_actual_ = glm::inverse(matrix);
        }
    if (!primaries_ && std::abs(glm::determinant(measured)) > 1e-3)
        expected_from_actual_ = glm::inverse(measured);
}

glm::dvec3 Response::radiance(const glm::dvec3& actual) const {
    return expected_from_actual_ * glm::dvec3(straight(actual.r), straight(actual.g), straight(actual.b));
}

}  // namespace diptych::external
