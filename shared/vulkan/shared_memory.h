// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

namespace diptych {

// Bytes of the variables that a workgroup shares, of a specialised module (shared/vulkan/specialize.h): array
// lengths are constants. Variables are counted one after the other, without what a driver adds between them.
std::uint64_t sharedBytes(std::span<const std::uint32_t> words);

}  // namespace diptych
