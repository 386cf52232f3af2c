// SPDX-License-Identifier: MIT
// All relations.
#pragma once

#include "compare/audit/relation.h"

#include <span>
#include <string>
#include <vector>

namespace diptych::audit {

std::span<const Relation> relations();

// Those that are named, in the order of relations(); all where none is. Throws std::runtime_error naming
// --relation, the unknown name and what there is.
std::vector<const Relation*> relationsOf(std::span<const std::string> names);

// By what they change; relations() has them all.
std::vector<Relation> lightRelations();     // lights, and all that sends light
std::vector<Relation> placeRelations();     // where the scene is, and how it is seen
std::vector<Relation> geometryRelations();  // how the same surfaces are written down
std::vector<Relation> settingRelations();   // Settings that must not matter

// What several lack.
std::string lacksNone(const Subject& subject);
// Shadow maps have texels of their own, which fall elsewhere once the scene is elsewhere.
std::string lacksWithShadows(const Subject& subject);
// --assign per_object takes the brightest lights alone for what they are.
std::string lacksPerObject(const Subject& subject);

}  // namespace diptych::audit
