// SPDX-License-Identifier: MIT
#pragma once

namespace diptych {

const char* versionName();  // "0.2.0"
// The commit at configure time, as `git rev-parse --short=12 HEAD` prints it; "unknown" outside a
// repository.
const char* commitName();

}  // namespace diptych
