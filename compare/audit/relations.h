// SPDX-License-Identifier: MIT
// All relations.
#pragma once

#include "compare/audit/relation.h"

#include <span>
#include <string>
#include <vector>

namespace diptych::audit {

std::span<const Relation> relations();

// Relations with these names, in the order of relations(); all if there are none. Throws
// std::runtime_error naming --relation, the unknown name and the known ones.
std::vector<const Relation*> relationsOf(std::span<const std::string> names);

// Relations by subject; relations() returns all.
std::vector<Relation> lightRelations();     // lights and everything that emits light
std::vector<Relation> placeRelations();     // position of the scene, and its camera
std::vector<Relation> geometryRelations();  // equivalent descriptions of the same surfaces
std::vector<Relation> settingRelations();   // Settings that must not matter

// Shared reasons why a relation does not apply; empty if it does.
std::string lacksNone(const Subject& subject);
// The texels of shadow maps fall on other points once the scene is moved.
std::string lacksWithShadows(const Subject& subject);
// --assign per_object evaluates only the brightest lights exactly.
std::string lacksPerObject(const Subject& subject);

}  // namespace diptych::audit
