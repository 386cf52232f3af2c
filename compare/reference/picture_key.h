// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace diptych::reference {

struct Request;

// A hash of everything that decides a pixel of the picture, the program's version among it: what is kept of
// another one is not gone on from.
std::uint64_t keyOf(const Request& request);

}  // namespace diptych::reference
