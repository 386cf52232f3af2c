// SPDX-License-Identifier: MIT
#include "compare/reference/resolve.h"

#include <algorithm>
#include <utility>

namespace diptych::reference {
namespace {

double largestComponent(const glm::dvec3& radiance) {
    return std::max({0.0, radiance.x, radiance.y, radiance.z});
}

// Factor from the square of a 95 % half-interval to the variance of a normal distribution.
constexpr double variancesOf95 = 1 / (1.96 * 1.96);

// Propagates the error of a sample c, whose weight is w = 1 / (1 + c), to the tone-mapped mean L. If c
// changes by 1, L changes by w^2 (1 + L) / (sum of weights): this adds w^2, and put() multiplies by the
// rest. The tone curve is bent, so noise of c with variance v also shifts L: by the second term of the
// series, w v times as much.
void addErrors(Shading& sum, const Shading& sample, double weight, double fraction) {
    const double u = sample.uncertainty, slope = fraction * weight * weight;
    sum.uncertainty += slope * (u + weight * u * u * variancesOf95);
    sum.costs += sample.costs * slope;
}

}  // namespace

double resolveWeight(Resolve resolve, const glm::dvec3& radiance) {
    return resolve == Resolve::tonemapped ? 1 / (1 + largestComponent(radiance)) : 1;
}

void ResolvedLight::add(const Pixel& sample) {
    const double weight = resolveWeight(resolve_, sample.lit), fraction = fraction_ * weight;
    const double unblended = fraction_ * resolveWeight(resolve_, sample.unblended);
    sum_.lit += sample.lit * fraction;
    sum_.shading += sample.shading * fraction;
    sum_.haze.scattered += sample.haze.scattered * fraction;
    sum_.transmitted += sample.transmitted * fraction;
    sum_.blended += sample.blended * fraction;
    sum_.unblended += sample.unblended * unblended;
    weights_ += fraction;
    unblended_weights_ += unblended;
    if (resolve_ == Resolve::linear) return;
    addErrors(errors_, sample.shading, weight, fraction_);
    addErrors(blended_errors_, sample.blended, weight, fraction_);
}

void ResolvedLight::put(Pixel& pixel) const {
    pixel.lit = sum_.lit;
    pixel.unblended = sum_.unblended;
    pixel.haze.scattered = sum_.haze.scattered;
    pixel.transmitted = sum_.transmitted;
    pixel.shading = sum_.shading;
    pixel.blended = sum_.blended;
    if (resolve_ == Resolve::linear) return;  // the sum of fractions is 1
    pixel.lit /= weights_;
    pixel.unblended /= unblended_weights_;
    pixel.haze.scattered /= weights_;
    pixel.transmitted /= weights_;
    pixel.shading = pixel.shading * (1 / weights_);
    pixel.blended = pixel.blended * (1 / weights_);
    const double slope = (1 + largestComponent(pixel.lit)) / weights_;
    for (const auto& [shading, errors] :
         {std::pair{&pixel.shading, &errors_}, {&pixel.blended, &blended_errors_}}) {
        shading->uncertainty = errors->uncertainty * slope;
        shading->costs = errors->costs * slope;
    }
}

}  // namespace diptych::reference
