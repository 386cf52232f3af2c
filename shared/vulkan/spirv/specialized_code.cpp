// SPDX-License-Identifier: MIT
#include "shared/vulkan/spirv/specialized_code.h"

#include <algorithm>
#include <initializer_list>
#include <set>
#include <utility>

namespace diptych {

namespace {

using namespace spirv;

class CodeWriter {
public:
    explicit CodeWriter(const SpecializedCode& code)
        : code_(code), bound_(code.bound), named_(code.ids.size()) {}

    std::vector<std::uint32_t> written() {
        for (const std::uint32_t id : code_.constants) putConstant(id);
        putUndefined();
        put(code_.instruction(code_.function));
        for (const std::uint32_t number : writtenOrder()) putBlock(number);
        put(OpFunctionEnd, {});
        const std::vector<std::uint32_t> code = std::move(out_);
        findNamed(code);
        out_.clear();
        out_.reserve(code_.words.size());
        put(code_.words.first(headerWords));
        for (std::uint32_t at = headerWords; at < code_.function; at += code_.words[at] >> 16) putGlobal(at);
        put(code);
        out_[3] = bound_;
        return std::move(out_);
    }

private:
    void put(std::span<const std::uint32_t> in) { out_.insert(out_.end(), in.begin(), in.end()); }
    void put(std::uint32_t operation, std::initializer_list<std::uint32_t> words) {
        out_.push_back(static_cast<std::uint32_t>(words.size() + 1) << 16 | operation);
        out_.insert(out_.end(), words);
    }
    void putConstant(std::uint32_t id) {
        const std::uint32_t type = code_.ids[id].type;
        if (code_.ids[type].boolean)
            put(code_.bits[id] != 0 ? OpConstantTrue : OpConstantFalse, {type, id});
        else
            put(OpConstant, {type, id, code_.bits[id]});
    }

    // Blocks in module order, but each after its predecessors: with fewer predecessors, a block may now be
    // dominated by one that follows it in the module.
    std::vector<std::uint32_t> writtenOrder() const {
        std::vector<std::uint32_t> place(code_.blocks.size(), SpecializedCode::none),
            before(code_.blocks.size()), written;
        for (std::uint32_t i = 0; i < code_.order.size(); ++i) place[code_.order[i]] = i;
        const auto forward = [&](std::uint32_t from, std::uint32_t to) { return place[from] < place[to]; };
        for (const std::uint32_t number : code_.order)
            if (code_.blocks[number].alive)
                for (const std::uint32_t to : code_.blocks[number].taken)
                    if (forward(number, to)) ++before[to];
        std::set<std::uint32_t> ready{0};
        while (!ready.empty()) {
            const std::uint32_t number = *ready.begin();
            ready.erase(ready.begin());
            written.push_back(number);
            for (const std::uint32_t to : code_.blocks[number].taken)
                if (forward(number, to) && --before[to] == 0) ready.insert(to);
        }
        for (std::uint32_t number = 0; number < code_.blocks.size(); ++number)
            if (!code_.blocks[number].alive && code_.blocks[number].stub) written.push_back(number);
        return written;
    }

