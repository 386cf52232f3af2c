// SPDX-License-Identifier: MIT
#pragma once

#include "shared/contract/debug_mode.h"

namespace diptych {

inline constexpr int litMode = static_cast<int>(gpu::DEBUG_lit),
                     idMode = static_cast<int>(gpu::DEBUG_material_id);

}  // namespace diptych
