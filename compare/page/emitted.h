// SPDX-License-Identifier: MIT
// Checks markup that another machine wrote, before it becomes a part of a page or of junit.xml.
#pragma once

#include <string_view>

namespace diptych::page {

// Parts of a report are written before their position in it is known (compare/report/parts.h). These
// characters stand for what depends on it. No text has them: markup() replaces them by U+FFFD.
inline constexpr std::string_view indexPlaceholder = "\x01";  // the comparison's index
inline constexpr std::string_view titleLater = "\x02";        // its title
inline constexpr std::string_view folderLater = "\x03";       // the report's folder and a slash, in junit.xml

// Throws std::runtime_error, one line without a file's name, unless the text is well-formed and has only
// elements and attributes that the pages' writers emit. So it cannot leave its place, run a script, load
// from elsewhere, navigate or restyle the page.
void checkMarkup(std::string_view html);

// The same for suites of junit.xml.
void checkSuites(std::string_view xml);

}  // namespace diptych::page
