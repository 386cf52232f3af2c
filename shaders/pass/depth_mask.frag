// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
// INPUTS: 0 to 3
// COVERAGE: 0 to 1

// Depth of an alpha-masked material: holes write none.
#include "shaders/lib/material.glsl"

void main() { cutOut(baseColor()); }
