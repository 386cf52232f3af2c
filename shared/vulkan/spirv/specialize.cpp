// SPDX-License-Identifier: MIT
// Sparse conditional constant propagation (Wegman and Zadeck, "Constant propagation with conditional
// branches", TOPLAS 13(2), 1991) in passes over the blocks. The first takes every loop's body for code that
// runs once. The next ones know the loops whose back edge was taken; values that these change count as
// unknown. Then marks everything that live code reads, starting at side effects.
#include "shared/vulkan/spirv/specialize.h"

#include "shared/vulkan/spirv/shader_interface.h"
#include "shared/vulkan/spirv/specialized_code.h"
#include "shared/vulkan/spirv/spirv_fold.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace diptych {

namespace {

using namespace spirv;

class Specializer {
public:
    Specializer(std::span<const std::uint32_t> words, const SpecializationValue& value,
                const std::optional<std::set<std::uint32_t>>& outputs)
        : value_(value) {
        if (words.size() < headerWords || words[0] != magicNumber)
            throw std::logic_error("not a SPIR-V module");
        code_.words = words;
        code_.bound = words[3];
        code_.bits.resize(code_.bound);
        code_.ids.resize(code_.bound);
        readModule(outputs);
        readFunction();
    }

    std::vector<std::uint32_t> result() {
        propagate();
        keepStructure();
        mark();
        return written(code_);
    }

private:
    void readModule(const std::optional<std::set<std::uint32_t>>& outputs) {
        std::uint32_t at = headerWords;
        for (; at < code_.words.size() && code_.op(at) != OpFunction; at += code_.words[at] >> 16) {
            const auto in = code_.instruction(at);
            switch (code_.op(at)) {
                case OpDecorate:
                    if (in[2] == decorationSpecId) code_.ids[in[1]].spec = in[3];
                    break;
                case OpTypeBool:
                    code_.ids[in[1]].scalar = code_.ids[in[1]].boolean = true;
                    break;
                case OpTypeInt:
                case OpTypeFloat:
                    code_.ids[in[1]].scalar = in[2] == 32;
                    break;
                case OpConstantTrue:
                case OpConstantFalse:
                    know(in[1], in[2], code_.op(at) == OpConstantTrue);
                    break;
                case OpConstant:
                    if (code_.ids[in[1]].scalar) know(in[1], in[2], in[3]);
                    break;
                case OpConstantNull:
                    if (code_.ids[in[1]].scalar) know(in[1], in[2], 0);
                    break;
                case OpSpecConstantTrue:
                case OpSpecConstantFalse:
                    know(in[1], in[2],
                         code_.ids[in[2]].spec == SpecializedCode::none ? code_.op(at) == OpSpecConstantTrue
                                                                        : value_(code_.ids[in[2]].spec) != 0);
                    break;
                case OpSpecConstant:
                    if (!code_.ids[in[1]].scalar)
                        throw std::logic_error("a specialization constant is not of 32 bits");
                    know(in[1], in[2],
                         code_.ids[in[2]].spec == SpecializedCode::none ? in[3]
                                                                        : value_(code_.ids[in[2]].spec));
                    break;
                case OpSpecConstantOp:
                    if (const auto folded = fold(in[3], in[1], in.subspan(4))) know(in[1], in[2], *folded);
                    break;
                default:
                    break;
            }
        }
        code_.function = at;
        if (!outputs) return;
        for (const auto& [variable, locations] : outputsOf(code_.words))
            code_.ids[variable].unread = std::ranges::none_of(
                locations, [&](std::uint32_t location) { return outputs->contains(location); });
    }

    void readFunction() {
        std::uint32_t at = code_.function;
        if (at >= code_.words.size()) throw std::logic_error("the module has no function");
        at += code_.words[at] >> 16;
        for (; at < code_.words.size() && code_.op(at) != OpFunctionEnd; at += code_.words[at] >> 16) {
            const auto in = code_.instruction(at);
            if (code_.op(at) == OpLabel) {
                code_.ids[in[1]].block = static_cast<std::uint32_t>(code_.blocks.size());
                code_.blocks.emplace_back();
                code_.blocks.back().label = in[1];
                code_.blocks.back().first = static_cast<std::uint32_t>(code_.at.size());
                continue;
            }
            if (code_.blocks.empty()) throw std::logic_error("the function has parameters");
            SpecializedCode::Block& block = code_.blocks.back();
            block.last = static_cast<std::uint32_t>(code_.at.size());
            code_.at.push_back(at);
            if (code_.op(at) == OpLoopMerge || code_.op(at) == OpSelectionMerge) block.merge = in[1];
            if (code_.op(at) == OpLoopMerge) block.loop_continue = in[2];
            if (isTerminator(code_.op(at)) || !hasResult(in)) continue;
            code_.ids[in[2]].at = at;
            code_.ids[in[2]].type = in[1];
        }
        if (at >= code_.words.size()) throw std::logic_error("the function has no end");
        if (at + (code_.words[at] >> 16) != code_.words.size())
            throw std::logic_error("the module has several functions");
        for (SpecializedCode::Block& block : code_.blocks) {
            const auto in = code_.instruction(code_.at[block.last]);
            const auto to = [&](std::uint32_t label) {
                const std::uint32_t target = code_.ids[label].block;
                if (std::ranges::find(block.targets, target) == block.targets.end())
                    block.targets.push_back(target);
            };
            if (code_.op(code_.at[block.last]) == OpBranch) to(in[1]);
            if (code_.op(code_.at[block.last]) == OpBranchConditional) to(in[2]), to(in[3]);
            if (code_.op(code_.at[block.last]) == OpSwitch) {
                to(in[2]);
                for (std::size_t i = 4; i < in.size(); i += 2) to(in[i]);
            }
        }
    }

