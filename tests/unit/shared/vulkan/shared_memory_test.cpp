// SPDX-License-Identifier: MIT
// Shared memory of the shipped compute shaders, and of a module made word by word.
#include "shared/vulkan/spirv/shared_memory.h"
#include "shared/vulkan/spirv/specialize.h"
#include "shared/vulkan/spirv/spirv.h"

#include <gtest/gtest.h>

namespace diptych {
namespace {

constexpr std::uint32_t op(std::uint32_t words, std::uint32_t code) {
    return words << 16 | code;
}

// shared struct { vec3 a; mat2 b; uint c[5]; bool d; } x[7]; shared float y; and a private variable.
TEST(SharedMemory, IsTheSumOfItsVariables) {
    const std::vector<std::uint32_t> module{
        0x07230203, 0x00010600, 0,         30, 0,             // the header
        op(3, 22),  1,          32,                           // %1 float
        op(4, 23),  2,          1,         3,                 // %2 vec3
        op(4, 23),  3,          1,         2,                 // %3 vec2
        op(4, 24),  4,          3,         2,                 // %4 mat2
        op(4, 21),  5,          32,        0,                 // %5 uint
        op(4, 43),  5,          6,         5,                 // %6 5
        op(4, 28),  7,          5,         6,                 // %7 uint[5]
        op(2, 20),  8,                                        // %8 bool
        op(6, 30),  9,          2,         4,  7,         8,  // %9 the struct
        op(4, 43),  5,          10,        7,                 // %10 7
        op(4, 28),  11,         9,         10,                // %11 struct[7]
        op(4, 32),  12,         4,         11, op(4, 32), 13,
        4,          1,          op(4, 32), 14, 6,         11,  // pointers: workgroup, private
        op(4, 59),  12,         15,        4,  op(4, 59), 13,
        16,         4,          op(4, 59), 14, 17,        6};
    EXPECT_EQ(sharedBytes(module), 7u * (12 + 16 + 20 + 4) + 4);
    EXPECT_EQ(sharedBytes(std::span(module).first(module.size() - 12)), 0u) << "types alone";
}

TEST(SharedMemory, OfKernelsIsWithinWhatEveryDeviceHas) {
    std::size_t sharing = 0;
    for (const ShaderModule& module : shaderModules()) {
        if (module.name.find(".comp") == std::string_view::npos) continue;
        const std::uint64_t bytes = sharedBytes(specialized(module.words, [](std::uint32_t) { return 0u; }));
        EXPECT_LE(bytes, 16384u) << module.name;
        sharing += bytes > 0;
    }
    EXPECT_GT(sharing, 0u) << "a kernel that shares something was not seen";
}

}  // namespace
}  // namespace diptych
