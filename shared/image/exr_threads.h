// SPDX-License-Identifier: MIT
#pragma once

namespace diptych::exr {

// Starts OpenEXR's threads, one per core, at the first call.
void useAllCores();

}  // namespace diptych::exr
