// SPDX-License-Identifier: MIT
// Holds a Frame against the closed forms of the cells, and against another Frame, at every pixel that shows
// one texel of all textures that matter to it.
#pragma once

#include "shared/frame/frame.h"
#include "tests/image/material_cells.h"

#include <map>
#include <string>
#include <vector>

namespace diptych::tests {

// What was found of a channel: how many values were judged, how many were off by more than they may be, and
// the worst, as a multiple of what is allowed.
struct CheckedValues {
    std::size_t values = 0, wrong = 0;
    double worst = 0;
    std::string worst_at;  // "cell NAME at X, Y: GOT, not EXPECTED"
};
using ChannelChecks = std::map<int, CheckedValues>;  // by channel

// Whether any value is wrong.
bool anyWrong(const ChannelChecks& judgement);
std::string describe(const ChannelChecks& judgement);

// Channels of the material, depth and position against the closed form.
ChannelChecks againstClosedForm(const Frame& frame, const std::vector<Cell>& cells, const CellCamera& camera,
                                const CellDecode& decode);

// Every channel that both have, light among them.
ChannelChecks againstReference(const Frame& frame, const Frame& reference, const std::vector<Cell>& cells,
                               const CellCamera& camera);

}  // namespace diptych::tests