    void know(std::uint32_t type, std::uint32_t id, std::uint32_t bits) {
        code_.ids[id].type = type;
        code_.ids[id].known = true;
        code_.bits[id] = bits;
    }
    std::optional<std::uint32_t> known(std::uint32_t id) const {
        if (!code_.ids[id].known) return std::nullopt;
        return code_.bits[id];
    }

    std::optional<std::uint32_t> fold(std::uint32_t operation, std::uint32_t type,
                                      std::span<const std::uint32_t> operands) const {
        if (type >= code_.bound || !code_.ids[type].scalar || operands.empty()) return std::nullopt;
        const auto a = known(operands[0]);
        if (operation == OpSelect) return a ? known(operands[*a != 0 ? 1 : 2]) : std::nullopt;
        if (operation == OpBitcast && code_.ids[code_.ids[operands[0]].type].boolean) return std::nullopt;
        return folded(operation, a, operands.size() > 1 ? known(operands[1]) : std::nullopt);
    }

    // Reverse postorder: each block after its predecessors, except for back edges.
    std::vector<std::uint32_t> order() const {
        std::vector<std::uint32_t> blocks;
        std::vector<char> seen(code_.blocks.size());
        std::vector<std::pair<std::uint32_t, std::size_t>> stack{{0, 0}};
        seen[0] = 1;
        while (!stack.empty()) {
            auto& [block, next] = stack.back();
            if (next == code_.blocks[block].targets.size()) {
                blocks.push_back(block);
                stack.pop_back();
                continue;
            }
            const std::uint32_t target = code_.blocks[block].targets[next++];
            if (seen[target] != 0) continue;
            seen[target] = 1;
            stack.emplace_back(target, 0);
        }
        std::ranges::reverse(blocks);
        return blocks;
    }

    void propagate() {
        code_.order = order();
        place_.assign(code_.blocks.size(), SpecializedCode::none);
        for (std::uint32_t i = 0; i < code_.order.size(); ++i) place_[code_.order[i]] = i;
        while (!propagatedOnce()) continue;
    }

    // False if a loop turned out to repeat that was taken for code that runs once.
    bool propagatedOnce() {
        for (SpecializedCode::Block& block : code_.blocks) block.alive = false, block.taken.clear();
        for (const std::uint32_t at : code_.at)
            if (const auto in = code_.instruction(at); !isTerminator(code_.op(at)) && hasResult(in))
                code_.ids[in[2]].known = false, code_.ids[in[2]].copied = 0;
        code_.blocks[0].alive = true;
        bool complete = true;
        for (const std::uint32_t number : code_.order) {
            SpecializedCode::Block& block = code_.blocks[number];
            if (!block.alive) continue;
            for (std::uint32_t i = block.first; i < block.last; ++i) evaluate(number, code_.at[i]);
            block.taken = takenFrom(number);
            for (const std::uint32_t target : block.taken) {
                code_.blocks[target].alive = true;
                if (isBackEdge(number, target) && !std::exchange(code_.blocks[target].repeats, true))
                    complete = false;
            }
        }
        return complete;
    }

    bool isBackEdge(std::uint32_t from, std::uint32_t to) const { return place_[to] <= place_[from]; }

    // A loop keeps both edges of the branch that ends it, unless it is left at once.
    std::vector<std::uint32_t> takenFrom(std::uint32_t number) const {
        const SpecializedCode::Block& block = code_.blocks[number];
        const auto in = code_.instruction(code_.at[block.last]);
        const std::uint32_t end = code_.op(code_.at[block.last]);
        if (end != OpBranchConditional && end != OpSwitch) return block.targets;
        const auto selector = known(in[1]);
        if (!selector) return block.targets;
        std::uint32_t label = in[2];
        if (end == OpBranchConditional) label = in[*selector != 0 ? 2 : 3];
        for (std::size_t k = 3; end == OpSwitch && k + 1 < in.size(); k += 2)
            if (in[k] == *selector) label = in[k + 1];
        const std::uint32_t target = code_.ids[label].block;
        if (isBackEdge(number, target)) return block.targets;
        return {target};
    }

