// SPDX-License-Identifier: MIT
#pragma once

namespace diptych::exr {

// OpenEXR's own threads, one a core, made at the first call.
void useAllCores();

}  // namespace diptych::exr
