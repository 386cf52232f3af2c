// SPDX-License-Identifier: MIT
#include "shared/scene/scene_view.h"

#include "shared/scene/lights/rig.h"
#include "shared/scene/motion/bounds.h"

#include <utility>

namespace diptych {
namespace {

// The default sun stands behind the viewer of the default view, whichever camera is chosen, so that it
// lights the sides which face that viewer.
Light sunOf(const Scene& scene, Pose pose) {
    pose.cameras.clear();
    return defaultSun(makeView(scene, pose, "", 1, 1).backward());
}

SceneView viewOf(const Scene& scene, const ViewRequest& request, Pose pose) {
    SceneView result;
    result.pose = std::move(pose);
    result.view = makeView(scene, result.pose, request.camera, request.width, request.height);
    result.lights = result.pose.lights;
    if (!request.lights.empty())
        for (Light& light : makeLights(request.lights, request.seed, boundsAtStart(scene, result.pose)))
            result.lights.push_back(std::move(light));
    result.default_sun = result.lights.empty() && !scene.environment;
    if (result.default_sun) result.lights.push_back(sunOf(scene, result.pose));
    result.needs = requirements(scene, result.pose, result.lights);
    return result;
}

}  // namespace

SceneView makeSceneView(const Scene& scene, const ViewRequest& request) {
    return viewOf(scene, request, poseAt(scene, request.time));
}

const SceneView& SceneViews::at(const ViewRequest& request) {
    std::unique_ptr<SceneView>& view = views_[request];
    if (view) return *view;
    auto pose = poses_.find(request.time);
    if (pose == poses_.end()) pose = poses_.emplace(request.time, poseAt(scene_, request.time)).first;
    view = std::make_unique<SceneView>(viewOf(scene_, request, pose->second));
    return *view;
}

}  // namespace diptych
