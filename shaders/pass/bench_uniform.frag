// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

#define BENCH_UNIFORM
#include "shaders/lib/lights/bench_lights.glsl"
