// SPDX-License-Identifier: MIT
// Why lit of a comparison differs, as a report shows it. compare/explain finds it.
#pragma once

#include "shared/image/png.h"

#include <functional>
#include <optional>
#include <string>

namespace diptych {

struct Explained {
    std::string words;          // one line for a terminal
    std::string json;           // the text of an object
    std::optional<Image8> map;  // which cause counts most at each pixel
    // A part of the page that names every cause; `map`: where the page finds that picture, empty where none
    // is kept.
    std::function<std::string(const std::string& map)> html;
};

}  // namespace diptych
