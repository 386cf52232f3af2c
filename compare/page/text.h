// SPDX-License-Identifier: MIT
// Text and numbers as all our pages and tables show them.
#pragma once

#include "shared/frame/debug_modes.h"
#include "shared/frame/frame.h"

#include <cstdint>
#include <string>
#include <string_view>

namespace diptych::page {

// Escapes text for elements and attributes of HTML and XML. Bytes that are not UTF-8, and characters that
// XML 1.0 does not allow, become U+FFFD.
std::string markup(std::string_view text);

std::string number(double value);        // three digits: "0.0123", "1.2e-07", "inf"
std::string bytes(std::uint64_t count);  // "1.25 MiB"

const char* unitOf(const DebugMode& mode);  // unit of the channel's errors: a degree sign or empty

// The camera's name, else --camera as given, else "default view".
std::string cameraTitle(const Frame& frame);

}  // namespace diptych::page
