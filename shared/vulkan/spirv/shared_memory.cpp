// SPDX-License-Identifier: MIT
#include "shared/vulkan/spirv/shared_memory.h"

#include "shared/vulkan/spirv/spirv_ops.h"

#include <map>

namespace diptych {

namespace {

using namespace spirv;

constexpr std::uint32_t workgroupStorage = 4;  // a storage class, section 3.7

}  // namespace

std::uint64_t sharedBytes(std::span<const std::uint32_t> words) {
    std::map<std::uint32_t, std::uint64_t> bytes;      // by type; of a pointer, those of its target
    std::map<std::uint32_t, std::uint32_t> constants;  // 32-bit values
    std::uint64_t sum = 0;
    for (std::size_t at = headerWords; at < words.size();) {
        const Words op = instructionAt(words, at);
        if (op.empty()) break;
        at += op.size();
        switch (opOf(op)) {
            case OpTypeBool:
                bytes[op[1]] = 4;
                break;
            case OpTypeInt:
            case OpTypeFloat:
                bytes[op[1]] = op[2] / 8;
                break;
            case OpTypeVector:
            case OpTypeMatrix:
                bytes[op[1]] = bytes[op[2]] * op[3];
                break;
            case OpTypeArray:
                bytes[op[1]] = bytes[op[2]] * constants[op[3]];
                break;
            case OpTypeStruct:
                for (const std::uint32_t member : op.subspan(2)) bytes[op[1]] += bytes[member];
                break;
            case OpTypePointer:
                bytes[op[1]] = bytes[op[3]];
                break;
            case OpConstant:
                constants[op[2]] = op[3];
                break;
            case OpVariable:
                if (op[3] == workgroupStorage) sum += bytes[op[1]];
                break;
            default:
                break;
        }
    }
    return sum;
}

}  // namespace diptych
