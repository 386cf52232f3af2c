// SPDX-License-Identifier: MIT
// Text and numbers as all our pages and tables show them.
#pragma once

#include "shared/frame/debug_modes.h"
#include "shared/frame/frame.h"

#include <cstdint>
#include <string>
#include <string_view>

namespace diptych::page {

// Text for HTML and XML, in elements and attributes: markup is escaped; what is no UTF-8, or no character
// that XML 1.0 allows, becomes U+FFFD.
std::string markup(std::string_view text);

std::string number(double value);        // three digits: "0.0123", "1.2e-07", "inf"
std::string bytes(std::uint64_t count);  // "1.25 MiB"

const char* unitOf(const DebugMode& mode);  // of its errors: a degree sign, or nothing

// "default view", or the camera's name, or what was asked for.
std::string cameraTitle(const Frame& frame);

}  // namespace diptych::page
