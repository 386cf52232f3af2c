// SPDX-License-Identifier: MIT
#include "compare/viewer/drawing/properties.h"

#include "shared/contract/debug_mode.h"
#include "shared/scene/motion/pose.h"

#include <algorithm>
#include <cstddef>

namespace diptych::viewer {
namespace {

double durationOf(const Animation& animation) {
    double end = 0;
    for (const Keyframes& keyframes : animation.keyframes)
        if (!keyframes.times.empty()) end = std::max(end, double{keyframes.times.back()});
    return end;
}

}  // namespace

SceneProperties propertiesOf(const Scene& scene, const std::string& name) {
    SceneProperties properties;
    properties.scene = name;
    properties.name = scene.name;
    for (const Camera& camera : poseAt(scene, 0, "").cameras) properties.cameras.push_back(camera.name);
    for (const Animation& animation : scene.animations) {
        properties.animations.push_back(animation.name);
        properties.duration = std::max(properties.duration, durationOf(animation));
    }
    properties.notes = scene.notes;
    return properties;
}

void takeProperties(const Frame& frame, bool timed, PathProperties& properties) {
    properties.name = frame.name;
    if (timed) {
        properties.ms = frame.time.median;
        properties.passes = frame.passes;
        ++properties.measurement;
    }
    properties.bytes = frame.bytes;
    properties.counters = frame.counters;
    properties.notes = frame.notes;
    properties.mean_lights.reset();
    properties.max_lights.reset();
    const Image* const lights = findChannel(frame, Channel::light_count);
    if (!lights) return;
    const Coverage covered = coverage(frame, frame);
    double sum = 0, max = 0;
    for (std::size_t p = 0; p < lights->pixels(); ++p)
        if (covered.covered[p]) {
            sum += double{lights->pixel(p)[0]};
            max = std::max(max, double{lights->pixel(p)[0]});
        }
    properties.mean_lights = covered.count > 0 ? sum / static_cast<double>(covered.count) : 0;
    properties.max_lights = max;
}

}  // namespace diptych::viewer
