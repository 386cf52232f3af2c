// SPDX-License-Identifier: MIT
// Checks markup that another machine wrote, before it becomes a part of a page or of junit.xml.
#pragma once

#include <string_view>

namespace diptych::page {

// Throws std::runtime_error, one line without a file's name, unless the text is well-formed and has only
// elements and attributes that the pages' writers emit. So it cannot leave its place, run a script, load
// from elsewhere, navigate or restyle the page.
void checkMarkup(std::string_view html);

// The same for suites of junit.xml.
void checkSuites(std::string_view xml);

}  // namespace diptych::page
