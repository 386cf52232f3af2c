// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <string_view>

namespace diptych {

// Parses untrusted JSON, nested no deeper than json_depth. Throws std::runtime_error, one line without the
// file's name: "nests deeper than 128", "is not JSON: parse error at line 3, column 7: ...".
nlohmann::json parseJson(std::string_view text);

}  // namespace diptych
