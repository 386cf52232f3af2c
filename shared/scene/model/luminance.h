// SPDX-License-Identifier: MIT
#pragma once

#include <glm/vec3.hpp>

namespace diptych {

// Relative luminance of linear Rec.709 (ITU-R BT.709-6).
inline double luminance(const glm::dvec3& rgb) {
    return 0.2126 * rgb.x + 0.7152 * rgb.y + 0.0722 * rgb.z;
}

}  // namespace diptych
