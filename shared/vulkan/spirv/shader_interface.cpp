// SPDX-License-Identifier: MIT
#include "shared/vulkan/spirv/shader_interface.h"

#include "shared/vulkan/spirv/spirv_ops.h"

#include <algorithm>

namespace diptych {

namespace {

using namespace spirv;

ShaderInterface interfaceOf(Words module, std::uint32_t storage) {
    std::map<std::uint32_t, std::uint32_t> taken, pointed, first, numbers;  // by id
    ShaderInterface found;
    const auto ofType = [&](std::uint32_t type) { return std::max(1u, taken[type]); };
    std::size_t at = headerWords;
    for (Words in; at < module.size() && opOf(in = instructionAt(module, at)) != OpFunction;
         at += in.size()) {
        switch (opOf(in)) {
            case OpDecorate:
                if (in[2] == decorationLocation) first[in[1]] = in[3];
                break;
            case OpConstant:
                numbers[in[2]] = in[3];
                break;
            case OpTypeMatrix:
                taken[in[1]] = in[3];
                break;
            case OpTypeArray:
                taken[in[1]] = numbers[in[3]] * ofType(in[2]);
                break;
            case OpTypePointer:
                pointed[in[1]] = in[3];
                break;
            case OpVariable:
                if (in[3] != storage || !first.contains(in[2])) break;
                for (std::uint32_t i = 0; i < ofType(pointed[in[1]]); ++i)
                    found[in[2]].push_back(first[in[2]] + i);
                break;
            default:
                break;
        }
    }
    return found;
}

}  // namespace

ShaderInterface outputsOf(std::span<const std::uint32_t> module) {
    return interfaceOf(module, storageOutput);
}

std::set<std::uint32_t> inputLocations(std::span<const std::uint32_t> module) {
    std::set<std::uint32_t> found;
    for (const auto& [variable, locations] : interfaceOf(module, storageInput))
        found.insert(locations.begin(), locations.end());
    return found;
}

}  // namespace diptych
