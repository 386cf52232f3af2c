// SPDX-License-Identifier: MIT
// Writes JSON as text. All JSON for files and other programs goes through this.
#pragma once

#include "shared/text/one_line.h"

#include <nlohmann/json.hpp>

#include <string>

namespace diptych {

// Escapes controls (including C1 and DEL) and bidirectional formatting characters, as in "\u009b", so
// `cat` of the file is safe; they read back unchanged. Invalid UTF-8 becomes U+FFFD. `indent`: spaces per
// level; -1: all on one line.
template <class Json>
std::string jsonText(const Json& json, int indent = 2) {
    return escapeControls(json.dump(indent, ' ', false, Json::error_handler_t::replace));
}

}  // namespace diptych
