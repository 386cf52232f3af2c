// SPDX-License-Identifier: MIT
// The one way in which JSON becomes text for a file or another program.
#pragma once

#include "shared/text/one_line.h"

#include <nlohmann/json.hpp>

#include <string>

namespace diptych {

// Controls (C1 and DEL too) and what sets the direction of text stand as "\u009b" in strings, so that `cat`
// shows the file as it is; they read back as what they are. Bytes that are not UTF-8 become U+FFFD. `indent`:
// spaces a level; -1: all on one line.
template <class Json>
std::string jsonText(const Json& json, int indent = 2) {
    return shownText(json.dump(indent, ' ', false, Json::error_handler_t::replace));
}

}  // namespace diptych
