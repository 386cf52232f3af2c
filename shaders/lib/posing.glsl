// SPDX-License-Identifier: MIT
// Vertices of skinned and morphed instances: morph targets first, then joints (glTF 2.0, 3.7.2.2 and
// 3.7.3.3). A kernel and the vertex shader call the same functions, so that both have the same bits.
#ifndef POSING_GLSL
#define POSING_GLSL

#extension GL_EXT_buffer_reference : require
#extension GL_EXT_buffer_reference_uvec2 : require

#include "shaders/lib/contract.glsl"

// Whether two numbers of 32 bits are loaded as one of 64, where they lie so, which a device may lack.
// lavapipe takes a quarter of the time.
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
vec2 pairAt(uvec2 address, uint at) { return uintBitsToFloat(unpack32(PairArray(address).at[at])); }
#endif
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer PosedInstanceBlock {
    PosedInstance instance;
};

// Morph targets' sums of one attribute, deltas [first, end), and `rest`. What each addition rounds away is
// added to the next term (W. Kahan, "Further Remarks on Reducing Truncation Errors", 1965), so that any
// number of targets are as exact as one. lavapipe runs one round more of a loop that tests first; all
// threads of an instance have the same number.
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

// Object, from the pivot, m.
vec3 morphedPosition(PosedInstance i, uint vertex) {
    vec3 rest = Vec3Array(i.positions).at[vertex];
    return morphed3(i, rest - i.pivot, 0, i.positions_end, vertex);
}
// Object, any length.
vec3 morphedNormal(PosedInstance i, uint vertex) {
    vec3 rest = AttributesArray(i.attributes).at[vertex].normal;
    return morphed3(i, rest, i.positions_end, i.normals_end, vertex);
}
vec2 morphedTexcoord0(PosedInstance i, uint vertex) {
    vec2 rest = AttributesArray(i.attributes).at[vertex].texcoord0;
    return morphed2(i, rest, i.tangents_end, i.texcoords0_end, vertex);
}
vec2 morphedTexcoord1(PosedInstance i, uint vertex) {
    vec2 rest = AttributesArray(i.attributes).at[vertex].texcoord1;
    return morphed2(i, rest, i.texcoords0_end, i.texcoords1_end, vertex);
}
vec4 morphedColor(PosedInstance i, uint vertex) {
    vec4 rest = AttributesArray(i.attributes).at[vertex].color;
    vec4 sum = morphed4(i, rest, i.texcoords1_end, i.colors_end, vertex);
    return i.colors_end > i.texcoords1_end ? clamp(sum, vec4(0.0), vec4(1.0)) : sum;
}

