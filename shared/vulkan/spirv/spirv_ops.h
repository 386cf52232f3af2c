// SPDX-License-Identifier: MIT
// Opcodes of SPIR-V 1.6 that this program reads, numbers as in section 3.49 of the specification; and their
// instructions.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace diptych::spirv {

enum Op : std::uint32_t {
    OpUndef = 1,
    OpName = 5,
    OpMemberName = 6,
    OpExtInst = 12,
    OpEntryPoint = 15,
    OpCapability = 17,
    OpTypeVoid = 19,
    OpTypeBool = 20,
    OpTypeInt = 21,
    OpTypeFloat = 22,
    OpTypeVector = 23,
    OpTypeMatrix = 24,
    OpTypeImage = 25,
    OpTypeArray = 28,
    OpTypeStruct = 30,
    OpTypePointer = 32,
    OpTypeFunction = 33,
    OpTypeForwardPointer = 39,
    OpConstantTrue = 41,
    OpConstantFalse = 42,
    OpConstant = 43,
    OpConstantComposite = 44,
    OpConstantNull = 46,
    OpSpecConstantTrue = 48,
    OpSpecConstantFalse = 49,
    OpSpecConstant = 50,
    OpSpecConstantComposite = 51,
    OpSpecConstantOp = 52,
    OpFunction = 54,
    OpFunctionEnd = 56,
    OpVariable = 59,
    OpImageTexelPointer = 60,
    OpLoad = 61,
    OpStore = 62,
    OpAccessChain = 65,
    OpInBoundsAccessChain = 66,
    OpPtrAccessChain = 67,
    OpArrayLength = 68,
    OpDecorate = 71,
    OpMemberDecorate = 72,
    OpVectorShuffle = 79,
    OpCompositeExtract = 81,
    OpCompositeInsert = 82,
    OpCopyObject = 83,
    OpImageSampleImplicitLod = 87,
    OpImageSampleExplicitLod = 88,
    OpImageSampleDrefImplicitLod = 89,
    OpImageSampleDrefExplicitLod = 90,
    OpImageFetch = 95,
    OpImageGather = 96,
    OpImageDrefGather = 97,
    OpImageRead = 98,
    OpImageWrite = 99,
    OpBitcast = 124,
    OpIAdd = 128,
    OpISub = 130,
    OpIMul = 132,
    OpUDiv = 134,
    OpSDiv = 135,
    OpUMod = 137,
    OpSRem = 138,
    OpSMod = 139,
    OpLogicalEqual = 164,
    OpLogicalNotEqual = 165,
    OpLogicalOr = 166,
    OpLogicalAnd = 167,
    OpLogicalNot = 168,
    OpSelect = 169,
    OpIEqual = 170,
    OpINotEqual = 171,
    OpUGreaterThan = 172,
    OpSGreaterThan = 173,
    OpUGreaterThanEqual = 174,
    OpSGreaterThanEqual = 175,
    OpULessThan = 176,
    OpSLessThan = 177,
    OpULessThanEqual = 178,
    OpSLessThanEqual = 179,
    OpShiftRightLogical = 194,
    OpShiftLeftLogical = 196,
    OpBitwiseOr = 197,
    OpBitwiseXor = 198,
    OpBitwiseAnd = 199,
    OpNot = 200,
    OpBitCount = 205,
    OpPhi = 245,
    OpLoopMerge = 246,
    OpSelectionMerge = 247,
    OpLabel = 248,
    OpBranch = 249,
    OpBranchConditional = 250,
    OpSwitch = 251,
    OpKill = 252,
    OpReturn = 253,
    OpUnreachable = 255,
    OpExecutionModeId = 331,
    OpCopyLogical = 400,
    OpTerminateInvocation = 4416,
    OpDemoteToHelperInvocation = 5380,
};

// GLSL.std.450 instructions that store to memory, and the first that interpolates.
inline constexpr std::uint32_t extendedModf = 35, extendedFrexp = 51, extendedInterpolates = 76;

// Capabilities that a variant may not need.
inline constexpr std::uint32_t capabilityFloat16 = 9, capabilityInt64 = 11,
                               capabilityStorageImageMultisample = 27,
                               capabilityDemoteToHelperInvocation = 5379;

inline constexpr std::uint32_t decorationSpecId = 1, decorationBuiltIn = 11, decorationLocation = 30,
                               memoryVolatile = 1, storageInput = 1, storageOutput = 3;

inline constexpr std::uint32_t magicNumber = 0x07230203, headerWords = 5;

using Words = std::span<const std::uint32_t>;

inline std::uint32_t opOf(Words instruction) {
    return instruction[0] & 0xffff;
}

// Instruction at word `at` of a module.
inline Words instructionAt(Words module, std::size_t at) {
    return module.subspan(at, module[at] >> 16);
}

// Words of an instruction that are numbers, not ids: from `first` to before `end`.
struct Literals {
    std::size_t first, end;
};
Literals literalsOf(Words in);

// Calls `id` with every id that an instruction names, including its result and type.
template <typename Take>
void eachId(Words in, Take&& id) {
    const Literals literals = literalsOf(in);
    for (std::size_t i = 1; i < in.size(); ++i) {
        if (i >= literals.first && i < literals.end) continue;
        if (opOf(in) == OpSwitch && i > 2 && i % 2 == 1) continue;
        id(in[i]);
    }
}

// Whether an instruction has no side effect, so that it can be removed if its result is unused.
bool isPure(Words in);
bool isTerminator(std::uint32_t op);
// Whether an instruction in a function has a result.
bool hasResult(Words in);
// Id of the type, constant or variable that a global instruction declares; 0 if none.
std::uint32_t declaredBy(Words in);

}  // namespace diptych::spirv
