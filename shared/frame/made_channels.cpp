// SPDX-License-Identifier: MIT
#include "shared/frame/made_channels.h"

namespace diptych {

bool isMadeByReference(const DebugMode& mode) {
    return mode.maker == MadeBy::both || mode.maker == MadeBy::forward_only;
}

std::string_view notMadeBecause(const Settings& settings, const DebugMode& mode) {
    switch (mode.maker) {
        case MadeBy::both:
            return {};
        case MadeBy::forward_only:
            return hasGBuffer(settings.path)
                       ? "the deferred path's G-buffer does not store it; use --path forward_plus"
                       : "";
        case MadeBy::deferred_only:
            if (!hasGBuffer(settings.path))
                return "only deferred lighting selects samples to shade; use --path deferred";
            return settings.msaa == 1 ? "every pixel is shaded once; use --msaa 4" : "";
        case MadeBy::paths_only:
            return isReference(settings.path) ? "the reference has no light lists or shadow maps; use "
                                                "--path forward_plus or deferred"
                                              : "";
    }
    return {};
}

}  // namespace diptych
