// SPDX-License-Identifier: MIT
// Descriptor sets and bindings, named once.
#ifndef DIPTYCH_CONTRACT_BINDINGS_H
#define DIPTYCH_CONTRACT_BINDINGS_H

#include "types.h"

CONTRACT_BEGIN

CONTRACT_CONST(uint, SET_FRAME, 0);     // what every pass of a frame reads
CONTRACT_CONST(uint, SET_MATERIAL, 1);  // the textures of one material, bindings SLOT_*
CONTRACT_CONST(uint, SET_LISTS, 1);     // of the kernels that make light lists, bindings of light_list.h
CONTRACT_CONST(uint, SET_CARRIED, 3);   // sums that an earlier draw's lights left: diffuse, specular
CONTRACT_CONST(uint, SET_GBUFFER, 2);   // deferred: the attachments, bindings GBUFFER_*, then depth

CONTRACT_CONST(uint, BINDING_VIEW, 0);       // uniform View
CONTRACT_CONST(uint, BINDING_DRAWS, 1);      // buffer Draw[]
CONTRACT_CONST(uint, BINDING_MATERIALS, 2);  // buffer Material[]
CONTRACT_CONST(uint, BINDING_LIGHTS, 3);     // texels of Light[]
CONTRACT_CONST(uint, BINDING_SPOT_CONES, 4); // texels of SpotCone[]
CONTRACT_CONST(uint, BINDING_AREA_LIGHTS, 5); // texels of AreaLight[]
CONTRACT_CONST(uint, BINDING_LTC_TABLE, 6);   // image: ltc.h
CONTRACT_CONST(uint, BINDING_LIGHT_GRID, 7);    // uniform LightGrid
CONTRACT_CONST(uint, BINDING_LIST_HEADS, 8);    // texels of LightListHead[lists]
CONTRACT_CONST(uint, BINDING_LIST_INDICES, 9);  // texels of uint[]: into the lights, list_width at once
CONTRACT_CONST(uint, BINDING_LIST_COUNTS, 10);  // buffer uint[lists]
CONTRACT_CONST(uint, BINDING_ALBEDO, 11);       // buffer vec2[], see albedo.h
CONTRACT_CONST(uint, BINDING_OBJECT_LIST, 12);  // buffer ObjectLight[]
CONTRACT_CONST(uint, BINDING_OBJECTS, 13);      // buffer ObjectLights[draws]

CONTRACT_CONST(uint, BINDING_CARRIED_DIFFUSE, 0);  // of SET_CARRIED
CONTRACT_CONST(uint, BINDING_CARRIED_SPECULAR, 1);

CONTRACT_CONST(uint, BINDING_DEPTH, 7);      // of SET_GBUFFER

CONTRACT_END

#endif
