// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

namespace diptych {

// Shared memory of a workgroup in bytes, for a specialized module (shared/vulkan/spirv/specialize.h), where
// array lengths are constants. The sum of all variables, without the driver's padding.
std::uint64_t sharedBytes(std::span<const std::uint32_t> words);

}  // namespace diptych
