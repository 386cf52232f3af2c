// SPDX-License-Identifier: MIT
// Shadow maps of points and spots: the tiles of one atlas, up to six for each light that casts. A light's own
// axes are unit vectors in world directions with the light as origin. A face is a pyramid along one of them,
// with its apex in the light: 0 and 1 along x and -x, then y and z. Across face 0 run y and z, across face 2
// z and x, across face 4 x and y; face i + 1 has the axes of face i but the one that it looks along. A narrow
// spot looks along z and has face 4 alone.
#ifndef DIPTYCH_CONTRACT_LOCAL_SHADOW_H
#define DIPTYCH_CONTRACT_LOCAL_SHADOW_H

#include "types.h"

CONTRACT_BEGIN

// FEATURE_local_shadows: the kinds of lights that cast.
CONTRACT_CONST(uint, LOCAL_SHADOWS_POINTS, 1);
CONTRACT_CONST(uint, LOCAL_SHADOWS_SPOTS, 2);

CONTRACT_CONST(uint, LOCAL_FACES, 6);
// Tiles that an atlas has room for, whatever it sees: which lights cast does not depend on the view.
CONTRACT_CONST(uint, MAX_LOCAL_TILES, 256);

// Which lights cast: of points and of spots the first ones, so that a list has them at the begin of each
// part.
struct LocalCasters {
    uint point_end;   // numbers of points that cast are below it,
    uint spot_end;    // of spots below this
    uint spot_shift;  // a spot's number less this is its place in LocalShadow[]; a point's is its number less
                      // the directional lights
    uint null_light;
};
#define LOCAL_CASTERS_OF_TEXEL(a) \
    LocalCasters(floatBitsToUint(a.x), floatBitsToUint(a.y), floatBitsToUint(a.z), floatBitsToUint(a.w))
CONTRACT_LANE(LocalCasters, point_end, 0, 0);
CONTRACT_LANE(LocalCasters, spot_end, 0, 1);
CONTRACT_LANE(LocalCasters, spot_shift, 0, 2);
CONTRACT_LANE(LocalCasters, null_light, 0, 3);
CONTRACT_TEXELS(LocalCasters, 1);

// A light that casts. Depth in its tiles is depth_scale / z + depth_offset of the distance z along the face:
// 1 at the nearest caster, 0 where the light ends; linear across a tile for any plane.
struct LocalShadow {
    vec3 x;
    float depth_scale;  // m
    vec3 y;
    float depth_offset;
    vec3 z;
    float bias;  // texels, along the geometric normal
};
#define LOCAL_SHADOW_OF_TEXELS(a, b, c) LocalShadow(a.xyz, a.w, b.xyz, b.w, c.xyz, c.w)
CONTRACT_LANE(LocalShadow, x, 0, 0);
CONTRACT_LANE(LocalShadow, depth_scale, 0, 3);
CONTRACT_LANE(LocalShadow, y, 1, 0);
CONTRACT_LANE(LocalShadow, depth_offset, 1, 3);
CONTRACT_LANE(LocalShadow, z, 2, 0);
CONTRACT_LANE(LocalShadow, bias, 2, 3);
CONTRACT_TEXELS(LocalShadow, 3);

// The tile of a face: what lies at (a, b, 1) z across and along the face is at centre + texels * (a, b).
struct LocalFace {
    vec2 centre;   // in the atlas, texels
    float texels;  // 0: the face has no tile, as nothing that is seen lies in it
    float reach;   // from the centre to the farthest middle of a filter that stays in the tile, texels
};
#define LOCAL_FACE_OF_TEXEL(a) LocalFace(a.xy, a.z, a.w)
CONTRACT_LANE(LocalFace, centre, 0, 0);
CONTRACT_LANE(LocalFace, texels, 0, 2);
CONTRACT_LANE(LocalFace, reach, 0, 3);
CONTRACT_TEXELS(LocalFace, 1);

// LOCAL_SHADOW_LIGHTS: LocalCasters, then for each light LocalShadow and its faces.
CONTRACT_CONST(uint, LOCAL_SHADOW_TEXELS, 3 + 6);

CONTRACT_END

#endif