    // Finds everything that the code names, recursively. Also the module's own declarations: workgroup
    // size and built-in constants.
    void findNamed(std::span<const std::uint32_t> code) {
        std::vector<std::uint32_t> made(bound_), named;  // made: offset of the declaring instruction
        const auto name = [&](std::uint32_t id) {
            if (id >= named_.size() || std::exchange(named_[id], char{1}) != 0)
                return;  // new ids belong to the code
            if (made[id] != 0) named.push_back(id);
        };
        for (std::uint32_t at = headerWords; at < code_.function; at += code_.words[at] >> 16)
            if (const std::uint32_t result = declaredBy(code_.instruction(at)); result != 0)
                made[result] = at;
        for (std::size_t at = 0; at < code.size(); at += code[at] >> 16) {
            eachId(instructionAt(code, at), name);
            demotes_ |= opOf(instructionAt(code, at)) == OpDemoteToHelperInvocation;
        }
        for (std::uint32_t at = headerWords; at < code_.function; at += code_.words[at] >> 16) {
            const auto in = code_.instruction(at);
            if (code_.op(at) == OpExecutionModeId) std::ranges::for_each(in.subspan(3), name);
            if (code_.op(at) == OpDecorate && in[2] == decorationBuiltIn && made[in[1]] != 0 &&
                code_.op(made[in[1]]) != OpVariable)
                name(in[1]);
        }
        while (!named.empty()) {
            const auto in = code_.instruction(made[named.back()]);
            named.pop_back();
            if (code_.ids[declaredBy(in)].known)
                name(in[1]);  // the type of a constant
            else
                eachId(in, name);
            needs16_ |= opOf(in) == OpTypeFloat && in[2] == 16;
            needs64_ |= opOf(in) == OpTypeInt && in[2] == 64;
            stores_samples_ |= opOf(in) == OpTypeImage && in[6] == 1 && in[7] == 2;
        }
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
        const auto in = code_.instruction(at);
        if (const std::uint32_t result = declaredBy(in); result != 0 && named_[result] == 0) return;
        switch (code_.op(at)) {
            case OpCapability:
                if (!isDemanded(in[1])) return;
                break;
            case OpName:
            case OpMemberName:
            case OpDecorate:
            case OpMemberDecorate:
            case OpTypeForwardPointer:
                if (named_[in[1]] == 0) return;
                if (code_.op(at) == OpDecorate && in[2] == decorationSpecId) return;
                break;
            case OpEntryPoint: {
                // Stage, function, name (up to a word with a zero byte), interface.
                std::size_t interface = 3;
                while ((in[interface++] >> 24) != 0) continue;
                const std::size_t start = out_.size();
                put(in.first(interface));
                for (const std::uint32_t id : in.subspan(interface))
                    if (named_[id] != 0) out_.push_back(id);
                out_[start] = static_cast<std::uint32_t>(out_.size() - start) << 16 | OpEntryPoint;
                return;
            }
            case OpSpecConstantTrue:
            case OpSpecConstantFalse:
            case OpSpecConstant:
                putConstant(in[2]);
                return;
            case OpSpecConstantOp:
                if (!code_.ids[in[2]].known) break;
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
        for (const SpecializedCode::Block& block : code_.blocks) {
            if (!block.alive || block.stub_from == 0) continue;
            for (std::uint32_t i = block.first; i < block.last && code_.op(code_.at[i]) == OpPhi; ++i) {
                const auto in = code_.instruction(code_.at[i]);
                if (!code_.ids[in[2]].marked) continue;
                undefined_.push_back({in[2], bound_});
                put(OpUndef, {in[1], bound_++});
            }
        }
    }

    void putBlock(std::uint32_t number) {
        const SpecializedCode::Block& block = code_.blocks[number];
        if (!block.alive && !block.stub) return;
        put(OpLabel, {block.label});
        if (!block.alive) {
            if (block.stub_to == SpecializedCode::none)
                put(OpUnreachable, {});
            else
                put(OpBranch, {code_.blocks[block.stub_to].label});
            return;
        }
        for (std::uint32_t i = block.first; i < block.last; ++i) putInstruction(number, code_.at[i]);
        const auto in = code_.instruction(code_.at[block.last]);
        if (block.declares_merge) {
            if (block.loop_continue != 0)
                put(code_.instruction(code_.at[block.last - 1]));
            else
                put(OpSelectionMerge, {block.merge, 0});
        }
        const bool one = block.taken.size() == 1;
        if (one && code_.op(code_.at[block.last]) == OpSwitch)
            put(OpSwitch, {in[1], code_.blocks[block.taken[0]].label});
        else if (one)
            put(OpBranch, {code_.blocks[block.taken[0]].label});
        else
            put(in);
    }

    void putInstruction(std::uint32_t number, std::uint32_t at) {
        const auto in = code_.instruction(at);
        const std::uint32_t operation = code_.op(at);
        if (operation == OpSelectionMerge || operation == OpLoopMerge || code_.isUnread(in)) return;
        if (!hasResult(in)) return put(in);
        const SpecializedCode::Id& id = code_.ids[in[2]];
        if (!id.marked || id.known) return;
        if (id.copied != 0) return put(OpCopyObject, {in[1], in[2], id.copied});
        if (operation != OpPhi) return put(in);
        const std::size_t start = out_.size();
        out_.insert(out_.end(), {0, in[1], in[2]});
        for (std::size_t i = 3; i < in.size(); i += 2)
            if (code_.goesTo(code_.ids[in[i + 1]].block, number)) out_.insert(out_.end(), {in[i], in[i + 1]});
        if (code_.blocks[number].stub_from != 0)
            for (const auto& [phi, undefined] : undefined_)
                if (phi == in[2]) out_.insert(out_.end(), {undefined, code_.blocks[number].stub_from});
        out_[start] = static_cast<std::uint32_t>(out_.size() - start) << 16 | OpPhi;
    }

    const SpecializedCode& code_;
    std::uint32_t bound_;
    std::vector<char> named_;                                         // by id: live code names it
    std::vector<std::pair<std::uint32_t, std::uint32_t>> undefined_;  // phi of such a loop, undefined value
    std::vector<std::uint32_t> out_;
    bool needs16_ = false, needs64_ = false, stores_samples_ = false, demotes_ = false;
};

}  // namespace

bool SpecializedCode::goesTo(std::uint32_t from, std::uint32_t to) const {
    return blocks[from].alive && std::ranges::find(blocks[from].taken, to) != blocks[from].taken.end();
}

bool SpecializedCode::isUnread(spirv::Words in) const {
    if (opOf(in) != OpStore) return false;
    std::uint32_t pointer = in[1];
    while (ids[pointer].at != 0 &&
           (op(ids[pointer].at) == OpAccessChain || op(ids[pointer].at) == OpInBoundsAccessChain))
        pointer = instruction(ids[pointer].at)[3];
    return ids[pointer].unread;
}

std::vector<std::uint32_t> written(const SpecializedCode& code) {
    return CodeWriter(code).written();
}

}  // namespace diptych
