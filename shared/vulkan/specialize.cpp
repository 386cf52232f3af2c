// SPDX-License-Identifier: MIT
// Sparse conditional constant propagation (Wegman and Zadeck, "Constant propagation with conditional
// branches", TOPLAS 13(2), 1991) in one pass over the blocks. Loops are not iterated, so values that a
// loop changes count as unknown. Then marks everything that live code reads, starting at side effects, and
// writes the live code and the declarations that it names.
#include "shared/vulkan/specialize.h"

#include "shared/vulkan/spirv_ops.h"

#include <algorithm>
#include <bit>
#include <map>
#include <stdexcept>
#include <utility>

namespace diptych {

namespace {

using namespace spirv;

constexpr std::uint32_t decorationSpecId = 1, decorationBuiltIn = 11, decorationLocation = 30,
                        memoryVolatile = 1, storageInput = 1, storageOutput = 3;

constexpr std::uint32_t none = ~0u;

// Calls `id` with every id that an instruction names, including its result and type.
template <typename Take>
void eachId(Words in, Take&& id) {
    struct Literals {  // words that are numbers
        std::size_t first, end;
    };
    const std::uint32_t op = opOf(in);
    const Literals literals = [&]() -> Literals {
        switch (op) {
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
    }();
    for (std::size_t i = 1; i < in.size(); ++i) {
        if (i >= literals.first && i < literals.end) continue;
        if (op == OpSwitch && i > 2 && i % 2 == 1) continue;
        id(in[i]);
    }
}

// Whether an instruction has no side effect, so that it can be removed if its result is unused.
bool isPure(std::span<const std::uint32_t> in) {
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

// Variables of a storage class with a location, by id, and all their locations: one for a vector, one per
// matrix column, the elements' for an array.
std::map<std::uint32_t, std::vector<std::uint32_t>> interfaceOf(Words module, std::uint32_t storage) {
    std::map<std::uint32_t, std::uint32_t> taken, pointed, first, numbers;  // by id
    std::map<std::uint32_t, std::vector<std::uint32_t>> found;
    const auto ofType = [&](std::uint32_t type) { return std::max(1u, taken[type]); };
    std::size_t at = headerWords;
    for (Words in; at < module.size() && opOf(in = instructionAt(module, at)) != OpFunction;
         at += in.size()) {
        switch (opOf(in)) {
            case OpDecorate:
                if (in[2] == decorationLocation) first[in[1]] = in[3];
                break;
            case OpConstant:
                numbers[in[2]] = in[3];
                break;
            case OpTypeMatrix:
                taken[in[1]] = in[3];
                break;
            case OpTypeArray:
                taken[in[1]] = numbers[in[3]] * ofType(in[2]);
                break;
            case OpTypePointer:
                pointed[in[1]] = in[3];
                break;
            case OpVariable:
                if (in[3] != storage || !first.contains(in[2])) break;
                for (std::uint32_t i = 0; i < ofType(pointed[in[1]]); ++i)
                    found[in[2]].push_back(first[in[2]] + i);
                break;
            default:
                break;
        }
    }
    return found;
}

class Specializer {
public:
    Specializer(std::span<const std::uint32_t> words, const SpecializationValue& value,
                const std::optional<std::set<std::uint32_t>>& outputs)
        : words_(words), value_(value) {
        if (words.size() < headerWords || words[0] != magicNumber)
            throw std::logic_error("not a SPIR-V module");
        bound_ = words[3];
        bits_.resize(bound_);
        ids_.resize(bound_);
        readModule(outputs);
        readFunction();
    }

    std::vector<std::uint32_t> result() {
        propagate();
        keepStructure();
        mark();
        return written();
    }

private:
    struct Id {
        std::uint32_t at = 0;        // of its instruction in the function; 0: declared outside
        std::uint32_t type = 0;      // result type
        std::uint32_t copied = 0;    // equals this id
        std::uint32_t spec = none;   // SpecId of a specialization constant
        std::uint32_t block = none;  // of a label
        bool scalar = false;         // a type: bool, or 32-bit integer or float
        bool boolean = false;        // a type: bool
        bool known = false;          // its value is in bits_
        bool marked = false;
        bool unread = false;  // an output that no later stage reads
        bool named = false;   // live code names it
    };
    struct Block {
        std::uint32_t first = 0, last = 0;  // instructions: indices into at_; the last is the terminator
        std::uint32_t label = 0, merge = 0, loop_continue = 0;  // ids; of merge instructions, 0: none
        std::vector<std::uint32_t> targets;                     // successor blocks
        std::vector<std::uint32_t> taken;                       // remaining successors
        bool alive = false;
        bool stub = false;             // unreachable, but a live construct names it
        std::uint32_t stub_to = none;  // loop header that a stub of a continue target branches to
        std::uint32_t stub_from = 0;   // label of the stub that branches to this loop header
        bool declares_merge = false;   // writes a merge instruction, which names `merge`
    };

    std::span<const std::uint32_t> instruction(std::uint32_t at) const { return instructionAt(words_, at); }
    std::uint32_t op(std::uint32_t at) const { return words_[at] & 0xffff; }

    void readModule(const std::optional<std::set<std::uint32_t>>& outputs) {
        std::uint32_t at = headerWords;
        for (; at < words_.size() && op(at) != OpFunction; at += words_[at] >> 16) {
            const auto in = instruction(at);
            switch (op(at)) {
                case OpDecorate:
                    if (in[2] == decorationSpecId) ids_[in[1]].spec = in[3];
                    break;
                case OpTypeBool:
                    ids_[in[1]].scalar = ids_[in[1]].boolean = true;
                    break;
                case OpTypeInt:
                case OpTypeFloat:
                    ids_[in[1]].scalar = in[2] == 32;
                    break;
                case OpConstantTrue:
                case OpConstantFalse:
                    know(in[1], in[2], op(at) == OpConstantTrue);
                    break;
                case OpConstant:
                    if (ids_[in[1]].scalar) know(in[1], in[2], in[3]);
                    break;
                case OpConstantNull:
                    if (ids_[in[1]].scalar) know(in[1], in[2], 0);
                    break;
                case OpSpecConstantTrue:
                case OpSpecConstantFalse:
                    know(in[1], in[2],
                         ids_[in[2]].spec == none ? op(at) == OpSpecConstantTrue
                                                  : value_(ids_[in[2]].spec) != 0);
                    break;
                case OpSpecConstant:
                    if (!ids_[in[1]].scalar)
                        throw std::logic_error("a specialization constant is not of 32 bits");
                    know(in[1], in[2], ids_[in[2]].spec == none ? in[3] : value_(ids_[in[2]].spec));
                    break;
                case OpSpecConstantOp:
                    if (const auto folded = fold(in[3], in[1], in.subspan(4))) know(in[1], in[2], *folded);
                    break;
                default:
                    break;
            }
        }
        function_ = at;
        if (!outputs) return;
        for (const auto& [variable, locations] : interfaceOf(words_, storageOutput))
            ids_[variable].unread = std::ranges::none_of(
                locations, [&](std::uint32_t location) { return outputs->contains(location); });
    }

    void readFunction() {
        std::uint32_t at = function_;
        if (at >= words_.size()) throw std::logic_error("the module has no function");
        at += words_[at] >> 16;
        for (; at < words_.size() && op(at) != OpFunctionEnd; at += words_[at] >> 16) {
            const auto in = instruction(at);
            if (op(at) == OpLabel) {
                ids_[in[1]].block = static_cast<std::uint32_t>(blocks_.size());
                blocks_.emplace_back();
                blocks_.back().label = in[1];
                blocks_.back().first = static_cast<std::uint32_t>(at_.size());
                continue;
            }
            if (blocks_.empty()) throw std::logic_error("the function has parameters");
            Block& block = blocks_.back();
            block.last = static_cast<std::uint32_t>(at_.size());
            at_.push_back(at);
            if (op(at) == OpLoopMerge || op(at) == OpSelectionMerge) block.merge = in[1];
            if (op(at) == OpLoopMerge) block.loop_continue = in[2];
            if (isTerminator(op(at)) || !hasResult(in)) continue;
            ids_[in[2]].at = at;
            ids_[in[2]].type = in[1];
        }
        if (at >= words_.size()) throw std::logic_error("the function has no end");
        end_ = at + (words_[at] >> 16);
        if (end_ != words_.size()) throw std::logic_error("the module has several functions");
        for (Block& block : blocks_) {
            const auto in = instruction(at_[block.last]);
            const auto to = [&](std::uint32_t label) {
                const std::uint32_t target = ids_[label].block;
                if (std::ranges::find(block.targets, target) == block.targets.end())
                    block.targets.push_back(target);
            };
            if (op(at_[block.last]) == OpBranch) to(in[1]);
            if (op(at_[block.last]) == OpBranchConditional) to(in[2]), to(in[3]);
            if (op(at_[block.last]) == OpSwitch) {
                to(in[2]);
                for (std::size_t i = 4; i < in.size(); i += 2) to(in[i]);
            }
        }
    }

    static bool isTerminator(std::uint32_t op) {
        return (op >= OpBranch && op <= OpUnreachable) || op == OpTerminateInvocation;
    }
    // Whether an instruction in a function has a result. Exceptions: stores and memory copies (62 to 64),
    // image writes (99), barriers (224, 225), atomic stores (228), merges, and demote (5380).
    static bool hasResult(std::span<const std::uint32_t> in) {
        const std::uint32_t op = opOf(in);
        return in.size() > 2 && !(op >= 62 && op <= 64) && op != 99 && op != 224 && op != 225 && op != 228 &&
               op != OpLoopMerge && op != OpSelectionMerge && op != 5380;
    }

    void know(std::uint32_t type, std::uint32_t id, std::uint32_t bits) {
        ids_[id].type = type;
        ids_[id].known = true;
        bits_[id] = bits;
    }
    std::optional<std::uint32_t> known(std::uint32_t id) const {
        if (!ids_[id].known) return std::nullopt;
        return bits_[id];
    }

    // Result of an operation on integers or bools, if the operands determine it. Division by zero and
    // shifts by 32 or more are undefined and left to the device.
    std::optional<std::uint32_t> fold(std::uint32_t operation, std::uint32_t type,
                                      std::span<const std::uint32_t> operands) const {
        if (type >= bound_ || !ids_[type].scalar || operands.empty()) return std::nullopt;
        const auto a = known(operands[0]);
        const auto b = operands.size() > 1 ? known(operands[1]) : std::nullopt;
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
            case OpSelect:
                return a ? known(operands[*a != 0 ? 1 : 2]) : std::nullopt;
            default:
                break;
        }
        if (!a) return std::nullopt;
        switch (operation) {
            case OpLogicalNot:
                return *a == 0;
            case OpNot:
                return ~*a;
            case OpBitCount:
                return static_cast<std::uint32_t>(std::popcount(*a));
            case OpBitcast:
                return ids_[ids_[operands[0]].type].boolean ? std::nullopt : a;
            case OpCopyObject:
                return a;
            default:
                break;
        }
        if (!b || operands.size() != 2) return std::nullopt;
        const auto signedA = static_cast<std::int32_t>(*a), signedB = static_cast<std::int32_t>(*b);
        switch (operation) {
            case OpIAdd:
                return *a + *b;
            case OpISub:
                return *a - *b;
            case OpIMul:
                return *a * *b;
            case OpUDiv:
                return *b == 0 ? std::nullopt : std::optional(*a / *b);
            case OpUMod:
                return *b == 0 ? std::nullopt : std::optional(*a % *b);
            case OpShiftRightLogical:
                return *b > 31 ? std::nullopt : std::optional(*a >> *b);
            case OpShiftLeftLogical:
                return *b > 31 ? std::nullopt : std::optional(*a << *b);
            case OpBitwiseOr:
                return *a | *b;
            case OpBitwiseXor:
                return *a ^ *b;
            case OpBitwiseAnd:
                return *a & *b;
            case OpLogicalAnd:
                return *a != 0 && *b != 0;
            case OpLogicalOr:
                return *a != 0 || *b != 0;
            case OpLogicalEqual:
            case OpIEqual:
                return *a == *b;
            case OpLogicalNotEqual:
            case OpINotEqual:
                return *a != *b;
            case OpULessThan:
                return *a < *b;
            case OpULessThanEqual:
                return *a <= *b;
            case OpUGreaterThan:
                return *a > *b;
            case OpUGreaterThanEqual:
                return *a >= *b;
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

    // Reverse postorder: each block after its predecessors, except for back edges.
    std::vector<std::uint32_t> order() const {
        std::vector<std::uint32_t> blocks;
        std::vector<char> seen(blocks_.size());
        std::vector<std::pair<std::uint32_t, std::size_t>> stack{{0, 0}};
        seen[0] = 1;
        while (!stack.empty()) {
            auto& [block, next] = stack.back();
            if (next == blocks_[block].targets.size()) {
                blocks.push_back(block);
                stack.pop_back();
                continue;
            }
            const std::uint32_t target = blocks_[block].targets[next++];
            if (seen[target] != 0) continue;
            seen[target] = 1;
            stack.emplace_back(target, 0);
        }
        std::ranges::reverse(blocks);
        return blocks;
    }

    bool goesTo(std::uint32_t from, std::uint32_t to) const {
        return blocks_[from].alive && std::ranges::find(blocks_[from].taken, to) != blocks_[from].taken.end();
    }

    void propagate() {
        order_ = order();
        std::vector<std::uint32_t> place(blocks_.size(), none);
        for (std::uint32_t i = 0; i < order_.size(); ++i) place[order_[i]] = i;
        blocks_[0].alive = true;
        for (const std::uint32_t number : order_) {
            Block& block = blocks_[number];
            if (!block.alive) continue;
            for (std::uint32_t i = block.first; i < block.last; ++i) evaluate(number, at_[i]);
            const bool ends_loop = std::ranges::any_of(
                block.targets, [&](std::uint32_t target) { return place[target] <= place[number]; });
            const auto in = instruction(at_[block.last]);
            block.taken = block.targets;
            if (op(at_[block.last]) == OpBranchConditional && !ends_loop) {
                if (const auto condition = known(in[1]))
                    block.taken = {ids_[in[*condition != 0 ? 2 : 3]].block};
            } else if (op(at_[block.last]) == OpSwitch && !ends_loop) {
                if (const auto selector = known(in[1])) {
                    std::uint32_t label = in[2];
                    for (std::size_t k = 3; k + 1 < in.size(); k += 2)
                        if (in[k] == *selector) label = in[k + 1];
                    block.taken = {ids_[label].block};
                }
            }
            for (const std::uint32_t target : block.taken) blocks_[target].alive = true;
        }
    }

    void evaluate(std::uint32_t number, std::uint32_t at) {
        const auto in = instruction(at);
        if (!hasResult(in)) return;
        Id& id = ids_[in[2]];
        if (op(at) == OpPhi) {
            if (blocks_[number].loop_continue != 0 || !ids_[in[1]].scalar) return;
            std::optional<std::uint32_t> all;
            for (std::size_t i = 3; i < in.size(); i += 2) {
                if (!goesTo(ids_[in[i + 1]].block, number)) continue;
                const auto one = known(in[i]);
                if (!one || (all && *all != *one)) return;
                all = one;
            }
            if (all) know(in[1], in[2], *all);
            return;
        }
        if (const auto folded = fold(op(at), in[1], in.subspan(3))) {
            know(in[1], in[2], *folded);
        } else if (op(at) == OpSelect && known(in[3])) {
            id.copied = in[*known(in[3]) != 0 ? 4 : 5];
        } else if (op(at) == OpLogicalAnd || op(at) == OpLogicalOr) {
            // The known operand does not decide the result; otherwise fold() would.
            if (known(in[3])) id.copied = in[4];
            if (known(in[4])) id.copied = in[3];
        }
    }

    // Live constructs need the blocks they name, even if unreachable. A branch out of a removed construct
    // declares that construct's merge block as its own.
    void keepStructure() {
        std::vector<char> declared(bound_), dropped(bound_);
        for (const std::uint32_t number : order_) {
            Block& block = blocks_[number];
            if (!block.alive || block.merge == 0) continue;
            const bool loops = block.loop_continue != 0;
            block.declares_merge = loops || op(at_[block.last]) == OpSwitch || block.taken.size() > 1;
            if (!block.declares_merge) {
                dropped[block.merge] = 1;
                continue;
            }
            declared[block.merge] = 1;
            Block& merge = blocks_[ids_[block.merge].block];
            merge.stub |= !merge.alive;
            if (!loops) continue;
            declared[block.loop_continue] = 1;
            Block& next = blocks_[ids_[block.loop_continue].block];
            if (next.alive) continue;
            next.stub = true;
            next.stub_to = number;
            block.stub_from = next.label;
        }
        for (const std::uint32_t number : order_) {
            Block& block = blocks_[number];
            if (!block.alive || block.declares_merge || block.taken.size() < 2) continue;
            const auto label = [&](std::uint32_t target) { return blocks_[target].label; };
            if (std::ranges::any_of(block.taken, [&](std::uint32_t to) { return declared[label(to)] != 0; }))
                continue;
            const auto left =
                std::ranges::find_if(block.taken, [&](std::uint32_t to) { return dropped[label(to)] != 0; });
            if (left == block.taken.end()) throw std::logic_error("a branch leaves no construct");
            block.merge = label(*left);
            block.declares_merge = true;
            declared[block.merge] = 1;
        }
    }

    void mark() {
        for (const Block& block : blocks_) {
            if (!block.alive) continue;
            for (std::uint32_t i = block.first; i < block.last; ++i) {
                const auto in = instruction(at_[i]);
                const std::uint32_t operation = op(at_[i]);
                if (operation == OpSelectionMerge || operation == OpLoopMerge) continue;
                if (isUnread(in)) continue;
                if (!hasResult(in)) {
                    eachId(in, [&](std::uint32_t id) { need(id); });
                } else if (!isPure(in)) {
                    need(in[2]);
                }
            }
            const auto in = instruction(at_[block.last]);
            const std::uint32_t end = op(at_[block.last]);
            if (end == OpSwitch || (end == OpBranchConditional && block.taken.size() > 1)) need(in[1]);
        }
        while (!pending_.empty()) {
            const std::uint32_t id = pending_.back();
            pending_.pop_back();
            if (ids_[id].copied != 0) {
                need(ids_[id].copied);
                continue;
            }
            const auto in = instruction(ids_[id].at);
            if (op(ids_[id].at) != OpPhi) {
                eachId(in, [&](std::uint32_t operand) { need(operand); });
                continue;
            }
            for (std::size_t i = 3; i < in.size(); i += 2)
                if (blocks_[ids_[in[i + 1]].block].alive) need(in[i]);
        }
    }

    void need(std::uint32_t id) {
        if (ids_[id].marked || ids_[id].at == 0) return;
        ids_[id].marked = true;
        if (ids_[id].known)
            constants_.push_back(id);
        else
            pending_.push_back(id);
    }

    // Whether it stores to an output that no later stage reads.
    bool isUnread(std::span<const std::uint32_t> in) const {
        if (opOf(in) != OpStore) return false;
        std::uint32_t pointer = in[1];
        while (ids_[pointer].at != 0 &&
               (op(ids_[pointer].at) == OpAccessChain || op(ids_[pointer].at) == OpInBoundsAccessChain))
            pointer = instruction(ids_[pointer].at)[3];
        return ids_[pointer].unread;
    }

    void put(std::span<const std::uint32_t> in) { out_.insert(out_.end(), in.begin(), in.end()); }
    void put(std::uint32_t operation, std::initializer_list<std::uint32_t> words) {
        out_.push_back(static_cast<std::uint32_t>(words.size() + 1) << 16 | operation);
        out_.insert(out_.end(), words);
    }
    void putConstant(std::uint32_t id) {
        const std::uint32_t type = ids_[id].type;
        if (ids_[type].boolean)
            put(bits_[id] != 0 ? OpConstantTrue : OpConstantFalse, {type, id});
        else
            put(OpConstant, {type, id, bits_[id]});
    }

    std::vector<std::uint32_t> written() {
        for (const std::uint32_t id : constants_) putConstant(id);
        putUndefined();
        put(instruction(function_));
        for (const std::uint32_t number : writtenOrder()) putBlock(number);
        put(OpFunctionEnd, {});
        const std::vector<std::uint32_t> code = std::move(out_);
        findNamed(code);
        out_.clear();
        out_.reserve(words_.size());
        put(words_.first(headerWords));
        for (std::uint32_t at = headerWords; at < function_; at += words_[at] >> 16) putGlobal(at);
        put(code);
        out_[3] = bound_;
        return std::move(out_);
    }

    // Blocks in module order, but each after its predecessors: with fewer predecessors, a block may now be
    // dominated by one that follows it in the module.
    std::vector<std::uint32_t> writtenOrder() const {
        std::vector<std::uint32_t> place(blocks_.size(), none), before(blocks_.size()), written;
        for (std::uint32_t i = 0; i < order_.size(); ++i) place[order_[i]] = i;
        const auto forward = [&](std::uint32_t from, std::uint32_t to) { return place[from] < place[to]; };
        for (const std::uint32_t number : order_)
            if (blocks_[number].alive)
                for (const std::uint32_t to : blocks_[number].taken)
                    if (forward(number, to)) ++before[to];
        std::set<std::uint32_t> ready{0};
        while (!ready.empty()) {
            const std::uint32_t number = *ready.begin();
            ready.erase(ready.begin());
            written.push_back(number);
            for (const std::uint32_t to : blocks_[number].taken)
                if (forward(number, to) && --before[to] == 0) ready.insert(to);
        }
        for (std::uint32_t number = 0; number < blocks_.size(); ++number)
            if (!blocks_[number].alive && blocks_[number].stub) written.push_back(number);
        return written;
    }

    // Finds everything that the code names, recursively. Also the module's own declarations: workgroup
    // size and built-in constants.
    void findNamed(std::span<const std::uint32_t> code) {
        std::vector<std::uint32_t> made(bound_), named;  // made: offset of the declaring instruction
        const auto name = [&](std::uint32_t id) {
            if (id >= ids_.size() || std::exchange(ids_[id].named, true))
                return;  // new ids belong to the
                         // code
            if (made[id] != 0) named.push_back(id);
        };
        for (std::uint32_t at = headerWords; at < function_; at += words_[at] >> 16)
            if (const std::uint32_t result = resultOf(instruction(at)); result != 0) made[result] = at;
        for (std::size_t at = 0; at < code.size(); at += code[at] >> 16) {
            eachId(instructionAt(code, at), name);
            demotes_ |= opOf(instructionAt(code, at)) == OpDemoteToHelperInvocation;
        }
        for (std::uint32_t at = headerWords; at < function_; at += words_[at] >> 16) {
            const auto in = instruction(at);
            if (op(at) == OpExecutionModeId) std::ranges::for_each(in.subspan(3), name);
            if (op(at) == OpDecorate && in[2] == decorationBuiltIn && made[in[1]] != 0 &&
                op(made[in[1]]) != OpVariable)
                name(in[1]);
        }
        while (!named.empty()) {
            const auto in = instruction(made[named.back()]);
            named.pop_back();
            if (ids_[resultOf(in)].known)
                name(in[1]);  // the type of a constant
            else
                eachId(in, name);
            needs16_ |= opOf(in) == OpTypeFloat && in[2] == 16;
            needs64_ |= opOf(in) == OpTypeInt && in[2] == 64;
            stores_samples_ |= opOf(in) == OpTypeImage && in[6] == 1 && in[7] == 2;
        }
    }

    // Id of the type, constant or variable that a global instruction declares; 0 if none.
    static std::uint32_t resultOf(std::span<const std::uint32_t> in) {
        const std::uint32_t op = opOf(in);
        if (op >= OpTypeVoid && op <= OpTypeFunction) return in[1];
        if ((op >= OpConstantTrue && op <= OpSpecConstantOp) || op == OpVariable || op == OpUndef)
            return in[2];
        return 0;
    }

    // Whether a capability is still needed. InterpolationFunction always stays: without it SwiftShader
    // evaluates inputs of partly covered pixels away from the centre, which makes derivatives wrong at
    // edges.
    bool isDemanded(std::uint32_t capability) const {
        switch (capability) {
            case capabilityFloat16:
                return needs16_;
            case capabilityInt64:
                return needs64_;
            case capabilityStorageImageMultisample:
                return stores_samples_;
            case capabilityDemoteToHelperInvocation:
                return demotes_;
            default:
                return true;
        }
    }

    void putGlobal(std::uint32_t at) {
        const auto in = instruction(at);
        if (const std::uint32_t result = resultOf(in); result != 0 && !ids_[result].named) return;
        switch (op(at)) {
            case OpCapability:
                if (!isDemanded(in[1])) return;
                break;
            case OpName:
            case OpMemberName:
            case OpDecorate:
            case OpMemberDecorate:
            case OpTypeForwardPointer:
                if (!ids_[in[1]].named) return;
                if (op(at) == OpDecorate && in[2] == decorationSpecId) return;
                break;
            case OpEntryPoint: {
                // Stage, function, name (up to a word with a zero byte), interface.
                std::size_t interface = 3;
                while ((in[interface++] >> 24) != 0) continue;
                const std::size_t start = out_.size();
                put(in.first(interface));
                for (const std::uint32_t id : in.subspan(interface))
                    if (ids_[id].named) out_.push_back(id);
                out_[start] = static_cast<std::uint32_t>(out_.size() - start) << 16 | OpEntryPoint;
                return;
            }
            case OpSpecConstantTrue:
            case OpSpecConstantFalse:
            case OpSpecConstant:
                putConstant(in[2]);
                return;
            case OpSpecConstantOp:
                if (!ids_[in[2]].known) break;
                putConstant(in[2]);
                return;
            case OpSpecConstantComposite:
                out_.push_back((in[0] & 0xffff0000u) | OpConstantComposite);
                put(in.subspan(1));
                return;
            default:
                break;
        }
        put(in);
    }

    // Undefined phi operands for loops whose back edge is unreachable.
    void putUndefined() {
        for (const Block& block : blocks_) {
            if (!block.alive || block.stub_from == 0) continue;
            for (std::uint32_t i = block.first; i < block.last && op(at_[i]) == OpPhi; ++i) {
                const auto in = instruction(at_[i]);
                if (!ids_[in[2]].marked) continue;
                undefined_.push_back({in[2], bound_});
                put(OpUndef, {in[1], bound_++});
            }
        }
    }

    void putBlock(std::uint32_t number) {
        const Block& block = blocks_[number];
        if (!block.alive && !block.stub) return;
        put(OpLabel, {block.label});
        if (!block.alive) {
            if (block.stub_to == none)
                put(OpUnreachable, {});
            else
                put(OpBranch, {blocks_[block.stub_to].label});
            return;
        }
        for (std::uint32_t i = block.first; i < block.last; ++i) putInstruction(number, at_[i]);
        const auto in = instruction(at_[block.last]);
        if (block.declares_merge) {
            if (block.loop_continue != 0)
                put(instruction(at_[block.last - 1]));
            else
                put(OpSelectionMerge, {block.merge, 0});
        }
        const bool one = block.taken.size() == 1;
        if (one && op(at_[block.last]) == OpSwitch)
            put(OpSwitch, {in[1], blocks_[block.taken[0]].label});
        else if (one)
            put(OpBranch, {blocks_[block.taken[0]].label});
        else
            put(in);
    }

    void putInstruction(std::uint32_t number, std::uint32_t at) {
        const auto in = instruction(at);
        const std::uint32_t operation = op(at);
        if (operation == OpSelectionMerge || operation == OpLoopMerge || isUnread(in)) return;
        if (!hasResult(in)) return put(in);
        const Id& id = ids_[in[2]];
        if (!id.marked || id.known) return;
        if (id.copied != 0) return put(OpCopyObject, {in[1], in[2], id.copied});
        if (operation != OpPhi) return put(in);
        const std::size_t start = out_.size();
        out_.insert(out_.end(), {0, in[1], in[2]});
        for (std::size_t i = 3; i < in.size(); i += 2)
            if (goesTo(ids_[in[i + 1]].block, number)) out_.insert(out_.end(), {in[i], in[i + 1]});
        if (blocks_[number].stub_from != 0)
            for (const auto& [phi, undefined] : undefined_)
                if (phi == in[2]) out_.insert(out_.end(), {undefined, blocks_[number].stub_from});
        out_[start] = static_cast<std::uint32_t>(out_.size() - start) << 16 | OpPhi;
    }

    std::span<const std::uint32_t> words_;
    const SpecializationValue& value_;
    std::uint32_t bound_ = 0, function_ = 0, end_ = 0;
    std::vector<Id> ids_;
    std::vector<std::uint32_t> bits_;  // of known ids
    std::vector<std::uint32_t> at_;    // offsets of the function's instructions
    std::vector<Block> blocks_;
    std::vector<std::uint32_t> order_;  // indices of blocks
    std::vector<std::uint32_t> pending_, constants_;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> undefined_;  // phi of such a loop, undefined value
    std::vector<std::uint32_t> out_;
    bool needs16_ = false, needs64_ = false, stores_samples_ = false, demotes_ = false;
};

}  // namespace

std::vector<std::uint32_t> specialized(std::span<const std::uint32_t> module,
                                       const SpecializationValue& value,
                                       const std::optional<std::set<std::uint32_t>>& outputs) {
    return Specializer(module, value, outputs).result();
}

std::set<std::uint32_t> inputLocations(std::span<const std::uint32_t> module) {
    std::set<std::uint32_t> found;
    for (const auto& [variable, locations] : interfaceOf(module, storageInput))
        found.insert(locations.begin(), locations.end());
    return found;
}

}  // namespace diptych
