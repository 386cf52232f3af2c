// SPDX-License-Identifier: MIT
// Skinning and morphing: morph targets first, then joints (glTF 2.0, 3.7.2.2 and 3.7.3.3). The compute
// shader and the vertex shader call the same functions, so that results are bitwise identical.
#ifndef POSING_GLSL
#define POSING_GLSL

#extension GL_EXT_buffer_reference : require
#extension GL_EXT_buffer_reference_uvec2 : require

#include "shaders/lib/contract.glsl"

// Whether two adjacent 32-bit values are loaded as one of 64 bits, which is optional in Vulkan. It takes
// lavapipe a quarter of the time.
#ifdef STAGE_comp
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
bool loadsPairs() { return (feature_posed_parts & POSED_PAIRS) != 0; }
#endif

#define ARRAY_AT(Name, type)                                                          \
    layout(buffer_reference, scalar, buffer_reference_align = 4) buffer Name {        \
        type at[];                                                                    \
    };
ARRAY_AT(UintArray, uint)
ARRAY_AT(Uvec2Array, uvec2)
ARRAY_AT(Vec2Array, vec2)
ARRAY_AT(Vec3Array, vec3)
ARRAY_AT(Vec4Array, vec4)
ARRAY_AT(MatrixArray, mat4x3)
ARRAY_AT(AttributesArray, VertexAttributes)
ARRAY_AT(DeltaArray, PosedDelta)
ARRAY_AT(MorphedArray, MorphedVertex)
#undef ARRAY_AT
#ifdef STAGE_comp
layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer PairArray { uint64_t at[]; };
vec2 pairAt(const uvec2 address, const uint at) {
    return uintBitsToFloat(unpack32(PairArray(address).at[at]));
}
#endif
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer PosedInstanceBlock {
    PosedInstance instance;
};

// Sums the morph targets of one attribute, deltas [first, end), and `rest`. Compensated summation (W.
// Kahan, "Further Remarks on Reducing Truncation Errors", 1965) makes any number of targets as exact as
// one. The loop tests at its end, because lavapipe runs one round too many of a loop that tests first. All
// threads of an instance have the same count.
#define MORPHED(Name, type, Array)                                               \
    type Name(PosedInstance i, type rest, uint first, uint end, uint vertex) {   \
        type sum = rest, rounded = type(0.0);                                    \
        if (first == end) return sum;                                            \
        uint d = first;                                                          \
        do {                                                                     \
            PosedDelta delta = DeltaArray(i.deltas).at[d];                       \
            type term = delta.weight * Array(delta.deltas).at[vertex] - rounded; \
            type next = sum + term;                                              \
            rounded = (next - sum) - term;                                       \
            sum = next;                                                          \
        } while (++d < end);                                                     \
        return sum;                                                              \
    }
MORPHED(morphed2, vec2, Vec2Array)
MORPHED(morphed3, vec3, Vec3Array)
MORPHED(morphed4, vec4, Vec4Array)
#undef MORPHED

// Object axes, from the pivot, m.
vec3 morphedPosition(const PosedInstance i, const uint vertex) {
    vec3 rest = Vec3Array(i.positions).at[vertex];
    return morphed3(i, rest - i.pivot, 0, i.positions_end, vertex);
}
// Object axes, any length.
vec3 morphedNormal(const PosedInstance i, const uint vertex) {
    vec3 rest = AttributesArray(i.attributes).at[vertex].normal;
    return morphed3(i, rest, i.positions_end, i.normals_end, vertex);
}
vec2 morphedTexcoord0(const PosedInstance i, const uint vertex) {
    vec2 rest = AttributesArray(i.attributes).at[vertex].texcoord0;
    return morphed2(i, rest, i.tangents_end, i.texcoords0_end, vertex);
}
vec2 morphedTexcoord1(const PosedInstance i, const uint vertex) {
    vec2 rest = AttributesArray(i.attributes).at[vertex].texcoord1;
    return morphed2(i, rest, i.texcoords0_end, i.texcoords1_end, vertex);
}
vec4 morphedColor(const PosedInstance i, const uint vertex) {
    vec4 rest = AttributesArray(i.attributes).at[vertex].color;
    vec4 sum = morphed4(i, rest, i.texcoords1_end, i.colors_end, vertex);
    return i.colors_end > i.texcoords1_end ? clamp(sum, vec4(0.0), vec4(1.0)) : sum;
}

