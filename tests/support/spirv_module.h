// SPDX-License-Identifier: MIT
// Declarations and uses of a compiled shader module. Parsed by section 2.3 of the SPIR-V specification: a
// header of five words, then instructions whose first word is length << 16
// opcode.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <span>
#include <string>
#include <tuple>
#include <vector>

namespace diptych {

class SpirvModule {
public:
    enum class Kind {
        uniform_buffer,
        storage_buffer,
        texel_buffer,
        image,
        fetched_image,
        storage_image,
        other
    };
    struct Binding {
        std::uint32_t set = 0, number = 0;
        Kind kind = Kind::other;
        auto operator<=>(const Binding&) const = default;
    };

    // An instruction in a function whose result is a float, a vector or a matrix.
    struct Operation {
        std::string function;  // enclosing function, without parameters
        std::uint32_t op = 0;
        std::uint32_t extended = 0;  // of GLSL.std.450, where op is OpExtInst
        std::uint32_t result = 0;
        bool no_contraction = false;
    };

    explicit SpirvModule(std::span<const std::uint32_t> words) {
        for (std::size_t i = 5; i < words.size(); i += words[i] >> 16)
            all_.push_back({words[i] & 0xffff, words.subspan(i + 1, (words[i] >> 16) - 1)});
        for (const Instruction& in : all_) declare(in);
    }

    SpirvModule(const SpirvModule&) = delete;
    SpirvModule& operator=(const SpirvModule&) = delete;

    // Indices (constant_id) of the specialization constants that code reachable from the entry point uses,
    // directly or in a constant expression. Ignores global variables that are only written, and calls
    // whose results only such variables receive.
    std::set<std::uint32_t> usedConstants() const {
        std::set<std::uint32_t> used, functions;
        const std::set<std::uint32_t> dead = deadCalls();
        std::vector<std::uint32_t> pending{entry_};
        while (!pending.empty()) {
            const std::uint32_t function = pending.back();
            pending.pop_back();
            if (!functions.insert(function).second) continue;
            for (const Instruction* in : bodies_.at(function)) {
                if (isDeadStore(*in)) continue;
                if (in->op == op_function_call) {
                    if (dead.contains(in->words[1])) continue;
                    pending.push_back(in->words[2]);
                }
                for (const std::uint32_t id : operands(*in)) addConstant(id, used);
            }
        }
        return used;
    }

    std::vector<Binding> bindings() const {
        std::vector<Binding> result;
        for (const auto& [variable, pointer] : variables_)
            if (binding_.contains(variable))
                result.push_back({set_.at(variable), binding_.at(variable), kindOf(pointer)});
        return result;
    }

    // In module order.
    std::vector<Operation> operations() const {
        std::vector<Operation> result;
        std::string function;
        for (const Instruction& in : all_) {
            if (in.op == op_function) function = nameOf(in.words[1]);
            const bool value = in.op == op_ext_inst || in.op > op_function_parameter;
            if (!value || in.words.size() < 2 || !floats_.contains(in.words[0])) continue;
            result.push_back({function, in.op, in.op == op_ext_inst ? in.words[3] : 0, in.words[1],
                              no_contraction_.contains(in.words[1])});
        }
        return result;
    }

    // Number of instructions with the opcode.
    std::size_t count(std::uint32_t op) const {
        return static_cast<std::size_t>(
            std::count_if(all_.begin(), all_.end(), [&](const Instruction& in) { return in.op == op; }));
    }

private:
    enum Op : std::uint32_t {
        op_name = 5,
        op_ext_inst = 12,
        op_entry_point = 15,
        op_type_float = 22,
        op_type_vector = 23,
        op_type_matrix = 24,
        op_type_image = 25,
        op_type_sampled_image = 27,
        op_type_struct = 30,
        op_type_pointer = 32,
        op_spec_constant_op = 52,
        op_function = 54,
        op_function_parameter = 55,
        op_function_end = 56,
        op_function_call = 57,
        op_variable = 59,
        op_load = 61,
        op_store = 62,
        op_array_length = 68,
        op_decorate = 71,
        op_vector_shuffle = 79,
        op_composite_extract = 81,
        op_composite_insert = 82,
        op_image_first = 87,
        op_image_gather = 96,
        op_image_last = 97,
        op_image_write = 99,
        op_atomic_store = 228,
        op_loop_merge = 246,
        op_selection_merge = 247,
        op_label = 248,
        op_branch = 249,
        op_branch_conditional = 250,
        op_switch = 251,
        op_return_value = 254,
        op_group_first = 349,
        op_group_last = 364
    };
    struct Instruction {
        std::uint32_t op;
        std::span<const std::uint32_t> words;  // without the first
    };

