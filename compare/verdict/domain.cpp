// SPDX-License-Identifier: MIT
#include "compare/verdict/domain.h"

#include "compare/metrics/pixel.h"
#include "compare/verdict/encoding_bits.h"
#include "shared/text/counted.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>

namespace diptych {
namespace {

// How far a pixel is out of range, and its value; 0: inside.
struct Outside {
    double by = 0, value = 0;
};

Outside outside(Domain domain, const float* p, int components) {
    Outside worst;
    const auto look = [&](double value, double by) {
        if (by > worst.by) worst = {by, value};
    };
    if (domain == Domain::unit || domain == Domain::unit_or_zero) {
        const double length = std::hypot(double{p[0]}, double{p[1]}, double{p[2]});
        if (domain == Domain::unit || length != 0) look(length, std::abs(length - 1));
        return worst;
    }
    for (int c = 0; c < components; ++c) {
        look(p[c], -double{p[c]});
        if (domain == Domain::share) look(p[c], double{p[c]} - 1);
    }
    return worst;
}

const char* faultOf(Domain domain) {
    switch (domain) {
        case Domain::unit:
            return "vectors are not of unit length";
        case Domain::unit_or_zero:
            return "vectors are neither 0 nor of unit length";
        case Domain::share:
            return "values are not between 0 and 1";
        case Domain::positive:
            return "values are negative";
        case Domain::any:
            break;
    }
    return "";
}

}  // namespace

std::string outsideDomain(const DebugMode& mode, const Image& image, const Coverage& coverage,
                          const Image* ids) {
    if (mode.domain == Domain::any) return {};
    std::uint64_t count = 0;
    std::size_t place = 0;
    Outside worst;
    for (std::size_t i = 0; i < image.pixels(); ++i) {
        if (!coverage.covered[i] || (ids && *ids->pixel(i) < 0)) continue;
        if (!metrics::finite(image.pixel(i), image.components)) continue;
        const Outside here = outside(mode.domain, image.pixel(i), image.components);
        if (here.by <= lengthBound) continue;
        ++count;
        if (here.by > worst.by) {
            worst = here;
            place = i;
        }
    }
    if (count == 0) return {};
    const auto width = static_cast<std::size_t>(image.width);
    return fmt::format("{} at {}, the worst {:.6g} at {},{}", faultOf(mode.domain), counted(count, "pixel"),
                       worst.value, place % width, place / width);
}

}  // namespace diptych
