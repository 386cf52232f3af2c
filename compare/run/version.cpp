// SPDX-License-Identifier: MIT
#include "compare/run/version.h"

namespace diptych {

const char* versionName() {
    return DIPTYCH_VERSION;
}

const char* commitName() {
    return DIPTYCH_COMMIT;
}

}  // namespace diptych
