// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/lib/shadows/clipmap.glsl"
#include "tests/probe/shaders/probe.glsl"

// position, extent of level 0, number of levels with a window -> level
const uint WIDTH = 5;

void main() {
    if (PROBE_ROW >= probe_rows) return;
    Clipmap map;
    map.centre = vec3(0.0);
    map.levels_from = 1.0 / IN(WIDTH, 3);
    map.levels = uint(IN(WIDTH, 4));
    OUT(1, 0) = float(levelAt(map, IN3(WIDTH, 0)));
}
