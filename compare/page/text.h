// SPDX-License-Identifier: MIT
// Text and numbers in the format of all pages and tables.
#pragma once

#include "shared/frame/debug_modes.h"
#include "shared/frame/frame.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace diptych::page {

// Escapes text for elements and attributes of HTML and XML. Invalid UTF-8, controls (isControl()) except
// tabs and line breaks, and characters that XML 1.0 does not allow become U+FFFD.
std::string markup(std::string_view text);

// The same for foreign text in a sentence or row; right-to-left letters do not affect their surroundings.
std::string isolated(std::string_view text);

std::string number(double value);        // three digits: "0.0123", "1.2e-07", "inf"
std::string percent(double fraction);    // "2.31 %"
std::string bytes(std::uint64_t count);  // "1.25 MiB"

const char* unitOf(const DebugMode& mode);  // unit of the channel's errors: a degree sign or empty

// The common folder of `paths`, ending in a slash; for a single path, its folder. Names that begin with a
// word and a colon ("builtin:gallery") are ignored.
std::string commonFolder(const std::vector<std::string>& paths);

// `path` without `folder`: "c/Box.glb" of "/a/b/c/Box.glb" in "/a/b/".
std::string inFolder(std::string_view path, std::string_view folder);

// Escapes a name and allows line breaks after its underscores.
std::string breakable(std::string_view name);

// The camera's name, else --camera as given, else "default view".
std::string cameraTitle(const Frame& frame);

}  // namespace diptych::page
