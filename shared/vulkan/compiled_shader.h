// SPDX-License-Identifier: MIT
// A driver's statistics of one compiled shader (VK_KHR_pipeline_executable_properties).
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace diptych {

// The statistics that this program has a name for; empty where the driver says none.
struct ShaderCost {
    using Value = std::optional<double>;
    Value vector_registers;  // of a lane of a subgroup
    Value scalar_registers;  // of a subgroup
    Value spilled_vectors;   // registers of a lane that memory holds instead
    Value spilled_scalars;   // registers of a subgroup that others or memory hold instead
    Value occupancy;         // subgroups that a SIMD unit keeps at once, at most
    Value code_bytes;
    Value instructions;
    Value cycles;         // in which a SIMD unit ends a wave of 64 threads, others in between
    Value latency;        // cycles from the first to the last instruction of a subgroup
    Value shared_bytes;   // LDS of a workgroup
    Value scratch_bytes;  // private memory of a subgroup
};

// One row for each member.
struct ShaderCostRow {
    std::string_view name;     // in JSON
    std::string_view heading;  // of a column
    ShaderCost::Value ShaderCost::*value;
    std::string_view driver_name;  // as Mesa's RADV calls it
    bool shown;                    // in the table of `plan`
};
std::span<const ShaderCostRow> shaderCostRows();

struct CompilerStatistic {
    std::string name;  // the driver's
    double value = 0;
};

struct CompiledShader {
    std::string name;                           // the module's file: "gbuffer.frag"
    std::uint32_t subgroup_size = 0;            // threads
    std::vector<CompilerStatistic> statistics;  // all that the driver says
    ShaderCost cost;
};

ShaderCost costOf(std::span<const CompilerStatistic> statistics);

// Whether `a` is the heavier one to run: fewer subgroups at once, then more vector registers, then more
// cycles.
bool isHeavier(const ShaderCost& a, const ShaderCost& b);

}  // namespace diptych
