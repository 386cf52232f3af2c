// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

namespace diptych {

// Whether `pattern` matches all of `text`; * stands for any number of characters, ? for one.
bool matches(std::string_view pattern, std::string_view text);

}  // namespace diptych
