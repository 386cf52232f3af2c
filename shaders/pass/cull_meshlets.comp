// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_buffer_reference_uvec2 : require

// A workgroup writes the indices of a part's triangles that may be visible, in the part's order, and their
// indirect draw. It first tests meshlets against the view, one thread each, then the triangles of several
// meshlets at a time, one thread each. The offset of a visible triangle is the number of set bits before
// its own.
#include "shaders/lib/geometry/meshlet_culling.glsl"

layout(local_size_x = CULLING_THREADS) in;
layout(push_constant, scalar) uniform CullingBlock { CullingConstants constants; };

#define ARRAY_AT(Name, type)                                                   \
    layout(buffer_reference, scalar, buffer_reference_align = 4) buffer Name { \
        type at[];                                                             \
    };
ARRAY_AT(UintArray, uint)
ARRAY_AT(Vec3Array, vec3)
ARRAY_AT(MeshletArray, CulledMeshlet)
ARRAY_AT(ItemArray, CulledItem)
ARRAY_AT(PartArray, CulledPart)
ARRAY_AT(IndirectArray, IndirectDraw)
#undef ARRAY_AT

const uint WORDS = CULLING_THREADS / 32u;
const uint AT_A_TIME = CULLING_THREADS / MAX_MESHLET_TRIANGLES;  // meshlets

shared uint in_view[MAX_PART_MESHLETS / 32u];  // one bit per meshlet of the part
shared uint meshlets[MAX_PART_MESHLETS];       // visible ones, in order
shared uint shown[WORDS];                    // one bit per triangle

uint bitsBefore(const uint lane) { return (1u << (lane & 31u)) - 1u; }

// One function, because its barriers must be reached by the whole workgroup.
void main() {
    uint part_index = gl_WorkGroupID.y * CULLING_GROUPS + gl_WorkGroupID.x, lane = gl_LocalInvocationIndex;
    if (part_index >= constants.part_count) return;
    CulledPart part = PartArray(constants.parts).at[part_index];
    CulledItem item = ItemArray(constants.items).at[part.item];
    CulledImage image = CulledImage(constants.half_size, constants.samples, constants.position_error,
                                          constants.snap);

    if (lane < MAX_PART_MESHLETS / 32u) in_view[lane] = 0u;
    barrier();
    uint meshlet = 0u;
    bool keeps = false;
    if (lane < part.meshlets) {
        meshlet = UintArray(constants.order).at[part.first + lane];
        CulledMeshlet of = MeshletArray(constants.meshlets).at[meshlet];
        keeps = !isBeyondView(item, of.min, of.max);
        if (keeps) atomicOr(in_view[lane / 32u], 1u << (lane & 31u));
    }
    barrier();
    uint meshlet_count = 0u, meshlet_offset = 0u;
    for (uint i = 0u; i < MAX_PART_MESHLETS / 32u; ++i) {
        meshlet_offset += i < lane / 32u ? uint(bitCount(in_view[i])) : 0u;
        meshlet_count += uint(bitCount(in_view[i]));
    }
    if (keeps) {
        meshlet_offset += uint(bitCount(in_view[lane / 32u] & bitsBefore(lane)));
        meshlets[meshlet_offset] = meshlet;
    }
    barrier();

    uint written = 0u;  // triangles
    for (uint first = 0u; first < meshlet_count; first += AT_A_TIME) {
        if (lane < WORDS) shown[lane] = 0u;
        barrier();
        uint k = first + lane / MAX_MESHLET_TRIANGLES, triangle = lane % MAX_MESHLET_TRIANGLES;
        bool shows = false;
        uvec3 corners = uvec3(0u);
        if (k < meshlet_count) {
            CulledMeshlet of = MeshletArray(constants.meshlets).at[meshlets[k]];
            if (triangle < of.triangles) {
                UintArray indices = UintArray(constants.indices);
                Vec3Array positions = Vec3Array(constants.positions);
                uint at = of.first_index + 3u * triangle;
                corners = uvec3(indices.at[at], indices.at[at + 1u], indices.at[at + 2u]);
                shows = mayShow(item, image, positions.at[item.first_vertex + corners.x],
                                positions.at[item.first_vertex + corners.y],
                                positions.at[item.first_vertex + corners.z]);
            }
        }
        if (shows) atomicOr(shown[lane / 32u], 1u << (lane & 31u));
        barrier();
        uint before = written;
        for (uint i = 0u; i < WORDS; ++i) {
            before += i < lane / 32u ? uint(bitCount(shown[i])) : 0u;
            written += uint(bitCount(shown[i]));
        }
        if (shows) {
            before += uint(bitCount(shown[lane / 32u] & bitsBefore(lane)));
            UintArray visible = UintArray(constants.visible_indices);
            uint at = part.first_index + 3u * before;
            visible.at[at] = corners.x;
            visible.at[at + 1u] = corners.y;
            visible.at[at + 2u] = corners.z;
        }
        barrier();
    }
    if (lane == 0u)
        IndirectArray(constants.draws).at[part.command] =
            IndirectDraw(3u * written, 1u, part.first_index, item.first_vertex, item.draw);
}
