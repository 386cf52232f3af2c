// SPDX-License-Identifier: MIT
#include "compare/verdict/frame_pair.h"

namespace diptych {

const Frame* FramePair::of(bool (*can)(Path)) const {
    const bool first = can(baseline.settings.path), second = can(test.settings.path);
    if (first == second) return nullptr;
    return first ? &baseline : &test;
}

bool isPathAgainstReference(const FramePair& pair) {
    return isReferenceFrame(pair.baseline) != isReferenceFrame(pair.test) && !pair.baseline.origin.external &&
           !pair.test.origin.external;
}

}  // namespace diptych
