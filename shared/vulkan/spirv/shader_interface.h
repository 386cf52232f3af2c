// SPDX-License-Identifier: MIT
// Locations by which shader stages pass values to each other, in a SPIR-V module.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <span>
#include <vector>

namespace diptych {

// Variables with a location, by id, and all their locations: one for a vector, one per
// matrix column, the elements' for an array.
using ShaderInterface = std::map<std::uint32_t, std::vector<std::uint32_t>>;
ShaderInterface outputsOf(std::span<const std::uint32_t> module);

// Locations of all inputs.
std::set<std::uint32_t> inputLocations(std::span<const std::uint32_t> module);

}  // namespace diptych
