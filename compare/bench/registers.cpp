// SPDX-License-Identifier: MIT
#include "compare/bench/registers.h"

#include "compare/frames/frame_properties.h"
#include "compare/render/compiled_plan.h"
#include "compare/render/prepared_view.h"

#include <algorithm>
#include <cmath>

namespace diptych::bench {
namespace {

DeviceOptions compiledBy(DeviceCompiler& compiler, DeviceOptions drawing) {
    drawing.compiler = &compiler;
    return drawing;
}

std::string codeOf(const PipelineRequest& request) {
    return request.name() + " " + describe(request.variant());
}

}  // namespace

bool shades(const PipelineRequest& request) {
    constexpr FeatureMask lights = FeatureMask()
                                       .with(gpu::FEATURE_directional_lights)
                                       .with(gpu::FEATURE_point_lights)
                                       .with(gpu::FEATURE_spot_lights)
                                       .with(gpu::FEATURE_area_lights);
    return (request.pass.starts_with("shade") || request.pass == "transmission") &&
           request.variant().any(lights);
}

void addRegisters(std::vector<PassRegisters>& passes, const std::string& pass, double registers) {
    const auto known = std::ranges::find(passes, pass, &PassRegisters::pass);
    if (known == passes.end()) {
        passes.push_back({pass, registers, registers});
        return;
    }
    known->min = std::min(known->min, registers);
    known->max = std::max(known->max, registers);
}

RegisterCounter::RegisterCounter(const std::string& choice, const DeviceOptions& drawing)
    : compiler_(choice), device_(compiledBy(compiler_, drawing)), pipelines_(makePipelineSet(device_)) {}

std::vector<PassRegisters> RegisterCounter::registersOf(std::span<const PipelineRequest> requests) {
    std::vector<PipelineRequest> missing;
    for (const PipelineRequest& request : requests)
        if (known_.try_emplace(codeOf(request)).second) missing.push_back(request);
    const std::vector<CompiledPipeline> compiled = compiler_.compile(missing);
    for (std::size_t i = 0; i < missing.size(); ++i)
        if (!compiled[i].shaders.empty())
            known_[codeOf(missing[i])] = compiled[i].shaders.back().cost.vector_registers;
    std::vector<PassRegisters> passes;
    for (const PipelineRequest& request : requests)
        if (const auto registers = known_.at(codeOf(request))) addRegisters(passes, request.pass, *registers);
    return passes;
}

void RegisterCounter::count(const Scene& scene, std::span<BenchRow> rows) {
    if (rows.empty()) return;
    SceneViews views(scene);
    SharedResources shared(device_, scene, pipelines_);
    for (BenchRow& row : rows) {
        compiler_.takeRequests();
        const PreparedFrame prepared(device_, shared, views.at(viewRequest(row.settings)), row.settings);
        std::vector<PipelineRequest> requests = compiler_.takeRequests();
        std::erase_if(requests, [](const PipelineRequest& request) { return !shades(request); });
        row.registers = registersOf(requests);
        for (const PassRegisters& pass : row.registers)
            row.measured[Measure::registers] = std::fmax(row[Measure::registers], pass.max);
    }
}

}  // namespace diptych::bench
