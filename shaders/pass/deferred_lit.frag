// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

// Draws what deferred_shade.comp has stored, the first of the partial sums, to images of fewer bits: a device
// rounds what it draws to them in its own way, and what shaders store in another.
#define FLAT_VIEW
#include "shaders/lib/partial_sums.glsl"

layout(location = 0) out vec4 out_lit;

void main() { out_lit = partialDiffuse(); }
