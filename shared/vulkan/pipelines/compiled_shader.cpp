// SPDX-License-Identifier: MIT
#include "shared/vulkan/pipelines/compiled_shader.h"

#include <algorithm>
#include <tuple>

namespace diptych {

namespace {

// Names from Mesa, src/amd/vulkan/radv_shader.c and src/amd/compiler/aco_statistics.cpp.
constexpr ShaderCostRow costRows[] = {
    {"vgprs", "VGPRs", &ShaderCost::vector_registers, "VGPRs", true},
    {"sgprs", "SGPRs", &ShaderCost::scalar_registers, "SGPRs", true},
    {"spilled_vgprs", "spilled", &ShaderCost::spilled_vectors, "Spilled VGPRs", true},
    {"spilled_sgprs", "spilled SGPRs", &ShaderCost::spilled_scalars, "Spilled SGPRs", false},
    {"occupancy", "occupancy", &ShaderCost::occupancy, "Subgroups per SIMD", true},
    {"code_bytes", "bytes", &ShaderCost::code_bytes, "Code size", true},
    {"instructions", "instructions", &ShaderCost::instructions, "Instructions", false},
    {"inverse_throughput", "cycles", &ShaderCost::cycles, "Inverse Throughput", true},
    {"latency", "latency", &ShaderCost::latency, "Latency", false},
    {"lds_bytes", "LDS", &ShaderCost::shared_bytes, "LDS size", false},
    {"scratch_bytes", "scratch", &ShaderCost::scratch_bytes, "Scratch size", false},
};

}  // namespace

std::span<const ShaderCostRow> shaderCostRows() {
    return costRows;
}

ShaderCost costOf(std::span<const CompilerStatistic> statistics) {
    ShaderCost cost;
    for (const ShaderCostRow& row : costRows) {
        const auto found = std::ranges::find(statistics, row.driver_name, &CompilerStatistic::name);
        if (found != statistics.end()) cost.*row.value = found->value;
    }
    return cost;
}

bool isHeavier(const ShaderCost& a, const ShaderCost& b) {
    const auto weight = [](const ShaderCost& cost) {
        return std::tuple(-cost.occupancy.value_or(0), cost.vector_registers.value_or(0),
                          cost.cycles.value_or(0));
    };
    return weight(a) > weight(b);
}

}  // namespace diptych
