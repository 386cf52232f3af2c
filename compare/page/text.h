// SPDX-License-Identifier: MIT
// Text and numbers as all our pages and tables show them.
#pragma once

#include "shared/frame/debug_modes.h"
#include "shared/frame/frame.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace diptych::page {

// Escapes text for elements and attributes of HTML and XML. Bytes that are not UTF-8, controls (isControl())
// but for tabs and line breaks, and characters that XML 1.0 does not allow, become U+FFFD.
std::string markup(std::string_view text);

// The same for text from outside within a sentence or a row of a page: letters that are written from right to
// left stay within it.
std::string isolated(std::string_view text);

std::string number(double value);        // three digits: "0.0123", "1.2e-07", "inf"
std::string percent(double share);       // "2.31 %"
std::string bytes(std::uint64_t count);  // "1.25 MiB"

const char* unitOf(const DebugMode& mode);  // unit of the channel's errors: a degree sign or empty

// The folders that all of `paths` are in, with a slash at the end; of a single path all of its own. What
// begins with a word and a colon ("builtin:gallery") is no path and does not count.
std::string commonFolder(const std::vector<std::string>& paths);

// `path` without `folder`: "c/Box.glb" of "/a/b/c/Box.glb" in "/a/b/".
std::string inFolder(std::string_view path, std::string_view folder);

// A name that may be broken into lines after its underscores, escaped.
std::string breakable(std::string_view name);

// A table's cell with a number; `text`: as it is shown. Tables are sorted by the number, what is infinite
// last.
std::string numberCell(double value, std::string_view text);

// A line of comma-separated values with its end (RFC 4180): a field is quoted where it holds a comma, a quote
// or a line break.
std::string csvLine(const std::vector<std::string>& fields);

// The camera's name, else --camera as given, else "default view".
std::string cameraTitle(const Frame& frame);

}  // namespace diptych::page
