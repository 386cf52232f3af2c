// SPDX-License-Identifier: MIT
// What a scene's skins and morph targets need of each primitive that they move: uploaded once.
#pragma once

#include "shared/contract/posing.h"
#include "shared/draw/geometry.h"
#include "shared/vulkan/resources.h"

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

namespace diptych {

class Deformations {
public:
    // What a morph target adds, by address; 0: nothing.
    struct Target {
        VkDeviceAddress positions = 0, normals = 0, tangents = 0, texcoords0 = 0, texcoords1 = 0, colors = 0;
    };
    struct Rest {
        gpu::PosedInstance instance{};  // what is the same in every pose
        std::vector<Target> targets;
    };

    // Throws std::runtime_error where memory ends. The scene and the geometry must outlive it.
    Deformations(Device& device, Uploader& uploader, const Scene& scene, const Geometry& geometry);

    // Of a primitive with joints, targets or tangents that are made anew.
    const Rest& of(int mesh, int primitive) const { return rest_.at({mesh, primitive}); }
    std::uint64_t bytes() const { return rest_.empty() ? 0 : buffer_.size(); }

private:
    std::map<std::pair<int, int>, Rest> rest_;
    GpuBuffer buffer_;
};

}  // namespace diptych
