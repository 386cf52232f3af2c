// SPDX-License-Identifier: MIT
// Registers of the pipelines that shade, from a GPU's compiler: bench --compile-on.
#pragma once

#include "compare/bench/bench.h"
#include "shared/vulkan/device/device.h"
#include "shared/vulkan/pipelines/device_compiler.h"

#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>

namespace diptych::bench {

class RegisterCounter {
public:
    // `choice`: of DeviceCompiler, which may throw. `drawing`: of the device that prepares the frames.
    RegisterCounter(const std::string& choice, const DeviceOptions& drawing);

    const DeviceInfo& info() const { return compiler_.info(); }
    // Counts the registers of rows that are frames of the scene. Renders nothing.
    void count(const Scene& scene, std::span<BenchRow> rows);

private:
    std::vector<PassRegisters> registersOf(std::span<const PipelineRequest> requests);

    DeviceCompiler compiler_;
    Device device_;
    std::shared_ptr<PipelineSet> pipelines_;
    std::map<std::string, std::optional<double>> known_;  // by shader and variant
};

// Whether the pipeline evaluates lights in a pass that shades.
bool shades(const PipelineRequest& request);
// Adds a pipeline to its pass.
void addRegisters(std::vector<PassRegisters>& passes, const std::string& pass, double registers);

}  // namespace diptych::bench
