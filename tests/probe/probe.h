// SPDX-License-Identifier: MIT
// Runs the shipped GLSL on given inputs: a small compute shader of tests/probe/shaders includes a file of
// shaders/lib and maps `in_width` floats to `out_width` floats, once per input row.
#pragma once

#include "shared/vulkan/instance/owned.h"

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace diptych {

class Device;

// The device that all tests of this program share.
Device& probeDevice();

// A shader of tests/probe/shaders, by file name; or by path, without ".spv".
OwnedShaderModule probeModule(Device& device, const std::string& shader);

class Probes {
public:
    // `shader`: file name without ".comp"; or a path without ".comp.spv". `input`: rows of inWidth floats.
    // Returns as many rows of outWidth floats. `features`: specialization constants and their values
    // (shared/contract/features.h); all others are 0.
    std::vector<float> run(const std::string& shader, const std::vector<float>& input, std::size_t inWidth,
                           std::size_t outWidth,
                           const std::vector<std::pair<std::uint32_t, std::uint32_t>>& features = {});

    Device& device() { return probeDevice(); }
};

}  // namespace diptych
