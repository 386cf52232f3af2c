// SPDX-License-Identifier: MIT
// Shadow maps of point and spot lights: tiles of one atlas, up to six per shadow-casting light. A light's
// own axes are unit vectors in world space with the light as origin.
// A face is a pyramid along one axis, with its apex at the light: 0 and 1 along x and -x, then y and z.
// Face 0 is spanned by y and z, face 2 by z and x, face 4 by x and y. Face i + 1 has the axes of face i
// with the view axis negated. A narrow spot looks along z and has face 4 alone.
#ifndef DIPTYCH_CONTRACT_LOCAL_SHADOW_H
#define DIPTYCH_CONTRACT_LOCAL_SHADOW_H

#include "types.h"

CONTRACT_BEGIN

// FEATURE_local_shadows: light types that cast shadows.
CONTRACT_CONST(uint, LOCAL_SHADOWS_POINTS, 1);
CONTRACT_CONST(uint, LOCAL_SHADOWS_SPOTS, 2);

CONTRACT_CONST(uint, LOCAL_FACES, 6);
// Capacity of an atlas in tiles. It does not depend on the view, so neither does the set of casting
// lights.
CONTRACT_CONST(uint, MAX_LOCAL_TILES, 256);

// The first point lights and the first spots cast shadows. So they come first in each light type of a list.
struct LocalCasters {
    uint point_end;   // casting point lights have an index below it
    uint spot_end;    // casting spots have an index below it
    uint spot_shift;  // a spot's index minus this is its index in LocalShadow[]; for a point, subtract the
                      // number of directional lights
    uint null_light;
};
#define LOCAL_CASTERS_OF_TEXEL(a) \
    LocalCasters(floatBitsToUint(a.x), floatBitsToUint(a.y), floatBitsToUint(a.z), floatBitsToUint(a.w))
CONTRACT_LANE(LocalCasters, point_end, 0, 0);
CONTRACT_LANE(LocalCasters, spot_end, 0, 1);
CONTRACT_LANE(LocalCasters, spot_shift, 0, 2);
CONTRACT_LANE(LocalCasters, null_light, 0, 3);
CONTRACT_TEXELS(LocalCasters, 1);

// A shadow-casting light. Depth in its tiles is depth_scale / z + depth_offset, with z the distance along
// the face: 1 at the nearest caster, 0 at the light's range. It is linear across a tile for any plane.
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

// Tile of a face: the point z * (a, b, 1), across and along the face, maps to centre + texels * (a, b).
struct LocalFace {
    vec2 centre;              // in the atlas, texels
    float texels;             // 0: the face has no tile, because no visible receiver lies in it
    float max_filter_offset;  // texels; largest offset per axis of a filter from the tile's centre that keeps
                              // it in the tile
};
#define LOCAL_FACE_OF_TEXEL(a) LocalFace(a.xy, a.z, a.w)
CONTRACT_LANE(LocalFace, centre, 0, 0);
CONTRACT_LANE(LocalFace, texels, 0, 2);
CONTRACT_LANE(LocalFace, max_filter_offset, 0, 3);
CONTRACT_TEXELS(LocalFace, 1);

// LOCAL_SHADOW_LIGHTS: LocalCasters, then LocalShadow and its faces for each light.
CONTRACT_CONST(uint, LOCAL_SHADOW_TEXELS, 3 + 6);

CONTRACT_END

#endif
