// SPDX-License-Identifier: MIT
// Properties of a Frame that do not depend on its renderer.
#pragma once

#include "shared/frame/frame.h"
#include "shared/image/image.h"
#include "shared/scene/scene_view.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace diptych {

class Device;

// The channels that light shades (SURFACE_CHANNELS of the contract), in that order.
std::span<const Channel> surfaceChannels();

// The view that these Settings request.
ViewRequest viewRequest(const Settings& settings);

// A Frame with everything known before rendering: name, scene, Settings, camera, background and the
// scene's notes.
Frame describedFrame(const Scene& scene, const SceneView& view, const Settings& settings);

FrameCamera cameraOf(const View& view);

// The device as reports describe it.
ReportDevice reportDevice(const Device& device);

// A note if some lit values reach or exceed the largest value of their format; else empty.
std::optional<std::string> overflowText(const Image& lit, LitFormat format);

// Median, minimum and maximum, ms.
FrameTime timeOf(std::vector<double> ms);

// With --validate, throws if the validation layers reported messages: their count and the first one.
void checkValidation(const Device& device);

}  // namespace diptych
