// SPDX-License-Identifier: MIT
#pragma once

#include "shared/scene/model/motion.h"
#include "shared/scene/model/scene.h"

#include <cstddef>
#include <span>
#include <vector>

namespace diptych {

// Sets one value of a material, in its valid range (propertiesOf()), with as many components as
// propertiesOf() says. `slot`: of a texture transform. `parts`: of the material; values that Material stores
// combined are computed from them. Ignores parts of other objects.
void setPart(Material& material, MaterialParts& parts, AnimatedPart part, std::size_t slot,
             std::span<const double> value);

// The value of a factor as glTF has it, with a strength of 1. `part`: none of a texture's transform.
std::vector<double> partOf(const Material& material, AnimatedPart part);

}  // namespace diptych
