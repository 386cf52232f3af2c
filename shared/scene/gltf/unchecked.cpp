// SPDX-License-Identifier: MIT
#include "shared/scene/gltf/unchecked.h"

#include "shared/text/fail.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <utility>

namespace diptych::gltf {

using Json = nlohmann::json;

const Json* memberOf(const Json& value, const char* key) {
    const auto at = value.find(key);  // end() if it is not an object
    return at == value.end() ? nullptr : &*at;
}

const Json& arrayAt(const Json& document, const char* place) {
    static const Json none = Json::array();
    const Json::json_pointer pointer(place);
    return document.contains(pointer) && document[pointer].is_array() ? document[pointer] : none;
}

Json takeExtension(Json& owner, const char* name) {
    if (!owner.is_object() || !owner.contains("extensions")) return nullptr;
    Json& extensions = owner["extensions"];
    if (!extensions.is_object() || !extensions.contains(name)) return nullptr;
    Json taken = std::move(extensions[name]);
    extensions.erase(name);
    return taken;
}

int indexBelow(const Json& value, std::size_t count, const std::string& who) {
    const double index = value.is_number() ? value.get<double>() : -1;
    if (!(index >= 0 && index < static_cast<double>(count) && index == std::floor(index)))
        fail(who, fmt::format("is not a whole number below {}", count));
    return static_cast<int>(index);
}

}  // namespace diptych::gltf
