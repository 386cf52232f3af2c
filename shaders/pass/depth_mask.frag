// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

// Depth of an alpha-masked material; discards holes.
#include "shaders/lib/surface/material.glsl"

void main() { cutOut(baseColor()); }
