// SPDX-License-Identifier: MIT
// A module while it is specialized: what its instructions are, which are alive and which values are known.
#pragma once

#include "shared/vulkan/spirv/spirv_ops.h"

#include <cstdint>
#include <vector>

namespace diptych {

struct SpecializedCode {
    static constexpr std::uint32_t none = ~0u;

    struct Id {
        std::uint32_t at = 0;        // of its instruction in the function; 0: declared outside
        std::uint32_t type = 0;      // result type
        std::uint32_t copied = 0;    // equals this id
        std::uint32_t spec = none;   // SpecId of a specialization constant
        std::uint32_t block = none;  // of a label
        bool scalar = false;         // a type: bool, or 32-bit integer or float
        bool boolean = false;        // a type: bool
        bool known = false;          // its value is in `bits`
        bool marked = false;
        bool unread = false;  // an output that no later stage reads
    };
    struct Block {
        std::uint32_t first = 0, last = 0;  // instructions: indices into `at`; the last is the terminator
        std::uint32_t label = 0, merge = 0, loop_continue = 0;  // ids; of merge instructions, 0: none
        std::vector<std::uint32_t> targets;                     // successor blocks
        std::vector<std::uint32_t> taken;                       // remaining successors
        bool alive = false;
        bool repeats = false;          // a loop header whose back edge is taken
        bool stub = false;             // unreachable, but a live construct names it
        std::uint32_t stub_to = none;  // loop header that a stub of a continue target branches to
        std::uint32_t stub_from = 0;   // label of the stub that branches to this loop header
        bool declares_merge = false;   // writes a merge instruction, which names `merge`
    };

    spirv::Words instruction(std::uint32_t offset) const { return spirv::instructionAt(words, offset); }
    std::uint32_t op(std::uint32_t offset) const { return words[offset] & 0xffff; }
    // Whether control may still pass from one block to the other.
    bool goesTo(std::uint32_t from, std::uint32_t to) const;
    // Whether it stores to an output that no later stage reads.
    bool isUnread(spirv::Words in) const;

    spirv::Words words{};
    std::uint32_t bound = 0, function = 0;  // function: offset of OpFunction
    std::vector<Id> ids{};
    std::vector<std::uint32_t> bits{};  // of known ids
    std::vector<std::uint32_t> at{};    // offsets of the function's instructions
    std::vector<Block> blocks{};
    std::vector<std::uint32_t> order{};      // indices of blocks, in reverse postorder
    std::vector<std::uint32_t> constants{};  // live ids of the function whose values are known
};

// The live code and the declarations that it names, as a module.
std::vector<std::uint32_t> written(const SpecializedCode& code);

}  // namespace diptych
