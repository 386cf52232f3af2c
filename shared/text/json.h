// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <string_view>

namespace diptych {

// JSON from anywhere, no deeper than json_depth. Throws std::runtime_error, one line without a name: "nests
// deeper than 128", "is not JSON: parse error at line 3, column 7: ...".
nlohmann::json parseJson(std::string_view text);

}  // namespace diptych
