// SPDX-License-Identifier: MIT
#include "shared/draw/object_lights.h"

#include "shared/contract/bindings.h"

#include <glm/common.hpp>

#include <chrono>
#include <vector>

namespace diptych {

namespace {

// Bounding box of the item in world axes from the camera.
ObjectPosition positionOf(const DrawItem& item, const gpu::Draw& draw) {
    const glm::dvec3 centre = (item.range.bounds_min + item.range.bounds_max) * 0.5;
    const glm::dvec3 half = (item.range.bounds_max - item.range.bounds_min) * 0.5;
    ObjectPosition position;
    position.centre = glm::dvec3(draw.world_from_object[3]);
    for (int axis = 0; axis < 3; ++axis) {
        const glm::dvec3 column(draw.world_from_object[axis]);
        position.centre += column * centre[axis];
        position.half += glm::abs(column) * half[axis];
    }
    position.harmonics = item.variant.get(gpu::FEATURE_lightmap_texture) == 0;
    return position;
}

}  // namespace

ObjectLightBuffers::ObjectLightBuffers(Device& device, Uploader& uploader, const DrawList& draws,
                                       const GpuLights& lights, std::optional<std::uint32_t> pixels) {
    ObjectLightLists lists;
    if (pixels) {
        const auto start = std::chrono::steady_clock::now();
        std::vector<ObjectPosition> positions(draws.draws.size());
        for (const DrawItem& item : draws.items)
            positions[item.draw] = positionOf(item, draws.draws[item.draw]);
        lists = objectLightLists(lights, positions, *pixels);
        selection_ms_ =
            std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    }
    features_ = lists.features;
    longest_ = lists.longest;
    entries_ = makeBuffer<gpu::ObjectLight>(device, uploader, "object light lists", lists.entries,
                                            VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
    objects_ = makeBuffer<gpu::ObjectLights>(device, uploader, "object lights", lists.objects,
                                             VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
}

void ObjectLightBuffers::bind(DescriptorSets& sets) const {
    sets.buffer(0, gpu::BINDING_OBJECT_LIST, entries_.handle());
    sets.buffer(0, gpu::BINDING_OBJECTS, objects_.handle());
}

}  // namespace diptych
