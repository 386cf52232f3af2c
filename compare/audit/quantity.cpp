// SPDX-License-Identifier: MIT
#include "compare/audit/quantity.h"

namespace diptych::audit {

bool isPrecise(const Settings& settings) {
    return settings.path != Path::deferred || settings.gbuffer == GBufferEncoding::full;
}

}  // namespace diptych::audit
