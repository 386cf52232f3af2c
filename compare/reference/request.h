// SPDX-License-Identifier: MIT
// The input of the reference renderer.
#pragma once

#include "compare/reference/light/haze.h"
#include "compare/reference/light/punctual.h"
#include "shared/frame/channel.h"
#include "shared/frame/settings.h"
#include "shared/image/image.h"
#include "shared/scene/model/scene.h"
#include "shared/scene/motion/pose.h"
#include "shared/scene/view.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace diptych::reference {

class Checkpoint;
struct ReferenceImage;

struct Request {
    const Scene& scene;
    const Pose& pose;
    const View& view;
    std::span<const Light> lights;  // in world space
    // Environment that lights instead of the scene's, which stays the background; nullptr: the scene's.
    const Environment* residual = nullptr;
    double environment_factor = 1;
    double environment_rotation = 0;  // about +Y, counter-clockwise seen from above, rad
    glm::dvec3 ambient{0};            // uniform radiance, W/(sr m^2); attenuated by occlusion
    Multiscatter multiscatter = Multiscatter::off;
    BaseLayer base_layer = BaseLayer::max;
    SkinNormals skin_normals = SkinNormals::joints;
    Falloff falloff = {};
    std::optional<Air> air = {};
    bool blended = true;                    // whether surfaces of alphaMode BLEND are rendered
    std::vector<std::size_t> casters = {};  // indices of shadow-casting `lights`
    bool shadowed_environment = false;      // whether the environment is shadowed too
    bool shadows() const { return !casters.empty() || shadowed_environment; }
    // Whether to measure errors of environment approximations, and the occlusion of environment and
    // ambient light by geometry.
    bool environment_costs = false, surroundings = false;
    // Whether to make the channels of shadow visibility and of distances to shadow boundaries. Most of
    // their rays are not needed for light.
    bool shadow_edges = true;
    const Environment* environment() const {
        return residual ? residual : scene.environment ? &*scene.environment : nullptr;
    }
    // In both modes rays hit the skinned and morphed geometry.
    ReferenceMode mode = ReferenceMode::surface;
    int samples = 1;                                     // per pixel; mode scene only
    Resolve resolve = Resolve::linear;                   // how the samples are combined; mode scene only
    const std::map<Channel, Image>* surfaces = nullptr;  // mode surface only: the surfaceChannels()
    // Mode surface only: the same channels as deferred decodes them, for ReferenceImage::decoded; or nullptr.
    const std::map<Channel, Image>* decoded = nullptr;
    // Called once, with the image's key and the number of floats in a tile; returns the Checkpoint for
    // finished tiles. The caller owns it and removes it once the image has been written. Empty: nothing is
    // saved. `program` is this program's version; tiles saved by another version are not used.
    std::function<Checkpoint&(std::uint64_t key, std::size_t floats)> keep = {};
    std::string_view program = {};
    // Called from any thread with the finished fraction.
    std::function<void(double fraction)> progress = {};
    // Called from any thread with each finished tile: its left and top pixel, width and height. Only those
    // pixels may be read; other tiles may be written meanwhile.
    std::function<void(const ReferenceImage& image, int x, int y, int width, int height)> tile = {};
    // Called once, early, with the estimated seconds for the whole image; not called for a short one.
    std::function<void(double seconds)> expected = {};
};

}  // namespace diptych::reference
