// SPDX-License-Identifier: MIT
// Relations between two pictures of one renderer, which need no truth: a scene is changed in a way that must
// leave its picture as it is, or change it as is known (metamorphic tests: Chen et al. 1998; Donaldson et al.
// 2017, "Automated Testing of Graphics Shader Compilers").
#pragma once

#include "compare/audit/case.h"

#include <glm/mat3x3.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace diptych::audit {

// Where the pixels of the changed picture are in the given one, and by how much their numbers differ then.
struct PictureMap {
    int border = 0;         // pixels on each side that only the changed picture has
    bool mirrored = false;  // left and right change places; after the border is gone
    double light = 1;       // what radiance is multiplied by
    double length = 1;      // what lengths are
    glm::dmat3 turn{1};  // what turns vectors of the given picture into those of the changed one; orthogonal
    std::vector<int> ids;  // by material of the changed scene, that of the given one; empty: the same
};

// What a relation makes of a case: two cases, which are the given one until it changes them.
struct Related {
    Case base, changed;
    PictureMap map{};
    bool own_base = false;  // the base is another one than the given case
};

// How alike the pictures must be; RelationMeasurer::toleranceOf derives what each allows.
enum class Equality {
    bits,     // the same arithmetic of the same numbers: bit for bit
    sums,     // the same terms, added in another order
    rounding  // places that are the same but for rounding
};
std::string_view nameOf(Equality equality);  // "bits"

struct Relation {
    std::string_view name;     // "lights_permuted"
    std::string_view changes;  // "the order of the lights is reversed"
    Equality equality = Equality::bits;
    std::string_view because;  // why the picture stays so much alike
    // Why it says nothing of this scene with its Settings; empty where it does.
    std::string (*lacks)(const Subject&) = nullptr;
    void (*change)(Related&, const Subject&) = nullptr;
    // Whether surfaces of one depth may be seen in another order then.
    bool reorders = false;
    // Whether the very pipelines draw both, so that on any device they compute the same from the same bits.
    bool same_pipelines = false;
    // Whether only Settings change, so that it says nothing of a path that ignores them.
    bool of_settings = false;
};

}  // namespace diptych::audit
