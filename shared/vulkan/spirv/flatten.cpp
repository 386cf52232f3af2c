// SPDX-License-Identifier: MIT
// If-conversion (Allen, Kennedy, Porterfield and Warren, "Conversion of control dependence to data
// dependence", POPL 1983) of SPIR-V's structured branches.
#include "shared/vulkan/spirv/flatten.h"

#include "shared/vulkan/spirv/spirv_ops.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>

namespace diptych {

namespace {

using namespace spirv;

constexpr std::size_t nowhere = ~std::size_t{0};

// Whether an instruction computes from values alone and is safe for all inputs. Excludes integer division,
// which may trap, and interpolation, which depends on neighbouring fragments.
bool computes(Words in) {
    const std::uint32_t op = opOf(in);
    if (op == OpExtInst)
        return in[4] != extendedModf && in[4] != extendedFrexp && in[4] < extendedInterpolates;
    const bool divides = op == OpUDiv || op == OpSDiv || (op >= OpUMod && op <= OpSMod);
    // Composites and vectors; conversions, arithmetic, comparisons, bit operations.
    return op == OpUndef || (op >= 77 && op <= 84) || (op >= 109 && op <= 124) ||
           (op >= 126 && op <= 205 && !divides);
}

struct Block {
    std::uint32_t label = 0;
    std::vector<Words> body;  // without merge instruction and terminator
    Words merge, end;         // merge: empty if there is none
    bool gone = false;
};

class Flattener {
public:
    explicit Flattener(Words words) : words_(words), block_of_(words[3], nowhere) { read(); }

    std::vector<std::uint32_t> result() {
        // Innermost branches come last. Removing them can make the enclosing branches convertible.
        for (bool changed = true; changed;) {
            changed = false;
            for (std::size_t i = blocks_.size(); i-- > 0;)
                if (!blocks_[i].gone) changed |= flatten(blocks_[i]);
        }
        std::vector<std::uint32_t> out(words_.begin(), words_.begin() + static_cast<std::ptrdiff_t>(first_));
        const auto put = [&](Words in) { out.insert(out.end(), in.begin(), in.end()); };
        for (const Block& block : blocks_) {
            if (block.gone) continue;
            out.insert(out.end(), {2u << 16 | OpLabel, block.label});
            for (const Words in : block.body) put(in);
            if (!block.merge.empty()) put(block.merge);
            put(block.end);
        }
        put(words_.subspan(end_));
        return out;
    }

private:
    void read() {
        std::size_t at = headerWords;
        const auto next = [&] { return instructionAt(words_, at); };
        while (opOf(next()) != OpFunction) at += next().size();
        at += next().size();
        first_ = at;
        for (; opOf(next()) != OpFunctionEnd; at += next().size()) {
            const Words in = next();
            if (opOf(in) == OpLabel) {
                block_of_[in[1]] = blocks_.size();
                blocks_.emplace_back().label = in[1];
            } else if (opOf(in) == OpLoopMerge || opOf(in) == OpSelectionMerge) {
                blocks_.back().merge = in;
            } else {
                blocks_.back().body.push_back(in);
            }
        }
        end_ = at;
        for (Block& block : blocks_) {
            block.end = block.body.back();
            block.body.pop_back();
        }
    }

    std::vector<std::uint32_t> targetsOf(const Block& block) const {
        switch (opOf(block.end)) {
            case OpBranch:
                return {block.end[1]};
            case OpBranchConditional:
                return {block.end[2], block.end[3]};
            case OpSwitch: {
                std::vector<std::uint32_t> targets{block.end[2]};
                for (std::size_t i = 4; i < block.end.size(); i += 2) targets.push_back(block.end[i]);
                return targets;
            }
            default:
                return {};
        }
    }

    std::size_t predecessors(std::uint32_t label) const {
        std::size_t count = 0;
        for (const Block& block : blocks_)
            if (!block.gone) count += static_cast<std::size_t>(std::ranges::count(targetsOf(block), label));
        return count;
    }

    // Chain of blocks from `label` to `merge` if they only compute; empty if `label` is `merge`.
    std::optional<std::vector<Block*>> way(std::uint32_t label, std::uint32_t merge) {
        std::vector<Block*> blocks;
        while (label != merge) {
            Block& block = blocks_[block_of_[label]];
            if (!block.merge.empty() || opOf(block.end) != OpBranch ||
                !std::ranges::all_of(block.body, computes) || predecessors(label) != 1)
                return std::nullopt;
            blocks.push_back(&block);
            label = block.end[1];
        }
        return blocks;
    }

    bool flatten(Block& head) {
        if (head.merge.empty() || opOf(head.merge) != OpSelectionMerge ||
            opOf(head.end) != OpBranchConditional)
            return false;
        const std::uint32_t merge = head.merge[1], condition = head.end[1];
        const auto yes = way(head.end[2], merge), no = way(head.end[3], merge);
        if (!yes || !no || predecessors(merge) != 2 || head.end[2] == head.end[3]) return false;
        Block& after = blocks_[block_of_[merge]];
        for (const auto& blocks : {*yes, *no})
            for (Block* const block : blocks) {
                head.body.insert(head.body.end(), block->body.begin(), block->body.end());
                block->gone = true;
            }
        const std::uint32_t from_yes = yes->empty() ? head.label : yes->back()->label;
        std::size_t phis = 0;
        for (; phis < after.body.size() && opOf(after.body[phis]) == OpPhi; ++phis) {
            const Words phi = after.body[phis];
            const bool first = phi[4] == from_yes;
            head.body.push_back(made(
                {6u << 16 | OpSelect, phi[1], phi[2], condition, phi[first ? 3 : 5], phi[first ? 5 : 3]}));
        }
        after.body.erase(after.body.begin(), after.body.begin() + static_cast<std::ptrdiff_t>(phis));
        head.merge = {};
        head.end = made({2u << 16 | OpBranch, merge});
        return true;
    }

    Words made(std::vector<std::uint32_t> words) {
        made_.push_back(std::move(words));
        return made_.back();
    }

    Words words_;
    std::vector<std::size_t> block_of_;  // by label
    std::vector<Block> blocks_;
    std::vector<std::vector<std::uint32_t>> made_;  // new instructions; moving the outer vector does not
                                                    // move their words
    std::size_t first_ = 0, end_ = 0;               // of the function's blocks
};

}  // namespace

std::vector<std::uint32_t> flattened(std::span<const std::uint32_t> module) {
    return Flattener(module).result();
}

}  // namespace diptych
