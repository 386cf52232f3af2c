// SPDX-License-Identifier: MIT
#include "shared/text/json_shape.h"

#include <algorithm>

namespace diptych {

JsonShape jsonShape(std::string_view text) {
    JsonShape shape;
    std::size_t open = 0;
    bool quoted = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (c == '"') {
            quoted = !quoted;
        } else if (quoted) {
            if (c == '\\') ++i;
        } else if (c == '[' || c == '{') {
            shape.objects += c == '{';
            ++shape.values;
            shape.depth = std::max(shape.depth, ++open);
        } else if (c == ',') {
            ++shape.values;
        } else if ((c == ']' || c == '}') && open > 0) {
            --open;
        }
    }
    ++shape.values;
    return shape;
}

}  // namespace diptych
