// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

#define LIGHTS_STORAGE
#include "tests/bench/shaders/lights.glsl"
