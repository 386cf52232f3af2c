// SPDX-License-Identifier: MIT
#include "compare/probe/run.h"

#include <bit>

namespace diptych::probe {
namespace {

// The result of operations.comp for one row.
float resultOf(DeviceRows& rows, std::uint32_t function, const std::vector<float>& in) {
    Probe probe;
    probe.name = "of rounding";
    probe.shader = "operations.comp";
    probe.function = function;
    probe.ins = in.size();
    return rows.run(probe, in)[0];
}

constexpr std::uint32_t add_function = 9, multiply_function = 10, fma_function = 11,
                        half_function = 12;  // indices in operations.comp

}  // namespace

std::vector<DeviceProperty> roundingProperties(Device& device) {
    DeviceRows rows(device);
    const auto gives = [&](std::uint32_t function, const std::vector<float>& in, float expected) {
        return resultOf(rows, function, in) == expected;
    };
    const bool results = gives(multiply_function, {0x1p-100f, 0x1p-30f}, std::bit_cast<float>(1u << 19)),
               operands = gives(multiply_function, {std::bit_cast<float>(1u << 19), 0x1p20f}, 0x1p-110f);
    // Three quarters of the last place, and two ties: to the even neighbour below and above.
    const bool nearest = gives(add_function, {1, 0x1.8p-24f}, 1 + 0x1p-23f) &&
                         gives(add_function, {1, 0x1p-24f}, 1) &&
                         gives(add_function, {1 + 0x1p-23f, 0x1p-24f}, 1 + 0x1p-22f);
    const bool once = gives(fma_function, {1 + 0x1p-12f, 1 + 0x1p-12f, -(1 + 0x1p-11f)}, 0x1p-24f);
    const bool halves = gives(half_function, {1 + 0x1.8p-11f}, 1 + 0x1p-10f) &&
                        gives(half_function, {2049}, 2048) && gives(half_function, {2051}, 2052);
    const bool small_halves = gives(half_function, {0x1p-20f}, 0x1p-20f);
    return {{"denormal results are kept", results, false, results ? "" : "they are flushed to 0"},
            {"denormal operands are kept", operands, false, operands ? "" : "they are treated as 0"},
            {"sums are rounded to nearest, even", nearest, false, ""},
            {"fma() is rounded once", once, false, once ? "" : "product and sum are each rounded"},
            {"packHalf2x16() rounds to nearest, even", halves, false,
             halves ? "" : "no effect here: no shader packs halves"},
            {"denormal halves are kept", small_halves, false, small_halves ? "" : "they are flushed to 0"}};
}

}  // namespace diptych::probe
