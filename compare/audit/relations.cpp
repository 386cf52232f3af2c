// SPDX-License-Identifier: MIT
#include "compare/audit/relations.h"

#include <algorithm>
#include <iterator>

namespace diptych::audit {

std::string_view nameOf(Equality equality) {
    constexpr std::string_view names[] = {"bits", "sums", "rounding"};
    return names[static_cast<std::size_t>(equality)];
}

std::span<const Relation> relations() {
    static const std::vector<Relation> all = [] {
        std::vector<Relation> made;
        for (const auto& group : {lightRelations, transformRelations, geometryRelations, settingRelations})
            std::ranges::move(group(), std::back_inserter(made));
        return made;
    }();
    return all;
}

std::string lacksWithShadows(const Subject& subject) {
    const Settings& settings = subject.original.settings;
    if (settings.shadows == Shadows::off) return {};
    return "shadow-map texels fall on other points: leave out --shadows";
}
std::string lacksPerObject(const Subject& subject) {
    if (subject.original.settings.assign != Assignment::per_object) return {};
    return "--assign per_object merges some of an object's lights, and then merges others";
}

}  // namespace diptych::audit
