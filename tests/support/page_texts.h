// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace diptych {

// The texts of a page's body, one a line: without plots and scripts.
inline std::string pageTexts(const std::string& page) {
    std::string texts;
    bool text = false;  // after a tag that begins one
    for (std::size_t i = page.find("<body"); i < page.size(); ++i) {
        for (const std::string left_out : {"svg", "script", "style"})
            if (page.compare(i, left_out.size() + 1, "<" + left_out) == 0)
                i = page.find("</" + left_out + ">", i);
        if (page[i] == '<') {
            i = page.find('>', i);
            text = false;
        } else if (page[i] != '\n') {
            if (!text && !texts.empty()) texts += '\n';
            text = true;
            texts += page[i];
        }
    }
    return texts;
}

}  // namespace diptych