    void declare(const Instruction& in) {
        const auto& w = in.words;
        if (in.op == op_name) names_[w[0]] = reinterpret_cast<const char*>(&w[1]);
        if (in.op == op_entry_point) entry_ = w[1];
        if (in.op == op_decorate && w[1] == 42) no_contraction_.insert(w[0]);
        if (in.op == op_type_float ||
            ((in.op == op_type_vector || in.op == op_type_matrix) && floats_.contains(w[1])))
            floats_.insert(w[0]);
        if (in.op == op_decorate && w[1] == 1) spec_id_[w[0]] = w[2];
        if (in.op == op_decorate && w[1] == 33) binding_[w[0]] = w[2];
        if (in.op == op_decorate && w[1] == 34) set_[w[0]] = w[2];
        if (in.op == op_spec_constant_op) expressions_[w[1]] = {w.begin() + 3, w.end()};
        if (in.op >= op_type_image && in.op <= op_type_pointer) types_[w[0]] = in;
        if (in.op == op_function) {
            function_ = w[1];
            bodies_[function_];
        } else if (in.op == op_function_end) {
            function_ = 0;
        } else if (function_ != 0) {
            bodies_[function_].push_back(&in);
            if (in.op == op_store) return;
            for (const std::uint32_t id : operands(in)) ++reads_[id];
        } else if (in.op == op_variable) {
            variables_[w[1]] = w[0];
            if (w[2] == 6) privates_.insert(w[1]);
        }
    }

    std::string nameOf(std::uint32_t function) const {
        const auto found = names_.find(function);
        if (found == names_.end()) return "?";
        return found->second.substr(0, found->second.find('('));
    }

    // Ids that an instruction reads, without literal operands.
    static std::vector<std::uint32_t> operands(const Instruction& in) {
        const auto& w = in.words;
        const auto some = [&](std::size_t first, std::size_t end) {
            std::vector<std::uint32_t> ids;
            for (std::size_t i = first; i < end && i < w.size(); ++i) ids.push_back(w[i]);
            return ids;
        };
        switch (in.op) {
            case op_label:
            case op_branch:
            case op_loop_merge:
            case op_selection_merge:
                return {};
            case op_branch_conditional:
            case op_switch:
                return some(0, 1);
            case op_return_value:
                return some(0, 1);
            case op_store:
                return some(0, 2);
            case op_image_write:
            case op_atomic_store:
                return some(0, w.size());
            case op_load:
            case op_composite_extract:
            case op_array_length:
                return some(2, 3);
            case op_composite_insert:
            case op_vector_shuffle:
                return some(2, 4);
            case op_function_call:
                return some(3, w.size());
            case op_variable:
                return some(3, 4);
            default:
                break;
        }
        std::vector<std::uint32_t> ids = some(in.op == op_ext_inst ? 4 : 2, w.size());
        // Image operands and group operations have one literal word.
        std::size_t literal = w.size();
        if (in.op >= op_image_first && in.op <= op_image_last) literal = in.op >= op_image_gather ? 5 : 4;
        if (in.op >= op_group_first && in.op <= op_group_last) literal = 3;
        if (literal < w.size()) ids.erase(ids.begin() + static_cast<std::ptrdiff_t>(literal - 2));
        return ids;
    }

    void addConstant(std::uint32_t id, std::set<std::uint32_t>& used) const {
        if (const auto found = spec_id_.find(id); found != spec_id_.end()) used.insert(found->second);
        if (const auto found = expressions_.find(id); found != expressions_.end())
            for (const std::uint32_t inner : found->second) addConstant(inner, used);
    }

    bool isDeadStore(const Instruction& in) const {
        return in.op == op_store && privates_.contains(in.words[0]) && !reads_.contains(in.words[0]);
    }

    std::set<std::uint32_t> deadCalls() const {
        std::set<std::uint32_t> dead;
        for (const auto& [function, body] : bodies_)
            for (const Instruction* in : body)
                if (isDeadStore(*in) && !reads_.contains(in->words[1])) dead.insert(in->words[1]);
        return dead;
    }

    Kind kindOf(std::uint32_t pointer) const {
        const Instruction& to = types_.at(pointer);
        const Instruction& type = types_.at(to.words[2]);
        constexpr std::uint32_t uniform = 2, storage = 12, dimensionBuffer = 5;
        if (type.op == op_type_struct && to.words[1] == uniform) return Kind::uniform_buffer;
        if (type.op == op_type_struct && to.words[1] == storage) return Kind::storage_buffer;
        if (type.op == op_type_sampled_image) return Kind::image;
        constexpr std::uint32_t withoutSampler = 2;
        if (type.op != op_type_image) return Kind::other;
        if (type.words[2] == dimensionBuffer) return Kind::texel_buffer;
        return type.words[6] == withoutSampler ? Kind::storage_image : Kind::fetched_image;
    }

    std::vector<Instruction> all_;
    std::uint32_t entry_ = 0, function_ = 0;
    std::map<std::uint32_t, std::vector<const Instruction*>> bodies_;  // by function
    std::map<std::uint32_t, Instruction> types_;
    std::map<std::uint32_t, std::uint32_t> spec_id_, binding_, set_;   // by id
    std::map<std::uint32_t, std::uint32_t> variables_;                 // global: their pointer types
    std::map<std::uint32_t, std::vector<std::uint32_t>> expressions_;  // OpSpecConstantOp: operands
    std::map<std::uint32_t, std::size_t> reads_;                       // by id, in functions; without stores
    std::map<std::uint32_t, std::string> names_;                       // by id
    std::set<std::uint32_t> privates_, floats_, no_contraction_;
};

}  // namespace diptych
