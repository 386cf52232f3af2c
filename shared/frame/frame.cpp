// SPDX-License-Identifier: MIT
#include "shared/frame/frame.h"

#include <fmt/format.h>

namespace diptych {

bool isReferenceFrame(const Frame& frame) {
    return frame.settings.path == Path::reference &&
           (frame.origin.file.empty() || !frame.origin.device.empty());
}

std::string uncertaintyNote(double relative) {
    return fmt::format(
        "reference: lit is known to {:.2g} of itself with a confidence of 95 %, at 99.9 % of the pixels",
        relative);
}

}  // namespace diptych
