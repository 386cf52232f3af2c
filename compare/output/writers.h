// SPDX-License-Identifier: MIT
// Writers of tables and documents, one an output.
#pragma once

#include "compare/output/document.h"

#include <cstddef>
#include <string>
#include <string_view>

namespace diptych::output {

// Lines [first, last) of a table for a terminal; line 0 has the heads. Widths are those of all lines.
std::string inText(const Table& table, std::size_t first = 0, std::size_t last = ~std::size_t{0});

// For a terminal: a line for each heading, paragraph and term, items of lists indented by two spaces. Boxes
// that open at a click, images and drawings are omitted.
std::string inText(const std::vector<Block>& blocks);

// RFC 4180: fields with a comma, a quote or a line break are quoted.
std::string inCsv(const Table& table);

// All texts are escaped.
std::string inHtml(const Text& text);
std::string inHtml(const Block& block);
std::string inHtml(const std::vector<Block>& blocks);
// A page without external resources, readable from file://.
std::string inHtml(const Document& document);

// For a page of another machine: throws std::runtime_error unless it is what inHtml() may write for a
// document with this style and script (compare/page/emitted.h).
void checkPage(std::string_view page, std::string_view style, std::string_view script);

}  // namespace diptych::output
