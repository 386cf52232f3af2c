// SPDX-License-Identifier: MIT
// Facts about a Frame that do not depend on who drew it.
#pragma once

#include "shared/frame/frame.h"
#include "shared/image/image.h"
#include "shared/scene/scene_view.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace diptych {

class Device;

// The view that these Settings ask for.
ViewRequest viewRequest(const Settings& settings);

// A Frame with all that is known before drawing: name, scene, Settings, camera, background and the scene's
// notes.
Frame describedFrame(const Scene& scene, const SceneView& view, const Settings& settings);

FrameCamera cameraOf(const View& view);

// What reports say of a device.
ReportDevice reportDevice(const Device& device);

// Pixels with a component that is NaN or infinite.
std::uint64_t nonfinitePixels(const Image& image);

// What a picture says where some of its lit is as large as its format holds, or larger; nothing elsewhere.
std::optional<std::string> overflowInWords(const Image& lit, LitFormat format);

// Replaces NaN by 0 and infinities by the largest float32 of their sign. Returns the pixels that had some.
std::vector<std::uint32_t> repairNonfinite(Image& image);

// Of each channel that was repaired a line: "lit had 3 pixel(s) that were NaN or infinite, the first at 4,2:
// ...".
std::vector<std::string> repairedInWords(const Frame& frame);

// Median, least and greatest, ms.
FrameTime timeOf(std::vector<double> ms);

}  // namespace diptych
