// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

namespace diptych {

// Whether `pattern`, in which * is any number of characters and ? is one, is all of `text`.
bool matches(std::string_view pattern, std::string_view text);

}  // namespace diptych