uvec2 jointsAt(const PosedInstance i, const uint at) {
#ifdef STAGE_comp
    if (loadsPairs()) return unpack32(PairArray(i.joints).at[at]);
#endif
    return Uvec2Array(i.joints).at[at];
}
vec4 jointWeightsAt(const PosedInstance i, const uint at) {
#ifdef STAGE_comp
    if (loadsPairs()) return vec4(pairAt(i.joint_weights, 2 * at), pairAt(i.joint_weights, 2 * at + 1));
#endif
    return Vec4Array(i.joint_weights).at[at];
}
mat4x3 matrixAt(const PosedInstance i, const uint at) {
#ifdef STAGE_comp
    if (loadsPairs()) {
        vec2 a = pairAt(i.matrices, 6 * at), b = pairAt(i.matrices, 6 * at + 1);
        vec2 c = pairAt(i.matrices, 6 * at + 2), d = pairAt(i.matrices, 6 * at + 3);
        vec2 e = pairAt(i.matrices, 6 * at + 4), f = pairAt(i.matrices, 6 * at + 5);
        return mat4x3(vec3(a, b.x), vec3(b.y, c), vec3(d, e.x), vec3(e.y, f));
    }
#endif
    return MatrixArray(i.matrices).at[at];
}

float largestOf(const vec3 v) { return max(abs(v.x), max(abs(v.y), abs(v.z))); }

// A matrix's axes divided by its largest component, since products of very long or short axes leave
// float32. `scale` is one over that component; 0 if all are 0.
struct Axes {
    vec3 x, y, z;
    float scale;
};
Axes axesOf(const mat4x3 matrix) {
    float largest = max(largestOf(matrix[0]), max(largestOf(matrix[1]), largestOf(matrix[2])));
    float scale = largest > 0.0 ? 1.0 / largest : 0.0;
    return Axes(matrix[0] * scale, matrix[1] * scale, matrix[2] * scale, scale);
}

// Any length. Cofactors are the inverse transpose times the determinant; they also exist for singular
// matrices.
vec3 byCofactors(const Axes a, const vec3 normal) {
    return crossProduct(a.y, a.z) * normal.x + crossProduct(a.z, a.x) * normal.y +
           crossProduct(a.x, a.y) * normal.z;
}

// Skinning matrix and normal of a vertex.
struct Joined {
    mat4x3 matrix;  // weighted mean of the joints: from the object, about the pivot, to world axes
    vec3 normal;    // mean of their inverse transposes times the normal, times a number above 0
    float unit;     // one over that number, from the first joint with a weight; 0 before it
};

// The determinant's sign is ignored; PosedInstance::handedness contains it. The ratio to the first joint's
// determinant is 1 at a vertex of one joint, whose normal then equals that joint's cofactors bit for bit.
void addJoint(inout Joined sum, const mat4x3 matrix, const float weight, const bool of_joints,
              const vec3 normal) {
    sum.matrix += weight * matrix;
    if (!of_joints) return;
    Axes a = axesOf(matrix);
    float determinant = abs(dot(a.x, crossProduct(a.y, a.z)));
    float inverse = min(a.scale / max(determinant, MIN_DETERMINANT), MAX_INVERSE);
    if (sum.unit == 0.0 && weight > 0.0) sum.unit = inverse;
    float fraction = sum.unit > 0.0 ? weight * (inverse / sum.unit) : 0.0;
    sum.normal += fraction * byCofactors(a, normal);
}

Joined joined(const PosedInstance i, const uint vertex, const bool of_joints, const vec3 normal) {
    Joined sum = Joined(mat4x3(0.0), vec3(0.0), 0.0);
    if (i.joint_sets == 0) sum.matrix = matrixAt(i, 0);
    for (uint set = 0; set < i.joint_sets; ++set) {
        uint at = set * i.vertices + vertex;
        uvec2 packed = jointsAt(i, at);
        vec4 weights = jointWeightsAt(i, at);
        addJoint(sum, matrixAt(i, packed.x & 0xffffu), weights.x, of_joints, normal);
        addJoint(sum, matrixAt(i, packed.x >> 16), weights.y, of_joints, normal);
        addJoint(sum, matrixAt(i, packed.y & 0xffffu), weights.z, of_joints, normal);
        addJoint(sum, matrixAt(i, packed.y >> 16), weights.w, of_joints, normal);
    }
    return sum;
}

