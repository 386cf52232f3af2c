// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace diptych::reference {

struct Request;

// A hash of everything that decides a pixel of the picture, including the program's version. Kept parts of a
// picture are only used if their key is the same.
std::uint64_t keyOf(const Request& request);

}  // namespace diptych::reference
