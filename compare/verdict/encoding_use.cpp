// SPDX-License-Identifier: MIT
#include "compare/verdict/encoding_use.h"

#include "compare/metrics/pixel.h"
#include "compare/verdict/encoding_bits.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace diptych {
namespace {

// For components in [0, 1], each bounded by its own value. 0 and 1 have codes of their own; NaN has no
// bound.
template <class Bound>
PixelUse componentsUse(const float* read, const float* own, int components, const Bound& bound) {
    PixelUse use;
    for (int c = 0; c < components; ++c) {
        const double x = own[c];
        const PixelUse here = pixelUse(metrics::distance(read[c], own[c]), bound(x, !(x > 0 && x < 1)));
        use = {std::max(use.fraction, here.fraction), std::max(use.bound, here.bound)};
    }
    return use;
}

// The bound of values with an exponent is relative to the largest component, at least the smallest step. 0
// has a code of its own.
PixelUse floatUse(const float* read, const float* own, int components, FloatBound of, double slack) {
    const double size = metrics::largestFinite(own, components);
    const double bound = size > 0 ? std::max(size * of.relative, of.min) + size * slack : 0;
    return {pixelUse(metrics::distance(read, own, components), bound).fraction, size > 0 ? bound / size : 0};
}

// A field that is stored exactly: nothing but the slack is granted.
PixelUse exactUse(const DebugMode& mode, const float* read, const float* own, double slack) {
    const double size = mode.error_kind == ErrorKind::relative ? metrics::largestFinite(own, mode.width) : 1;
    return pixelUse(metrics::distance(read, own, mode.width), slack * size);
}

}  // namespace

PixelUse storedUse(const StoredField& field, const float* read, const float* own, int components,
                   double slack) {
    switch (field.code) {
        case StoredField::Code::exact:
            break;
        case StoredField::Code::unorm:
            return componentsUse(read, own, components, [&](double, bool end) {
                return (end ? 0 : unormBound(field.bits)) + slack;
            });
        case StoredField::Code::root:
            return componentsUse(read, own, components, [&](double x, bool end) {
                return (end ? 0 : squareBound(x, field.bits)) + slack;
            });
        case StoredField::Code::octahedral:
        case StoredField::Code::line: {
            const bool finite = metrics::finite(read, components) && metrics::finite(own, components);
            const auto between = field.code == StoredField::Code::line ? metrics::lineAngle : metrics::angle;
            return pixelUse(finite ? between(read, own) : metrics::distance(read, own, components),
                            field.largestBound() + slack);
        }
        case StoredField::Code::radiance:
            return floatUse(read, own, components, radianceBound(field.bits), slack);
        case StoredField::Code::half:
            return floatUse(read, own, components, halfBound(field.bits), slack);
        case StoredField::Code::index:
            // 0: no film.
            return pixelUse(metrics::distance(*read, *own),
                            (*own > 0 ? indexBound(double{*own}, field.bits) : 0) + slack);
    }
    return {};
}

std::optional<BoundUse> encodingUse(const DebugMode& mode, const FramePair& pair, double slack) {
    const Frame *deferred = pair.of(hasGBuffer), *forward = pair.of(shadesFragments);
    if (!deferred || !forward) return {};
    const Image *mine = findChannel(*deferred, mode.channel), *theirs = findChannel(*forward, mode.channel);
    if (!mine || !theirs) return {};
    const auto field = storedField(mode.channel, deferred->settings.gbuffer, pair.needs);
    // Images of each sample that both have: deferred's and forward+'s.
    std::vector<std::pair<const Image*, const Image*>> samples{{mine, theirs}};
    const auto read = deferred->further_samples.find(mode.channel),
               own = forward->further_samples.find(mode.channel);
    if (read != deferred->further_samples.end() && own != forward->further_samples.end() &&
        read->second.size() == own->second.size())
        for (std::size_t s = 0; s < read->second.size(); ++s)
            samples.emplace_back(&read->second[s], &own->second[s]);
    if (!field && (samples.size() == 1 || std::ranges::count(lightingFields(), mode.channel) == 0)) return {};
    return boundUse(pair.coverage, samples.front().second->width, [&](std::size_t i) {
        PixelUse worst;
        for (const auto& [a, b] : samples) {
            const PixelUse here = field ? storedUse(*field, a->pixel(i), b->pixel(i), mode.width, slack)
                                        : exactUse(mode, a->pixel(i), b->pixel(i), slack);
            worst = {std::max(worst.fraction, here.fraction), std::max(worst.bound, here.bound)};
        }
        return worst;
    });
}

}  // namespace diptych
