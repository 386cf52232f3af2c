// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

namespace diptych {

std::string base64(std::string_view bytes);  // RFC 4648, section 4

// "data:image/png;base64,..." for the bytes of a PNG.
std::string dataUri(std::string_view png);

}  // namespace diptych
