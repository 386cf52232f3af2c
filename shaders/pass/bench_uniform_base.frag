// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_ballot : require

#define BENCH_UNIFORM
#define BENCH_UNIFORM_BASE
#include "shaders/lib/lights/bench_lights.glsl"
