// SPDX-License-Identifier: MIT
// Driver statistics of a compiled shader (VK_KHR_pipeline_executable_properties).
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace diptych {

// Statistics that this program knows; empty if the driver does not report them.
struct ShaderCost {
    using Value = std::optional<double>;
    Value vector_registers;  // per lane of a subgroup
    Value scalar_registers;  // per subgroup
    Value spilled_vectors;   // registers of a lane spilled to memory
    Value spilled_scalars;   // registers of a subgroup spilled to vector registers or memory
    Value occupancy;         // largest number of concurrent subgroups per SIMD unit
    Value code_bytes;
    Value instructions;
    Value cycles;         // inverse throughput: cycles per wave of 64 threads on a SIMD unit
    Value latency;        // cycles from first to last instruction of a subgroup
    Value shared_bytes;   // LDS per workgroup
    Value scratch_bytes;  // private memory per subgroup
};

struct ShaderCostRow {
    std::string_view name;     // in JSON
    std::string_view heading;  // column title
    ShaderCost::Value ShaderCost::*value;
    std::string_view driver_name;  // name in Mesa's RADV
    bool shown;                    // listed in the table of `plan`
};
std::span<const ShaderCostRow> shaderCostRows();

struct CompilerStatistic {
    std::string name;  // as the driver reports it
    double value = 0;
};

struct CompiledShader {
    std::string name;                           // the module's file name: "gbuffer.frag"
    std::uint32_t subgroup_size = 0;            // threads
    std::vector<CompilerStatistic> statistics;  // all statistics of the driver
    ShaderCost cost;
};

ShaderCost costOf(std::span<const CompilerStatistic> statistics);

// Whether `a` costs more: fewer concurrent subgroups, then more vector registers, then more cycles.
bool isHeavier(const ShaderCost& a, const ShaderCost& b);

}  // namespace diptych
