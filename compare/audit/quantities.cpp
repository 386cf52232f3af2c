// SPDX-License-Identifier: MIT
#include "compare/audit/quantities.h"

#include "compare/audit/groups.h"
#include "shared/text/did_you_mean.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <stdexcept>

namespace diptych::audit {

std::span<const Quantity> quantities() {
    static const std::vector<Quantity> all = [] {
        std::vector<Quantity> made;
        for (const auto& group : {placeQuantities, cameraQuantities, lightQuantities, materialQuantities,
                                  shadowQuantities, amountQuantities})
            std::ranges::move(group(), std::back_inserter(made));
        return made;
    }();
    return all;
}

std::vector<const Quantity*> quantitiesOf(std::span<const std::string> names, std::string_view option) {
    std::vector<std::string> known;
    for (const Quantity& quantity : quantities()) known.emplace_back(quantity.name);
    for (const std::string& name : names)
        if (std::ranges::count(known, name) == 0)
            throw std::runtime_error(fmt::format("{} {}: there is no such quantity{}; there are {}", option,
                                                 name, didYouMean(name, known), fmt::join(known, ", ")));
    std::vector<const Quantity*> found;
    for (const Quantity& quantity : quantities())
        if (names.empty() || std::ranges::count(names, quantity.name) > 0) found.push_back(&quantity);
    return found;
}

}  // namespace diptych::audit
