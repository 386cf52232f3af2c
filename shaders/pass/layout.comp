// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

// Never executed. Declares a buffer of every contract struct, so that the build can compare the offsets in
// the SPIR-V with those in C++.
#include "shaders/lib/contract.glsl"
#include "shared/contract/meshlet_culling.h"

layout(set = 3, binding = 0, scalar) buffer ViewArray { View view_array[]; };
layout(set = 3, binding = 1, scalar) buffer DrawArray { Draw draw_array[]; };
layout(set = 3, binding = 2, scalar) buffer MaterialArray { Material material_array[]; };
layout(set = 3, binding = 3, scalar) buffer LightArray { Light light_array[]; };
layout(set = 3, binding = 4, scalar) buffer VertexAttributesArray {
    VertexAttributes vertex_attributes_array[];
};
layout(set = 3, binding = 6, scalar) buffer DrawConstantsArray { DrawConstants draw_constants_array[]; };
layout(set = 3, binding = 7, scalar) buffer SpotConeArray { SpotCone spot_cone_array[]; };
layout(set = 3, binding = 8, scalar) buffer LightGridArray { LightGrid light_grid_array[]; };
layout(set = 3, binding = 9, scalar) buffer LightBoundArray { LightBound light_bound_array[]; };
layout(set = 3, binding = 10, scalar) buffer LightListHeadArray { LightListHead light_list_head_array[]; };
layout(set = 3, binding = 11, scalar) buffer LightListCountArray { LightListCount light_list_count_array[]; };
layout(set = 3, binding = 12, scalar) buffer AreaLightArray { AreaLight area_light_array[]; };
layout(set = 3, binding = 5, scalar) buffer TextureTransformArray {
    TextureTransform texture_transform_array[];
};

layout(set = 3, binding = 20, scalar) buffer ObjectLightArray { ObjectLight object_light_array[]; };
layout(set = 3, binding = 21, scalar) buffer ObjectIrradianceArray {
    ObjectIrradiance object_irradiance_array[];
};
layout(set = 3, binding = 23, scalar) buffer CulledMeshletArray { CulledMeshlet culled_meshlet_array[]; };
layout(set = 3, binding = 24, scalar) buffer CulledItemArray { CulledItem culled_item_array[]; };
layout(set = 3, binding = 25, scalar) buffer CulledPartArray { CulledPart culled_part_array[]; };
layout(set = 3, binding = 26, scalar) buffer IndirectDrawArray { IndirectDraw indirect_draw_array[]; };
layout(set = 3, binding = 27, scalar) buffer CullingConstantsArray {
    CullingConstants culling_constants_array[];
};
layout(set = 3, binding = 28, scalar) buffer TileDrawArray { TileDraw tile_draw_array[]; };
layout(set = 3, binding = 29, scalar) buffer TileDispatchArray { TileDispatch tile_dispatch_array[]; };
layout(set = 3, binding = 30, scalar) buffer TileConstantsArray { TileConstants tile_constants_array[]; };
layout(set = 3, binding = 22, scalar) buffer ObjectLightsArray { ObjectLights object_lights_array[]; };

void main() {
    culled_meshlet_array[0] = culled_meshlet_array[1];
    culled_item_array[0] = culled_item_array[1];
    culled_part_array[0] = culled_part_array[1];
    indirect_draw_array[0] = indirect_draw_array[1];
    culling_constants_array[0] = culling_constants_array[1];
    tile_draw_array[0] = tile_draw_array[1];
    tile_dispatch_array[0] = tile_dispatch_array[1];
    tile_constants_array[0] = tile_constants_array[1];
    object_light_array[0] = object_light_array[1];
    object_irradiance_array[0] = object_irradiance_array[1];
    object_lights_array[0] = object_lights_array[1];
    view_array[0] = view_array[1];
    draw_array[0] = draw_array[1];
    material_array[0] = material_array[1];
    light_array[0] = light_array[1];
    spot_cone_array[0] = spot_cone_array[1];
    light_grid_array[0] = light_grid_array[1];
    light_bound_array[0] = light_bound_array[1];
    light_list_head_array[0] = light_list_head_array[1];
    light_list_count_array[0] = light_list_count_array[1];
    area_light_array[0] = area_light_array[1];
    vertex_attributes_array[0] = vertex_attributes_array[1];
    draw_constants_array[0] = draw_constants_array[1];
    texture_transform_array[0] = texture_transform_array[1];
}
