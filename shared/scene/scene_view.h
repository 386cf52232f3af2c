// SPDX-License-Identifier: MIT
// Everything an image shows: a scene at one time, from one camera, under all its lights. It is built once
// and passed to all code that renders or evaluates the image, so that all use the same data.
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
    std::string lights;         // a rig or a file, see makeLights(); empty: none
    std::uint32_t seed = 0;     // of the rig
    // Enables the scene's own lights, or the default sun of a scene without lights.
    bool scene_lights = true;
    std::string animation{};  // INDEX or NAME, see poseAt(); empty: all play
    // Extracts the sun of the environment as a light (lights/environment_sun.h), with the environment
    // rotated by environment_rotation degrees and scaled by environment_factor. These two are used only for
    // the sun.
    bool environment_sun = false;
    double environment_rotation = 0, environment_factor = 1;
    auto operator<=>(const ViewRequest&) const = default;
};

struct SceneView {
    Pose pose;  // has only the scene's own lights
    View view;
    // How the camera was chosen, for users; empty if the request or the scene has one.
    std::string default_view;
    // The scene's own, then the rig's or file's, then the environment's sun; or only the default sun.
    std::vector<Light> lights;
    // Lights the scene: the scene's own, or its residual without the sun; nullptr: none.
    const Environment* environment = nullptr;
    const Environment* background = nullptr;    // visible; the scene's, which must outlive this
    std::shared_ptr<const EnvironmentSun> sun;  // if requested and there is an environment
    bool default_sun = false;                   // the scene has neither lights nor an environment
    Requirements needs;                         // of the scene under `lights`
};

// Throws std::runtime_error naming --camera, --animation or --lights if the request is invalid, or if the
// animation has moved everything beyond maxCoordinate.
SceneView makeSceneView(const Scene& scene, const ViewRequest& request);

// Caches the views of one scene. Each is built at its first request; each pair of time and animation is
// posed once. The scene must outlive it.
class SceneViews {
public:
    explicit SceneViews(const Scene& scene) : scene_(scene) {}
    SceneViews(const SceneViews&) = delete;
    SceneViews& operator=(const SceneViews&) = delete;

    const Scene& scene() const { return scene_; }
    // The reference is valid until clear() or the end of this object.
    const SceneView& at(const ViewRequest& request);
    // Frees all views and poses. The default cameras stay cached.
    void clear();

private:
    const Scene& scene_;
    std::map<std::string, DefaultView> default_views_;  // by animation
    std::shared_ptr<const EnvironmentSun> sun_;
    std::map<std::pair<double, std::string>, Pose> poses_;  // by time, s, and animation
    std::map<ViewRequest, std::unique_ptr<SceneView>> views_;
};

}  // namespace diptych
