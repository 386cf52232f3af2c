// SPDX-License-Identifier: MIT
// Everything a picture shows: a scene at one time, seen by one camera, under all its lights. It is made once
// and passed to all code that draws or judges the picture, so that all of it uses the same data.
#pragma once

#include "shared/scene/lights/environment_sun.h"
#include "shared/scene/model/scene.h"
#include "shared/scene/motion/pose.h"
#include "shared/scene/requirements.h"
#include "shared/scene/view.h"

#include <compare>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace diptych {

struct ViewRequest {
    double time = 0;            // s
    std::string camera;         // INDEX, NAME or "eye=... target=...": see makeView()
    int width = 0, height = 0;  // pixels
    std::string lights;         // a rig or a file, see makeLights(); empty: only the scene's own
    std::uint32_t seed = 0;     // of the rig
    bool scene_lights = true;   // whether its own lights shine, or the sun that a scene without lights gets
    std::string animation{};    // INDEX or NAME, see poseAt(); empty: all play
    // Takes the sun out of the environment, as a light (lights/environment_sun.h), of an environment turned
    // by so many degrees and multiplied by the factor; both are read for this alone.
    bool environment_sun = false;
    double environment_turned = 0, environment_factor = 1;
    auto operator<=>(const ViewRequest&) const = default;
};

struct SceneView {
    Pose pose;  // its lights are the scene's own only
    View view;
    std::string
        default_view;  // how the camera was chosen, in words; empty where the request or scene has one
    // The scene's own, then those of the rig or file, then the environment's sun; or the default sun alone.
    std::vector<Light> lights;
    const Environment* environment =
        nullptr;  // that lights: the scene's or what its sun leaves; nullptr: none
    const Environment* background = nullptr;    // that is seen: the scene's, which must outlive this
    std::shared_ptr<const EnvironmentSun> sun;  // where one was asked for and there is an environment
    bool default_sun = false;                   // whether the scene had neither lights nor an environment
    Requirements needs;                         // of the scene under `lights`
};

// Throws std::runtime_error naming --camera, --animation or --lights if the request is invalid.
SceneView makeSceneView(const Scene& scene, const ViewRequest& request);

// Caches the views of one scene; each is made at its first request, and the scene is posed once for each
// time and choice of an animation. The scene must outlive it.
class SceneViews {
public:
    explicit SceneViews(const Scene& scene) : scene_(scene) {}
    SceneViews(const SceneViews&) = delete;
    SceneViews& operator=(const SceneViews&) = delete;

    const Scene& scene() const { return scene_; }
    // The reference stays valid until clear(), or as long as this object.
    const SceneView& at(const ViewRequest& request);
    // Frees all views and poses, for whoever needs many one after the other; how a scene without a camera is
    // seen stays known.
    void clear();

private:
    const Scene& scene_;
    std::map<std::string, DefaultView> default_views_;  // by animation
    std::shared_ptr<const EnvironmentSun> sun_;
    std::map<std::pair<double, std::string>, Pose> poses_;  // by time, s, and animation
    std::map<ViewRequest, std::unique_ptr<SceneView>> views_;
};

}  // namespace diptych
