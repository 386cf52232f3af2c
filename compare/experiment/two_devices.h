// SPDX-License-Identifier: MIT
// Prepares a cross-device comparison of one path: probes both devices, and relights one device's surfaces
// on the other.
#pragma once

#include "compare/render/renderer.h"
#include "compare/verdict/across_devices.h"
#include "shared/frame/frame.h"
#include "shared/scene/model/scene.h"
#include "shared/scene/scene_view.h"

#include <array>
#include <map>

namespace diptych::experiment {

// Without AcrossDevices::relit and texcoords. `here`: a forward+ Frame of `view` on the first device. The
// scene must outlive the result.
AcrossDevices acrossDevices(const Scene& scene, const SceneView& view,
                            const std::array<DevicePrecision, 2>& devices, const Frame& here);

// AcrossDevices::relit: relights the surfaces of `there`, a Frame of another device with one sample per
// pixel, on `device`. Evaluates every light, because a position may fall into a neighbouring cell's list;
// omits blended surfaces. Throws std::runtime_error, one line, if a channel is missing.
std::map<Channel, Image> relit(Device& device, Renderer& renderer, const Frame& there);

}  // namespace diptych::experiment
