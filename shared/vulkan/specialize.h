// SPDX-License-Identifier: MIT
// A SPIR-V module with its specialization constants given and without the code that they switch off. A driver
// that is given the values beside the whole module translates all of it before it finds that most is dead:
// lavapipe takes 45 to 180 ms for each pipeline of such a module, and 10 to 30 ms for what is left of it.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <set>
#include <span>
#include <vector>

namespace diptych {

// The value of a specialization constant by its number (SpecId): 32 bits, 0 or 1 of a bool.
using SpecializationValue = std::function<std::uint32_t(std::uint32_t id)>;

// `module` as SPIR-V 1.6 (section 2) describes it, with one function, into which all others are inlined (the
// build does that: shaders/README.md), and constants of 32 bits. Integer and logical arithmetic on constants
// is folded, as vkCreateGraphicsPipelines would fold it; arithmetic on floats is left as it is, instruction
// by instruction, so that what is computed does not change by a bit. Code that no constant lets run is left
// out, as are results that nothing reads, and every input, output, binding, type and name that the code which
// is left does not name, with the capabilities that they alone demanded: floats of 16 bits, integers of 64,
// stored samples, helper invocations. `outputs`: the locations that the next stage
// reads; nothing is stored at others. In time linear in its length. Throws std::logic_error where the module
// is no such one.
std::vector<std::uint32_t> specialized(std::span<const std::uint32_t> module,
                                       const SpecializationValue& value,
                                       const std::optional<std::set<std::uint32_t>>& outputs = {});

// Locations of the inputs that a module declares: each column of a matrix and each element of an array has
// its own.
std::set<std::uint32_t> inputLocations(std::span<const std::uint32_t> module);

}  // namespace diptych
