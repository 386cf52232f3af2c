// SPDX-License-Identifier: MIT
#include "shared/vulkan/spirv/spirv_fold.h"

#include "shared/vulkan/spirv/spirv_ops.h"

#include <bit>

namespace diptych {

namespace {

using namespace spirv;

using Folded = std::optional<std::uint32_t>;

// Result that one operand determines, whatever the other is.
Folded absorbed(std::uint32_t operation, Folded a, Folded b) {
    switch (operation) {
        case OpLogicalAnd:
            if ((a && *a == 0) || (b && *b == 0)) return 0;
            break;
        case OpLogicalOr:
            if ((a && *a != 0) || (b && *b != 0)) return 1;
            break;
        case OpBitwiseAnd:
        case OpIMul:
            if ((a && *a == 0) || (b && *b == 0)) return 0;
            break;
        case OpULessThan:
            if (b && *b == 0) return 0;
            break;
        case OpUGreaterThan:
            if (a && *a == 0) return 0;
            break;
        case OpUGreaterThanEqual:
            if (b && *b == 0) return 1;
            break;
        case OpULessThanEqual:
            if (a && *a == 0) return 1;
            break;
        default:
            break;
    }
    return std::nullopt;
}

Folded foldedOne(std::uint32_t operation, std::uint32_t a) {
    switch (operation) {
        case OpLogicalNot:
            return a == 0;
        case OpNot:
            return ~a;
        case OpBitCount:
            return static_cast<std::uint32_t>(std::popcount(a));
        case OpBitcast:
        case OpCopyObject:
            return a;
        default:
            return std::nullopt;
    }
}

Folded foldedTwo(std::uint32_t operation, std::uint32_t a, std::uint32_t b) {
    const auto signedA = static_cast<std::int32_t>(a), signedB = static_cast<std::int32_t>(b);
    switch (operation) {
        case OpIAdd:
            return a + b;
        case OpISub:
            return a - b;
        case OpIMul:
            return a * b;
        case OpUDiv:
            return b == 0 ? std::nullopt : std::optional(a / b);
        case OpUMod:
            return b == 0 ? std::nullopt : std::optional(a % b);
        case OpShiftRightLogical:
            return b > 31 ? std::nullopt : std::optional(a >> b);
        case OpShiftLeftLogical:
            return b > 31 ? std::nullopt : std::optional(a << b);
        case OpBitwiseOr:
            return a | b;
        case OpBitwiseXor:
            return a ^ b;
        case OpBitwiseAnd:
            return a & b;
        case OpLogicalAnd:
            return a != 0 && b != 0;
        case OpLogicalOr:
            return a != 0 || b != 0;
        case OpLogicalEqual:
        case OpIEqual:
            return a == b;
        case OpLogicalNotEqual:
        case OpINotEqual:
            return a != b;
        case OpULessThan:
            return a < b;
        case OpULessThanEqual:
            return a <= b;
        case OpUGreaterThan:
            return a > b;
        case OpUGreaterThanEqual:
            return a >= b;
        case OpSLessThan:
            return signedA < signedB;
        case OpSLessThanEqual:
            return signedA <= signedB;
        case OpSGreaterThan:
            return signedA > signedB;
        case OpSGreaterThanEqual:
            return signedA >= signedB;
        default:
            return std::nullopt;
    }
}

}  // namespace

std::optional<std::uint32_t> folded(std::uint32_t operation, std::optional<std::uint32_t> a,
                                    std::optional<std::uint32_t> b) {
    if (const Folded result = absorbed(operation, a, b)) return result;
    if (!a) return std::nullopt;
    return b ? foldedTwo(operation, *a, *b) : foldedOne(operation, *a);
}

}  // namespace diptych
