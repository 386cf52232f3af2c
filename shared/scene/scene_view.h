// SPDX-License-Identifier: MIT
// What a picture is of: a scene at one time, seen by one camera, under all its lights. Made once, and given
// to whatever draws, plans or judges that picture, so that all of them speak of the same.
#pragma once

#include "shared/scene/model/scene.h"
#include "shared/scene/motion/pose.h"
#include "shared/scene/requirements.h"
#include "shared/scene/view.h"

#include <compare>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace diptych {

struct ViewRequest {
    double time = 0;            // s
    std::string camera;         // as makeView() takes it
    int width = 0, height = 0;  // pixels
    std::string lights;         // a rig or a file, as makeLights() takes it; empty: the scene's own alone
    std::uint32_t seed = 0;     // of the rig
    auto operator<=>(const ViewRequest&) const = default;
};

struct SceneView {
    Pose pose;  // its lights are the scene's own
    View view;
    std::vector<Light> lights;  // the scene's own, then the rig's; or the default sun alone
    bool default_sun = false;   // there was no light and no environment
    Requirements needs;         // of the scene with these lights
};

// Throws std::runtime_error naming --camera or --lights where the request makes no sense.
SceneView makeSceneView(const Scene& scene, const ViewRequest& request);

// The views of one scene, each made when it is first asked for. The scene outlives it.
class SceneViews {
public:
    explicit SceneViews(const Scene& scene) : scene_(scene) {}
    SceneViews(const SceneViews&) = delete;
    SceneViews& operator=(const SceneViews&) = delete;

    const Scene& scene() const { return scene_; }
    const SceneView& at(const ViewRequest& request);  // stays where it is as long as this lives

private:
    const Scene& scene_;
    std::map<ViewRequest, std::unique_ptr<SceneView>> views_;
};

}  // namespace diptych
