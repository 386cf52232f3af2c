// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_ballot : require

#define LIGHTS_UNIFORM
#define LIGHTS_UNIFORM_BASE
#include "tests/bench/shaders/lights.glsl"
