// SPDX-License-Identifier: MIT
// Why lit of a comparison differs, as shown in a report. compare/explain computes it.
#pragma once

#include "shared/image/png.h"

#include <functional>
#include <optional>
#include <string>

namespace diptych {

struct Explained {
    std::string words;          // one line for a terminal
    std::string json;           // a JSON object
    std::optional<Image8> map;  // the largest cause at each pixel
    // HTML that names every cause; `map`: path of that image for the page, empty if it is not stored.
    std::function<std::string(const std::string& map)> html;
};

}  // namespace diptych
