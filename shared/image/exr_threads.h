// SPDX-License-Identifier: MIT
#pragma once

namespace diptych::exr {

// Starts OpenEXR's own threads, one for each core, at the first call.
void useAllCores();

}  // namespace diptych::exr
