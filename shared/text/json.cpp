// SPDX-License-Identifier: MIT
#include "shared/text/json.h"

#include "shared/text/json_shape.h"
#include "shared/text/one_line.h"

#include <nlohmann/json.hpp>

#include <stdexcept>
#include <string>

namespace diptych {

nlohmann::json parseJson(std::string_view text) {
    if (jsonShape(text).depth > json_depth)
        throw std::runtime_error("nests deeper than " + std::to_string(json_depth));
    try {
        return nlohmann::json::parse(text);
    } catch (const nlohmann::json::exception& e) {
        const std::string_view message = e.what();  // "[json.exception.parse_error.101] parse error at ..."
        const std::size_t at = message.find("] ");
        throw std::runtime_error("is not JSON: " + oneLine(message.substr(at == message.npos ? 0 : at + 2)));
    }
}

}  // namespace diptych
