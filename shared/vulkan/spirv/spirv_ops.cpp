// SPDX-License-Identifier: MIT
#include "shared/vulkan/spirv/spirv_ops.h"

namespace diptych::spirv {

Literals literalsOf(Words in) {
    switch (opOf(in)) {
        case OpSelectionMerge:
        case OpTypeForwardPointer:
        case OpTypeInt:
        case OpTypeFloat:
            return {2, in.size()};
        case OpTypePointer:
            return {2, 3};
        case OpLoopMerge:
        case OpTypeVector:
        case OpTypeMatrix:
        case OpTypeImage:
        case OpConstant:
        case OpSpecConstant:
        case OpStore:
            return {3, in.size()};
        case OpVariable:
        case OpFunction:
        case OpSpecConstantOp:
            return {3, 4};
        case OpLoad:
        case OpArrayLength:
        case OpCompositeExtract:
        case OpBranchConditional:
            return {4, in.size()};
        case OpExtInst:
        case OpImageWrite:
            return {4, 5};
        case OpCompositeInsert:
        case OpVectorShuffle:
            return {5, in.size()};
        case OpImageSampleImplicitLod:
        case OpImageSampleExplicitLod:
        case OpImageFetch:
        case OpImageRead:
            return {5, 6};
        case OpImageSampleDrefImplicitLod:
        case OpImageSampleDrefExplicitLod:
        case OpImageGather:
        case OpImageDrefGather:
            return {6, 7};
        default:
            return {in.size(), in.size()};
    }
}

bool isPure(Words in) {
    const std::uint32_t op = opOf(in);
    switch (op) {
        case OpExtInst:
            return in[4] != extendedModf && in[4] != extendedFrexp;
        case OpLoad:
            return in.size() < 5 || (in[4] & memoryVolatile) == 0;
        case OpUndef:
        case OpVariable:
        case OpPhi:
        case OpImageTexelPointer:
        case OpAccessChain:
        case OpInBoundsAccessChain:
        case OpPtrAccessChain:
        case OpArrayLength:
        case OpCopyLogical:
            return true;
        default:
            // Composites, conversions, arithmetic, comparisons, bits and derivatives; image samples,
            // fetches, gathers and queries. Excludes image reads and writes, atomics and group operations.
            return (op >= 77 && op <= 97) || op == 100 || (op >= 103 && op <= 107) ||
                   (op >= 109 && op <= 215);
    }
}

bool isTerminator(std::uint32_t op) {
    return (op >= OpBranch && op <= OpUnreachable) || op == OpTerminateInvocation;
}

// Without a result: stores and memory copies (62 to 64), image writes (99), barriers (224, 225), atomic
// stores (228), merges, and demote (5380).
bool hasResult(Words in) {
    const std::uint32_t op = opOf(in);
    return in.size() > 2 && !(op >= 62 && op <= 64) && op != 99 && op != 224 && op != 225 && op != 228 &&
           op != OpLoopMerge && op != OpSelectionMerge && op != 5380;
}

std::uint32_t declaredBy(Words in) {
    const std::uint32_t op = opOf(in);
    if (op >= OpTypeVoid && op <= OpTypeFunction) return in[1];
    if ((op >= OpConstantTrue && op <= OpSpecConstantOp) || op == OpVariable || op == OpUndef) return in[2];
    return 0;
}

}  // namespace diptych::spirv
