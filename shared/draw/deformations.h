// SPDX-License-Identifier: MIT
// Skinning and morphing data of each deformed primitive, uploaded once.
#pragma once

#include "shared/contract/posing.h"
#include "shared/draw/geometry.h"
#include "shared/vulkan/device/resources.h"

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

namespace diptych {

class Deformations {
public:
    // Addresses of a morph target's deltas; 0: none.
    struct Target {
        VkDeviceAddress positions = 0, normals = 0, tangents = 0, texcoords0 = 0, texcoords1 = 0, colors = 0;
    };
    struct Rest {
        gpu::PosedInstance instance{};  // members that do not depend on the pose
        std::vector<Target> targets;
    };

    // Throws std::runtime_error if memory runs out. The scene and the geometry must outlive it.
    Deformations(Device& device, Uploader& uploader, const Scene& scene, const Geometry& geometry);

    // Data of a primitive with joints, targets or recomputed tangents.
    const Rest& of(int mesh, int primitive) const { return rest_.at({mesh, primitive}); }
    std::uint64_t bytes() const { return rest_.empty() ? 0 : buffer_.size(); }

private:
    std::map<std::pair<int, int>, Rest> rest_;
    GpuBuffer buffer_;
};

}  // namespace diptych
