// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/lib/vertex.glsl"

layout(location = 0) in vec3 position;

void main() { gl_Position = clipFromVertex(worldFromVertex(draws[constants.draw], position)); }
