// SPDX-License-Identifier: MIT
#include "compare/verdict/criterion.h"

#include <fmt/format.h>

#include <limits>
#include <utility>

namespace diptych {

double usedOf(const Criterion& criterion) {
    const auto [over, under] = criterion.least ? std::pair{criterion.limit, criterion.measured}
                                               : std::pair{criterion.measured, criterion.limit};
    if (over == 0 || over == under) return over == 0 ? 0 : 1;
    return under > 0 ? over / under : std::numeric_limits<double>::infinity();
}

std::string shareText(const Criterion& criterion) {
    return fmt::format(
        fmt::runtime(criterion.differing ? "; {} of the pixels differ" : ", at {} of the pixels"),
        percentText(criterion.share));
}

std::string percentText(double share) {
    if (share > 0 && share < 1e-4) return "under 0.01 %";
    if (share < 1 && share > 0.9999) return "over 99.99 %";
    return fmt::format("{:.3g} %", 100 * share);
}

}  // namespace diptych
