// SPDX-License-Identifier: MIT
// The layers of ltc.exr: one channel Y each, column i, row j.
#pragma once

#include "shared/light/ltc.h"

namespace diptych {

struct LtcLayer {
    const char* name;
    float LtcCell::*member;
};
inline constexpr LtcLayer ltcLayers[] = {
    {"in_plane", &LtcCell::in_plane},   {"across", &LtcCell::across},   {"unsheared", &LtcCell::unsheared},
    {"magnitude", &LtcCell::magnitude}, {"fresnel", &LtcCell::fresnel}, {"error", &LtcCell::error}};

}  // namespace diptych
