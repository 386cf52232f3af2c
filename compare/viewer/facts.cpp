// SPDX-License-Identifier: MIT
#include "compare/viewer/facts.h"

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

SceneFacts factsOf(const Scene& scene, const std::string& name) {
    SceneFacts facts;
    facts.scene = name;
    facts.name = scene.name;
    for (const Camera& camera : poseAt(scene, 0, "").cameras) facts.cameras.push_back(camera.name);
    for (const Animation& animation : scene.animations) {
        facts.animations.push_back(animation.name);
        facts.duration = std::max(facts.duration, durationOf(animation));
    }
    facts.notes = scene.notes;
    return facts;
}

void takeFacts(const Frame& frame, bool timed, PathFacts& facts) {
    facts.name = frame.name;
    if (timed) {
        facts.ms = frame.time.median;
        facts.passes = frame.passes;
        ++facts.measurement;
    }
    facts.bytes = frame.bytes;
    facts.counters = frame.counters;
    facts.notes = frame.notes;
    facts.mean_lights.reset();
    facts.most_lights.reset();
    const Image* const lights = findChannel(frame, Channel::light_count);
    if (!lights) return;
    const Coverage covered = coverage(frame, frame);
    double sum = 0, most = 0;
    for (std::size_t p = 0; p < lights->pixels(); ++p)
        if (covered.covered[p]) {
            sum += double{lights->pixel(p)[0]};
            most = std::max(most, double{lights->pixel(p)[0]});
        }
    facts.mean_lights = covered.count > 0 ? sum / static_cast<double>(covered.count) : 0;
    facts.most_lights = most;
}

}  // namespace diptych::viewer