// World axes, from the box's origin, m. NaN beyond MAX_POSED_COORDINATE, as in the reference.
vec3 placedBy(const mat4x3 matrix, const vec3 position) {
    vec3 placed = matrix * vec4(position, 1.0);
    bool within = all(lessThanEqual(abs(placed), vec3(MAX_POSED_COORDINATE)));
    return within ? placed : vec3(uintBitsToFloat(0x7fc00000u));
}
vec3 posedPosition(const PosedInstance i, const uint vertex) {
    return placedBy(joined(i, vertex, false, vec3(0.0)).matrix, morphedPosition(i, vertex));
}

// Normal of a vertex of a flat-shaded triangle, from the deformed corners.
vec3 flatNormal(const PosedInstance i, const uint vertex) {
    uint first = vertex / 3 * 3;
    vec3 a = posedPosition(i, first);
    vec3 u = posedPosition(i, first + 1) - a, v = posedPosition(i, first + 2) - a;
    float longest = max(largestOf(u), largestOf(v));
    float scale = longest > 0.0 ? 1.0 / longest : 0.0;
    return i.handedness * unitVector(crossProduct(u * scale, v * scale));
}

// Object axes, any length; used to make tangents. For a flat-shaded triangle, the morphed triangle's own
// normal.
vec3 morphedSurfaceNormal(const PosedInstance i, const uint vertex) {
    if (i.flat_normals == 0) return morphedNormal(i, vertex);
    uint first = vertex / 3 * 3;
    vec3 a = morphedPosition(i, first);
    vec3 u = morphedPosition(i, first + 1) - a, v = morphedPosition(i, first + 2) - a;
    float longest = max(largestOf(u), largestOf(v));
    float scale = longest > 0.0 ? 1.0 / longest : 0.0;
    return crossProduct(u * scale, v * scale);
}

// A unit vector perpendicular to the normal, if the tangent's direction is unknown.
vec3 anyTangent(const vec3 normal) {
    return unitVector(crossProduct(abs(normal.x) < 0.5 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0), normal));
}

// Object axes, before skinning.
vec3 morphedTangent(const PosedInstance i, const uint vertex) {
    vec3 rest = AttributesArray(i.attributes).at[vertex].tangent.xyz;
    if (i.groups > 0) {
        uint group = UintArray(i.group_of_vertex).at[vertex];
        vec3 made = Vec3Array(i.group_tangents).at[min(group, i.groups - 1)];
        bool any = group >= i.groups || !(largestOf(made) > 0.0);
        return any ? anyTangent(unitVector(morphedSurfaceNormal(i, vertex))) : made;
    }
    return morphed3(i, rest, i.normals_end, i.tangents_end, vertex);
}

struct PosedVertex {
    vec3 position;  // world axes, from the box's origin, m
    vec3 normal;    // world axes, unit or 0
    vec3 tangent;   // world axes, unit or 0
};

// `of_joints`: each joint's inverse transpose transforms the normal, else the cofactors of the vertex's
// matrix do.
PosedVertex posedVertex(const PosedInstance i, const uint vertex, const bool of_joints) {
    vec3 normal = morphedNormal(i, vertex);
    Joined by = joined(i, vertex, of_joints, normal);
    PosedVertex posed;
    posed.position = placedBy(by.matrix, morphedPosition(i, vertex));
    vec3 turned = of_joints ? by.normal : byCofactors(axesOf(by.matrix), normal);
    // On the side of the front face.
    posed.normal = i.flat_normals != 0 ? flatNormal(i, vertex) : i.handedness * unitVector(turned);
    posed.tangent = unitVector(mat3(by.matrix) * morphedTangent(i, vertex));
    return posed;
}

#endif
