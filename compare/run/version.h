// SPDX-License-Identifier: MIT
#pragma once

namespace diptych {

const char* versionName();  // "0.2.0"
// The commit that this program was configured at, as `git rev-parse --short=12 HEAD` has it; "unknown"
// outside a repository.
const char* commitName();

}  // namespace diptych