uvec2 jointsAt(PosedInstance i, uint at) {
#ifdef STAGE_comp
    if (loadsPairs()) return unpack32(PairArray(i.joints).at[at]);
#endif
    return Uvec2Array(i.joints).at[at];
}
vec4 jointWeightsAt(PosedInstance i, uint at) {
#ifdef STAGE_comp
    if (loadsPairs()) return vec4(pairAt(i.joint_weights, 2 * at), pairAt(i.joint_weights, 2 * at + 1));
#endif
    return Vec4Array(i.joint_weights).at[at];
}
mat4x3 matrixAt(PosedInstance i, uint at) {
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

float largestOf(vec3 v) { return max(abs(v.x), max(abs(v.y), abs(v.z))); }

// A matrix's axes over its largest component, since products of what is very long or short leave
// float32, and one over that component; 0 where all are.
struct Axes {
    vec3 x, y, z;
    float scale;
};
Axes axesOf(mat4x3 matrix) {
    float largest = max(largestOf(matrix[0]), max(largestOf(matrix[1]), largestOf(matrix[2])));
    float scale = largest > 0.0 ? 1.0 / largest : 0.0;
    return Axes(matrix[0] * scale, matrix[1] * scale, matrix[2] * scale, scale);
}

// Of any length. Cofactors are the inverse transpose times the determinant, and exist where a matrix
// flattens.
vec3 byCofactors(Axes a, vec3 normal) {
    return crossProduct(a.y, a.z) * normal.x + crossProduct(a.z, a.x) * normal.y +
           crossProduct(a.x, a.y) * normal.z;
}

// What joints make of a vertex.
struct Joined {
    mat4x3 matrix;  // their weighted mean: from the object, about the pivot, to world axes
    vec3 normal;    // the mean of their inverse transposes times the normal, times a number above 0
    float unit;     // one over that number, which is the first joint's that counts; 0: none does yet
};

// The determinant counts without its sign, which PosedInstance::handedness has. As a ratio to the
// first joint's it is 1 at a vertex of one joint, whose normal then has the bits of that joint's
// cofactors.
void addJoint(inout Joined sum, mat4x3 matrix, float weight, bool of_joints, vec3 normal) {
    sum.matrix += weight * matrix;
    if (!of_joints) return;
    Axes a = axesOf(matrix);
    float determinant = abs(dot(a.x, crossProduct(a.y, a.z)));
    float inverse = min(a.scale / max(determinant, LEAST_DETERMINANT), MOST_INVERSE);
    if (sum.unit == 0.0 && weight > 0.0) sum.unit = inverse;
    float share = sum.unit > 0.0 ? weight * (inverse / sum.unit) : 0.0;
    sum.normal += share * byCofactors(a, normal);
}

Joined joined(PosedInstance i, uint vertex, bool of_joints, vec3 normal) {
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

// World axes, from the box's origin, m. NaN beyond what positions may be, as the reference has it.
vec3 placedBy(mat4x3 matrix, vec3 position) {
    vec3 placed = matrix * vec4(position, 1.0);
    bool within = all(lessThanEqual(abs(placed), vec3(MAX_POSED_COORDINATE)));
    return within ? placed : vec3(uintBitsToFloat(0x7fc00000u));
}
vec3 posedPosition(PosedInstance i, uint vertex) {
    return placedBy(joined(i, vertex, false, vec3(0.0)).matrix, morphedPosition(i, vertex));
}

// Of a vertex whose triangle has a normal of its own: from the posed corners.
vec3 flatNormal(PosedInstance i, uint vertex) {
    uint first = vertex / 3 * 3;
    vec3 a = posedPosition(i, first);
    vec3 u = posedPosition(i, first + 1) - a, v = posedPosition(i, first + 2) - a;
    float longest = max(largestOf(u), largestOf(v));
    float scale = longest > 0.0 ? 1.0 / longest : 0.0;
    return i.handedness * unitVector(crossProduct(u * scale, v * scale));
}

// Object, any length: as tangents are made of it. Of a flat triangle the morphed one's own.
vec3 morphedSurfaceNormal(PosedInstance i, uint vertex) {
    if (i.flat_normals == 0) return morphedNormal(i, vertex);
    uint first = vertex / 3 * 3;
    vec3 a = morphedPosition(i, first);
    vec3 u = morphedPosition(i, first + 1) - a, v = morphedPosition(i, first + 2) - a;
    float longest = max(largestOf(u), largestOf(v));
    float scale = longest > 0.0 ? 1.0 / longest : 0.0;
    return crossProduct(u * scale, v * scale);
}

// Unit, at right angles to the normal; where nothing says which way it points.
vec3 anyTangent(vec3 normal) {
    return unitVector(crossProduct(abs(normal.x) < 0.5 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0), normal));
}

// Object; before joints move it.
vec3 morphedTangent(PosedInstance i, uint vertex) {
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
    vec3 tangent;   // likewise
};

// `of_joints`: the normal goes by each joint's inverse transpose, else by the cofactors of the
// vertex's matrix.
PosedVertex posedVertex(PosedInstance i, uint vertex, bool of_joints) {
    vec3 normal = morphedNormal(i, vertex);
    Joined by = joined(i, vertex, of_joints, normal);
    PosedVertex posed;
    posed.position = placedBy(by.matrix, morphedPosition(i, vertex));
    vec3 turned = of_joints ? by.normal : byCofactors(axesOf(by.matrix), normal);
    // On the side from which the front is seen.
    posed.normal = i.flat_normals != 0 ? flatNormal(i, vertex) : i.handedness * unitVector(turned);
    posed.tangent = unitVector(mat3(by.matrix) * morphedTangent(i, vertex));
    return posed;
}

#endif
