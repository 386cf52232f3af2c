// SPDX-License-Identifier: MIT
#include "shared/scene/scene_view.h"

#include "shared/scene/lights/rig.h"
#include "shared/scene/motion/bounds.h"
#include "shared/text/fail.h"
#include "shared/text/one_line.h"

#include <fmt/format.h>

#include <optional>
#include <utility>

namespace diptych {
namespace {

// Adds the environment's sun to the view's lights. The search for it runs once.
void takeSun(const Scene& scene, const ViewRequest& request, std::shared_ptr<const EnvironmentSun>& kept,
             SceneView& result) {
    if (!kept) kept = std::make_shared<const EnvironmentSun>(environmentSun(*scene.environment));
    result.sun = kept;
    if (!kept->found) return;
    result.environment = &kept->residual;
    if (request.environment_factor > 0)
        result.lights.push_back(
            rotatedSun(kept->light, request.environment_rotation, request.environment_factor));
}

// The direction from which the default sun shines, whichever camera is chosen: from the target of the
// scene's first camera to its eye at 0 s, so the sun does not move with the camera. None without cameras.
std::optional<glm::dvec3> firstBackward(const Scene& scene, const ViewRequest& request, const Pose& pose) {
    if (scene.cameras.empty()) return std::nullopt;
    const std::vector<Camera> cameras =
        request.time == 0 ? pose.cameras : poseAt(scene, 0, request.animation).cameras;
    if (cameras.empty()) return std::nullopt;
    View view;
    view.camera = cameras.front();
    return view.backward();
}

SceneView viewOf(const Scene& scene, const ViewRequest& request, Pose pose,
                 std::map<std::string, DefaultView>& kept, std::shared_ptr<const EnvironmentSun>& sun) {
    const auto defaultView = [&]() -> const DefaultView& {
        const auto known = kept.find(request.animation);
        if (known != kept.end()) return known->second;
        return kept.emplace(request.animation, chooseDefaultView(scene, request.animation)).first->second;
    };
    // Only what lies beyond is missing in a pose.
    if (pose.instances.empty() && hasTriangles(scene))
        fail(fmt::format("{}: nothing is left to draw: {}", oneLine(scene.name), pose.notes.back()));
    SceneView result;
    result.pose = std::move(pose);
    result.view = makeView(scene, result.pose, request.camera, request.width, request.height, defaultView);
    if (request.camera.empty() && result.pose.cameras.empty()) result.default_view = defaultView().describe();
    if (request.scene_lights) result.lights = result.pose.lights;
    if (!request.lights.empty())
        for (Light& light : makeLights(request.lights, request.seed, boundsAtStart(scene, result.pose)))
            result.lights.push_back(std::move(light));
    if (scene.environment) {
        result.environment = result.background = &*scene.environment;
        if (request.environment_sun) takeSun(scene, request, sun, result);
    }
    result.default_sun = request.scene_lights && result.lights.empty() && !scene.environment;
    if (result.default_sun) {
        const std::optional<glm::dvec3> own = firstBackward(scene, request, result.pose);
        result.lights.push_back(defaultSun(own ? *own : defaultView().backward));
    }
    result.needs = requirements(scene, result.pose, result.lights);
    return result;
}

}  // namespace

SceneView makeSceneView(const Scene& scene, const ViewRequest& request) {
    std::map<std::string, DefaultView> kept;
    std::shared_ptr<const EnvironmentSun> sun;
    return viewOf(scene, request, poseAt(scene, request.time, request.animation), kept, sun);
}

const SceneView& SceneViews::at(const ViewRequest& request) {
    std::unique_ptr<SceneView>& view = views_[request];
    if (view) return *view;
    const std::pair asked(request.time, request.animation);
    auto pose = poses_.find(asked);
    if (pose == poses_.end())
        pose = poses_.emplace(asked, poseAt(scene_, request.time, request.animation)).first;
    view = std::make_unique<SceneView>(viewOf(scene_, request, pose->second, default_views_, sun_));
    return *view;
}

void SceneViews::clear() {
    views_.clear();
    poses_.clear();
}

}  // namespace diptych
