// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/lib/geometry/full_screen.glsl"

void main() { gl_Position = fullScreenCorner(gl_VertexIndex); }
