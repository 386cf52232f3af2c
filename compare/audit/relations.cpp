// SPDX-License-Identifier: MIT
#include "compare/audit/relations.h"

#include "shared/text/did_you_mean.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <stdexcept>

namespace diptych::audit {

std::string_view nameOf(Equality equality) {
    switch (equality) {
        case Equality::bits:
            return "bits";
        case Equality::sums:
            return "sums";
        case Equality::rounding:
            return "rounding";
    }
    return {};
}

std::span<const Relation> relations() {
    static const std::vector<Relation> all = [] {
        std::vector<Relation> made;
        for (const auto& group : {lightRelations, placeRelations, geometryRelations, settingRelations})
            std::ranges::move(group(), std::back_inserter(made));
        return made;
    }();
    return all;
}

std::vector<const Relation*> relationsOf(std::span<const std::string> names) {
    std::vector<std::string> known;
    for (const Relation& relation : relations()) known.emplace_back(relation.name);
    for (const std::string& name : names)
        if (std::ranges::count(known, name) == 0)
            throw std::runtime_error(fmt::format("--relation {}: there is no such relation{}; there are {}",
                                                 name, didYouMean(name, known), fmt::join(known, ", ")));
    std::vector<const Relation*> found;
    for (const Relation& relation : relations())
        if (names.empty() || std::ranges::count(names, relation.name) > 0) found.push_back(&relation);
    return found;
}

std::string lacksNone(const Subject&) {
    return {};
}
std::string lacksWithShadows(const Subject& subject) {
    const Settings& settings = subject.given.settings;
    if (settings.shadows == Shadows::off) return {};
    return "shadow-map texels fall on other points: leave out --shadows";
}
std::string lacksPerObject(const Subject& subject) {
    if (subject.given.settings.assign != Assignment::per_object) return {};
    return "--assign per_object merges some of an object's lights, and then merges others";
}

}  // namespace diptych::audit