    void evaluate(std::uint32_t number, std::uint32_t at) {
        const auto in = code_.instruction(at);
        if (!hasResult(in)) return;
        SpecializedCode::Id& id = code_.ids[in[2]];
        if (code_.op(at) == OpPhi) {
            if (code_.blocks[number].repeats || !code_.ids[in[1]].scalar) return;
            std::optional<std::uint32_t> all;
            for (std::size_t i = 3; i < in.size(); i += 2) {
                if (!code_.goesTo(code_.ids[in[i + 1]].block, number)) continue;
                const auto one = known(in[i]);
                if (!one || (all && *all != *one)) return;
                all = one;
            }
            if (all) know(in[1], in[2], *all);
            return;
        }
        if (const auto folded = fold(code_.op(at), in[1], in.subspan(3))) {
            know(in[1], in[2], *folded);
        } else if (code_.op(at) == OpSelect && known(in[3])) {
            id.copied = in[*known(in[3]) != 0 ? 4 : 5];
        } else if (code_.op(at) == OpLogicalAnd || code_.op(at) == OpLogicalOr) {
            // The known operand does not decide the result; otherwise fold() would.
            if (known(in[3])) id.copied = in[4];
            if (known(in[4])) id.copied = in[3];
        }
    }

    // Whether a loop is no loop any more: its body runs once, and one branch leaves it.
    bool isUnrolled(const SpecializedCode::Block& loop) const {
        const std::uint32_t merge = code_.ids[loop.merge].block;
        return !loop.repeats && std::ranges::count_if(code_.blocks, [&](const SpecializedCode::Block& from) {
                                    return std::ranges::find(from.taken, merge) != from.taken.end();
                                }) == 1;
    }

    // Live constructs need the blocks they name, even if unreachable. A branch out of a removed construct
    // declares that construct's merge block as its own.
    void keepStructure() {
        std::vector<char> declared(code_.bound), dropped(code_.bound);
        for (SpecializedCode::Block& block : code_.blocks)
            if (block.alive && block.loop_continue != 0 && isUnrolled(block)) block.loop_continue = 0;
        for (const std::uint32_t number : code_.order) {
            SpecializedCode::Block& block = code_.blocks[number];
            if (!block.alive || block.merge == 0) continue;
            const bool loops = block.loop_continue != 0;
            block.declares_merge =
                loops || code_.op(code_.at[block.last]) == OpSwitch || block.taken.size() > 1;
            if (!block.declares_merge) {
                dropped[block.merge] = 1;
                continue;
            }
            declared[block.merge] = 1;
            SpecializedCode::Block& merge = code_.blocks[code_.ids[block.merge].block];
            merge.stub |= !merge.alive;
            if (!loops) continue;
            declared[block.loop_continue] = 1;
            SpecializedCode::Block& next = code_.blocks[code_.ids[block.loop_continue].block];
            if (next.alive) continue;
            next.stub = true;
            next.stub_to = number;
            block.stub_from = next.label;
        }
        for (const std::uint32_t number : code_.order) {
            SpecializedCode::Block& block = code_.blocks[number];
            if (!block.alive || block.declares_merge || block.taken.size() < 2) continue;
            const auto label = [&](std::uint32_t target) { return code_.blocks[target].label; };
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
        for (const SpecializedCode::Block& block : code_.blocks) {
            if (!block.alive) continue;
            for (std::uint32_t i = block.first; i < block.last; ++i) {
                const auto in = code_.instruction(code_.at[i]);
                const std::uint32_t operation = code_.op(code_.at[i]);
                if (operation == OpSelectionMerge || operation == OpLoopMerge) continue;
                if (code_.isUnread(in)) continue;
                if (!hasResult(in)) {
                    eachId(in, [&](std::uint32_t id) { need(id); });
                } else if (!isPure(in)) {
                    need(in[2]);
                }
            }
            const auto in = code_.instruction(code_.at[block.last]);
            const std::uint32_t end = code_.op(code_.at[block.last]);
            if (end == OpSwitch || (end == OpBranchConditional && block.taken.size() > 1)) need(in[1]);
        }
        while (!pending_.empty()) {
            const std::uint32_t id = pending_.back();
            pending_.pop_back();
            if (code_.ids[id].copied != 0) {
                need(code_.ids[id].copied);
                continue;
            }
            const auto in = code_.instruction(code_.ids[id].at);
            if (code_.op(code_.ids[id].at) != OpPhi) {
                eachId(in, [&](std::uint32_t operand) { need(operand); });
                continue;
            }
            for (std::size_t i = 3; i < in.size(); i += 2)
                if (code_.blocks[code_.ids[in[i + 1]].block].alive) need(in[i]);
        }
    }

    void need(std::uint32_t id) {
        if (code_.ids[id].marked || code_.ids[id].at == 0) return;
        code_.ids[id].marked = true;
        if (code_.ids[id].known)
            code_.constants.push_back(id);
        else
            pending_.push_back(id);
    }

    SpecializedCode code_;
    const SpecializationValue& value_;
    std::vector<std::uint32_t> place_;  // of a block in code_.order
    std::vector<std::uint32_t> pending_;
};

}  // namespace

std::vector<std::uint32_t> specialized(std::span<const std::uint32_t> module,
                                       const SpecializationValue& value,
                                       const std::optional<std::set<std::uint32_t>>& outputs) {
    return Specializer(module, value, outputs).result();
}

}  // namespace diptych
