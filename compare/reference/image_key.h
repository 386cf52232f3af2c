// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace diptych::reference {

struct Request;

// A hash of everything that affects a pixel, including the program's version. Saved parts are reused only
// if their key matches.
std::uint64_t keyOf(const Request& request);

}  // namespace diptych::reference
