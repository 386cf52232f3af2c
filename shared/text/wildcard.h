// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

namespace diptych {

// Whether `pattern` matches all of `text`; * matches any number of characters, ? one.
bool matches(std::string_view pattern, std::string_view text);

}  // namespace diptych
