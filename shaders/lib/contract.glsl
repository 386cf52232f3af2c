// SPDX-License-Identifier: MIT
// Everything that C++ and GLSL share, and the features as specialization constants.
#ifndef CONTRACT_GLSL
#define CONTRACT_GLSL

#extension GL_EXT_demote_to_helper_invocation : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/lib/math/arithmetic.glsl"
#include "shared/contract/area_light.h"
#include "shared/contract/bindings.h"
#include "shared/contract/clipmap.h"
#include "shared/contract/constants.h"
#include "shared/contract/debug_mode.h"
#include "shared/contract/environment.h"
#include "shared/contract/features.h"
#include "shared/contract/gbuffer.h"
#include "shared/contract/geometry.h"
#include "shared/contract/haze.h"
#include "shared/contract/light.h"
#include "shared/contract/light_list.h"
#include "shared/contract/lighting_tiles.h"
#include "shared/contract/local_shadow.h"
#include "shared/contract/ltc.h"
#include "shared/contract/material.h"
#include "shared/contract/multiscatter.h"
#include "shared/contract/object_lights.h"
#include "shared/contract/posing.h"
#include "shared/contract/samples.h"
#include "shared/contract/shadow.h"
#include "shared/contract/transparency.h"
#include "shared/contract/view.h"

#define FEATURE_CONSTANT(id, name, source, passes) \
    layout(constant_id = id) const uint feature_##name = 0;
FEATURES(FEATURE_CONSTANT)
#undef FEATURE_CONSTANT

bool on(const uint feature) { return feature != 0; }

#endif
