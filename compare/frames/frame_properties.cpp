// SPDX-License-Identifier: MIT
#include "compare/frames/frame_properties.h"

#include "shared/contract/surface_channels.h"
#include "shared/text/counted.h"
#include "shared/vulkan/device/device.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <utility>

namespace diptych {

std::span<const Channel> surfaceChannels() {
#define DIPTYCH_CHANNEL(number, name) Channel::name,
    static constexpr std::array channels{SURFACE_CHANNELS(DIPTYCH_CHANNEL)};
#undef DIPTYCH_CHANNEL
    return channels;
}

ViewRequest viewRequest(const Settings& settings) {
    ViewRequest request;
    request.time = settings.time;
    request.camera = settings.camera;
    request.width = settings.size.width;
    request.height = settings.size.height;
    request.lights = settings.lights;
    request.scene_lights = settings.scene_lights;
    request.seed = settings.seed;
    request.animation = settings.animation;
    request.environment_sun = settings.env_sun;
    if (settings.env_sun) {  // else all rotations of the environment share one view
        request.environment_rotation = double{settings.env_rotation};
        request.environment_factor = double{settings.ibl_intensity};
    }
    return request;
}

Frame describedFrame(const Scene& scene, const SceneView& view, const Settings& settings) {
    Frame frame;
    frame.name = std::string(nameOf(settings.path));
    frame.scene = scene.name;
    frame.settings = settings;
    frame.camera = cameraOf(view.view);
    frame.camera.choice = view.default_view;
    if (!settings.haze || settings.haze_density == 0)  // else lit is complete
        frame.background = {scene.background.r, scene.background.g, scene.background.b};
    frame.notes = scene.notes;
    frame.notes.insert(frame.notes.end(), view.pose.notes.begin(), view.pose.notes.end());
    if (!view.default_view.empty())
        frame.notes.push_back(fmt::format("the scene has no camera: viewed {}; --camera chooses another view",
                                          view.default_view));
    if (view.view.wider_frame > 0)
        frame.notes.push_back(
            fmt::format("the camera's aspect ratio is {:.3g}:1, the picture's {:.3g}:1: more is visible "
                        "above and below, and nothing is cropped",
                        view.view.wider_frame, static_cast<double>(view.view.width) / view.view.height));
    if (view.sun && settings.ibl_intensity > 0)
        frame.notes.push_back("environment: " +
                              (view.sun->found
                                   ? "its sun is a light " + describe(view.lights.back(), view.sun->fraction)
                                   : "--env-sun on: " + view.sun->why));
    frame.counters.lights = view.lights.size();
    return frame;
}

ReportDevice reportDevice(const Device& device) {
    return {device.info().name, device.info().driver, device.info().type};
}

FrameCamera cameraOf(const View& view) {
    FrameCamera camera;
    camera.name = view.camera.name;
    const glm::dvec3 eye = view.eye(), target = view.target(), up = view.up();
    for (int i = 0; i < 3; ++i) {
        camera.eye[i] = eye[i];
        camera.target[i] = target[i];
        camera.up[i] = up[i];
    }
    camera.fov_degrees = view.camera.orthographic ? 0.0 : glm::degrees(view.camera.yfov);
    camera.ymag = view.camera.orthographic ? view.camera.ymag : 0.0;
    camera.near = view.camera.near;
    camera.far = view.camera.far;
    return camera;
}

std::optional<std::string> overflowText(const Image& lit, LitFormat format) {
    if (format == LitFormat::fp32) return {};
    const std::array<float, 3> max = format == LitFormat::fp16 ? std::array{65504.0f, 65504.0f, 65504.0f}
                                                               : std::array{65024.0f, 65024.0f, 64512.0f};
    std::uint64_t count = 0;
    for (std::size_t i = 0; i < lit.pixels(); ++i) {
        const float* const p = lit.pixel(i);
        count += p[0] >= max[0] || p[1] >= max[1] || p[2] >= max[2];
    }
    if (count == 0) return {};
    return fmt::format("lit: clamped to the range of {} at {}; use --lit-format fp32", nameOf(format),
                       counted(count, "pixel"));
}

FrameTime timeOf(std::vector<double> ms) {
    FrameTime time;
    time.runs = static_cast<int>(ms.size());
    if (ms.empty()) return time;
    std::sort(ms.begin(), ms.end());
    time.min = ms.front();
    time.max = ms.back();
    time.median = 0.5 * (ms[(ms.size() - 1) / 2] + ms[ms.size() / 2]);
    return time;
}

void checkValidation(const Device& device) {
    if (const std::uint64_t count = device.validationMessages(); count > 0)
        throw std::runtime_error(fmt::format("--validate: {}, the first: {}", counted(count, "message"),
                                             device.firstValidationMessage()));
}

}  // namespace diptych
