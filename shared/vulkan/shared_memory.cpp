// SPDX-License-Identifier: MIT
#include "shared/vulkan/shared_memory.h"

#include <map>

namespace diptych {

namespace {

// Opcodes and the storage class of SPIR-V 1.6, sections 3.49 and 3.7.
enum TypeOp : std::uint32_t {
    TypeBoolOp = 20,
    TypeIntOp = 21,
    TypeFloatOp = 22,
    TypeVectorOp = 23,
    TypeMatrixOp = 24,
    TypeArrayOp = 28,
    TypeStructOp = 30,
    TypePointerOp = 32,
    ConstantOp = 43,
    VariableOp = 59,
};
constexpr std::uint32_t workgroupStorage = 4;

}  // namespace

std::uint64_t sharedBytes(std::span<const std::uint32_t> words) {
    std::map<std::uint32_t, std::uint64_t> bytes;      // of a type; of a pointer those of what it points to
    std::map<std::uint32_t, std::uint32_t> constants;  // of 32 bits
    std::uint64_t sum = 0;
    constexpr std::size_t header = 5;
    for (std::size_t at = header; at < words.size();) {
        const std::span<const std::uint32_t> op = words.subspan(at, words[at] >> 16);
        if (op.empty()) break;
        at += op.size();
        switch (op[0] & 0xffff) {
            case TypeBoolOp:
                bytes[op[1]] = 4;
                break;
            case TypeIntOp:
            case TypeFloatOp:
                bytes[op[1]] = op[2] / 8;
                break;
            case TypeVectorOp:
            case TypeMatrixOp:
                bytes[op[1]] = bytes[op[2]] * op[3];
                break;
            case TypeArrayOp:
                bytes[op[1]] = bytes[op[2]] * constants[op[3]];
                break;
            case TypeStructOp:
                for (const std::uint32_t member : op.subspan(2)) bytes[op[1]] += bytes[member];
                break;
            case TypePointerOp:
                bytes[op[1]] = bytes[op[3]];
                break;
            case ConstantOp:
                constants[op[2]] = op[3];
                break;
            case VariableOp:
                if (op[3] == workgroupStorage) sum += bytes[op[1]];
                break;
            default:
                break;
        }
    }
    return sum;
}

}  // namespace diptych
