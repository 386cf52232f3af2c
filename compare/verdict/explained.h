// SPDX-License-Identifier: MIT
// Why lit of a comparison differs, as shown in a report. compare/explain computes it.
#pragma once

#include "compare/output/document.h"
#include "shared/image/png.h"

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace diptych {

struct Explained {
    std::vector<output::Block> blocks;  // for a terminal, one line; for a page, all but the map
    std::string json;                   // a JSON object
    std::optional<Image8> map;          // the largest cause at each pixel
};

// The map on a page. `file`: its path there, or a data URI.
inline output::Box causeMap(std::string file) {
    return {
        "pictures causes",
        {output::ImageBlock{std::move(file), "the largest cause at each pixel",
                            "The largest cause at each pixel, in the colour of its row; dark: the picture "
                            "itself, where no cause reduces the difference"}}};
}

}  // namespace diptych
