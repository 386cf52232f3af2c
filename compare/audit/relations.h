// SPDX-License-Identifier: MIT
// Metamorphic relations between two images of one renderer; they need no ground truth. A change to the
// scene must leave its image the same, or change it in a known way (metamorphic testing: Chen et al. 1998;
// Donaldson et al. 2017, "Automated Testing of Graphics Shader Compilers").
#pragma once

#include "compare/audit/quantities.h"

#include <glm/mat3x3.hpp>

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace diptych::audit {

// Maps pixels of the changed image to the original one, and their values.
struct PixelMap {
    int border = 0;          // pixels on each side that only the changed image has
    bool mirrored = false;   // left and right are swapped, after removing the border
    double light = 1;        // factor of radiance
    double length = 1;       // factor of lengths
    glm::dmat3 rotation{1};  // rotates vectors of the original image into the changed one; orthogonal
    std::vector<int> ids;    // original material of each material of the changed scene; empty: the same
};

// The two cases of a relation; both are the original one until it changes them.
struct Related {
    Case base, changed;
    PixelMap map{};
    bool own_base = false;  // the base differs from the original case
};

// How similar the images must be; RelationMeasurer::toleranceOf derives the tolerances.
enum class Equality {
    bits,     // same arithmetic on the same numbers: bitwise identical
    sums,     // same terms, added in another order
    rounding  // positions equal except for rounding
};
std::string_view nameOf(Equality equality);

struct Relation {
    std::string_view name;     // "lights_permuted"
    std::string_view changes;  // "the order of the lights is reversed"
    Equality equality = Equality::bits;
    std::string_view because;  // why the images stay this similar
    Preconditions lacks = {};
    void (*change)(Related&, const Subject&) = nullptr;
    // Whether it may change which of several surfaces at one depth is visible.
    bool reorders = false;
    // Whether the same pipelines render both, so that any device computes the same from the same bits.
    bool same_pipelines = false;
    // Whether only Settings change, so that it does not apply to a path that ignores them.
    bool of_settings = false;
};

std::span<const Relation> relations();

inline std::vector<const Relation*> relationsOf(std::span<const std::string> names) {
    return rowsNamed(names, relations(), "--relation", "relation");
}

// Relations by subject; relations() returns all.
std::vector<Relation> lightRelations();      // lights and everything that emits light
std::vector<Relation> transformRelations();  // position of the scene, and its camera
std::vector<Relation> geometryRelations();   // equivalent descriptions of the same surfaces
std::vector<Relation> settingRelations();    // Settings that must not matter

// Shared preconditions.
// The texels of shadow maps fall on other points once the scene is moved.
std::string lacksWithShadows(const Subject& subject);
// --assign per_object evaluates only the brightest lights exactly.
std::string lacksPerObject(const Subject& subject);

}  // namespace diptych::audit
