// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

#define LIGHTS_UNIFORM
#include "tests/bench/shaders/lights.glsl"
