// SPDX-License-Identifier: MIT
#version 460

layout(set = 0, binding = 0) uniform sampler2D places;  // one texel per pixel: texture coordinates
layout(set = 0, binding = 1) uniform sampler2D image;
layout(location = 0) out vec4 out_value;

// Result of the device's sampler at given texture coordinates, level 0.
void main() {
    vec4 position = texelFetch(places, ivec2(gl_FragCoord.xy), 0);
    out_value = textureLod(image, position.xy, 0.0);
}
