// SPDX-License-Identifier: MIT
// Prepares the judgement of one path on two devices: probes both, and lights one device's surfaces on the
// other.
#pragma once

#include "compare/render/renderer.h"
#include "compare/verdict/across_devices.h"
#include "shared/frame/frame.h"
#include "shared/scene/model/scene.h"
#include "shared/scene/scene_view.h"

#include <array>
#include <map>

namespace diptych {

// Without AcrossDevices::relit and texcoords. `here`: a Frame of forward+ on the first device, of `view`. The
// scene must outlive it.
AcrossDevices acrossDevices(const Scene& scene, const SceneView& view,
                            const std::array<DevicePrecision, 2>& devices, const Frame& here);

// AcrossDevices::relit: what `device` makes of the surfaces of `there`, a Frame of another device with one
// sample a pixel: by every light, since a list is of a cell, and places may lie in its neighbour; and without
// what is blended. Throws std::runtime_error, one line, where a channel is missing.
std::map<int, Image> relit(Device& device, Renderer& renderer, const Frame& there);

}  // namespace diptych
