// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

namespace diptych {

// "data:image/png;base64,...", of a PNG's bytes.
std::string dataUri(std::string_view png);

}  // namespace diptych
