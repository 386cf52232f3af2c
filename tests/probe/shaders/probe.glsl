// SPDX-License-Identifier: MIT
// Reads one row of floats and writes one; see tests/probe/probe.h.
#extension GL_EXT_scalar_block_layout : require

layout(local_size_x = 64) in;
layout(set = 0, binding = 0, scalar) readonly buffer ProbeIn { float probe_in[]; };
layout(set = 0, binding = 1, scalar) writeonly buffer ProbeOut { float probe_out[]; };
layout(push_constant, scalar) uniform ProbeRows { uint probe_rows; };

#define PROBE_ROW gl_GlobalInvocationID.x
#define IN(width, i) probe_in[PROBE_ROW * (width) + (i)]
#define IN3(width, i) vec3(IN(width, i), IN(width, (i) + 1), IN(width, (i) + 2))
#define OUT(width, i) probe_out[PROBE_ROW * (width) + (i)]
