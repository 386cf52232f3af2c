// SPDX-License-Identifier: MIT
#include "shared/frame/supported_channels.h"

namespace diptych {

bool isSupportedByReference(const DebugMode& mode) {
    return mode.supported_by == SupportedBy::both || mode.supported_by == SupportedBy::forward_only;
}

std::string_view unsupportedReason(const Settings& settings, const DebugMode& mode) {
    switch (mode.supported_by) {
        case SupportedBy::both:
            return {};
        case SupportedBy::forward_only:
            return hasGBuffer(settings.path)
                       ? "the deferred path's G-buffer does not store it; use --path forward_plus"
                       : "";
        case SupportedBy::deferred_only:
            if (!hasGBuffer(settings.path))
                return "only deferred lighting selects samples to shade; use --path deferred";
            return settings.msaa == 1 ? "every pixel is shaded once; use --msaa 4" : "";
        case SupportedBy::paths_only:
            return isReference(settings.path) ? "the reference has no light lists or shadow maps; use "
                                                "--path forward_plus or deferred"
                                              : "";
    }
    return {};
}

}  // namespace diptych
