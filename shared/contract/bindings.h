// SPDX-License-Identifier: MIT
// Descriptor sets and bindings, named once.
#ifndef DIPTYCH_CONTRACT_BINDINGS_H
#define DIPTYCH_CONTRACT_BINDINGS_H

#include "types.h"

CONTRACT_BEGIN

CONTRACT_CONST(uint, SET_FRAME, 0);     // what every pass of a frame reads
CONTRACT_CONST(uint, SET_MATERIAL, 1);  // one material: textures at SLOT_*, BINDING_MATERIAL
CONTRACT_CONST(uint, SET_LISTS, 1);     // of the kernels that make light lists, bindings of light_list.h
CONTRACT_CONST(uint, SET_CARRIED, 3);   // sums that an earlier draw's lights left: diffuse, specular
CONTRACT_CONST(uint, SET_GBUFFER, 2);   // deferred: the attachments, bindings GBUFFER_*, then depth

CONTRACT_CONST(uint, BINDING_VIEW, 0);          // uniform View
CONTRACT_CONST(uint, BINDING_LIGHT_GRID, 1);    // uniform LightGrid
CONTRACT_CONST(uint, BINDING_LIGHTS, 2);        // texels of Light[]
CONTRACT_CONST(uint, BINDING_SPOT_CONES, 3);    // texels of SpotCone[]
CONTRACT_CONST(uint, BINDING_AREA_LIGHTS, 4);   // texels of AreaLight[]
CONTRACT_CONST(uint, BINDING_LTC_TABLE, 5);     // image: ltc.h
CONTRACT_CONST(uint, BINDING_LIST_HEADS, 6);    // texels of LightListHead[lists]
CONTRACT_CONST(uint, BINDING_LIST_INDICES, 7);  // texels of uint[]: into the lights, list_width at once
CONTRACT_CONST(uint, BINDING_LIST_COUNTS, 8);   // buffer uint[lists]
CONTRACT_CONST(uint, BINDING_ALBEDO, 9);        // buffer vec2[], see albedo.h
CONTRACT_CONST(uint, BINDING_OBJECT_LIST, 10);  // buffer ObjectLight[]
CONTRACT_CONST(uint, BINDING_OBJECTS, 11);      // buffer ObjectLights[draws]
CONTRACT_CONST(uint, BINDING_VIEW_TEXELS, 12);  // texels of PackedView

CONTRACT_CONST(uint, BINDING_MATERIAL, 8);  // of SET_MATERIAL: uniform Material, after the slots

CONTRACT_CONST(uint, BINDING_CARRIED_DIFFUSE, 0);  // of SET_CARRIED
CONTRACT_CONST(uint, BINDING_CARRIED_SPECULAR, 1);

CONTRACT_CONST(uint, BINDING_DEPTH, 7);  // of SET_GBUFFER

CONTRACT_END

#endif
