// SPDX-License-Identifier: MIT
// One budget, for all files of a command, of memory that files claim without holding as many bytes.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

namespace diptych {

// Counts against the budget as long as a copy exists.
using Claim = std::shared_ptr<const void>;

// Call before allocating `bytes` for a file of `held` bytes. What 64 times `held` exceeds is claimed: a
// photograph as JPEG or WebP has half a bit a pixel at least, and 4 bytes decoded. All claims together may
// have 2 GiB. Throws std::runtime_error without the file's name, if it is more: "an image of 16384 x 16384
// pixels: ...".
Claim claimMemory(std::uint64_t bytes, std::uint64_t held, const std::string& what);

}  // namespace diptych
