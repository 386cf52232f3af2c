// SPDX-License-Identifier: MIT
#include "compare/external/job.h"

#include "compare/external/scene_gltf.h"
#include "compare/files/diptych_files.h"
#include "compare/files/frame_json.h"
#include "compare/files/gltf_file.h"
#include "compare/frames/frame_properties.h"
#include "compare/run/version.h"
#include "shared/image/atomic_file.h"
#include "shared/image/exr.h"
#include "shared/scene/lights/lights_json.h"
#include "shared/text/json.h"
#include "shared/text/json_text.h"

#include <fmt/format.h>
#include <glm/mat3x3.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <span>
#include <utility>

namespace diptych::external {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

// The view with a corrected field of view.
View passedView(const View& view, const InputCorrections& corrections) {
    View passed = view;
    const double yfov = view.camera.yfov + glm::radians(corrections.fov_offset);
    passed.camera.yfov = std::clamp(yfov, glm::radians(0.01), glm::radians(179.9));
    return passed;
}

// OpenGL clip space, as in glTF: y up, depth -1 at the near plane, 1 at the far plane.
glm::dmat4 clipFromView(const View& view, const InputCorrections& corrections) {
    const Camera& camera = view.camera;
    const double aspect = static_cast<double>(view.width) / view.height;
    const double n = camera.near, f = camera.far;
    // A pixel is 2 / size in NDC. With perspective, w is the view depth, so the shift goes into the z
    // column.
    const double x = 2 * corrections.shift_x / view.width, y = -2 * corrections.shift_y / view.height;
    glm::dmat4 clip(0.0);
    if (camera.orthographic) {
        clip[0][0] = 1 / (camera.ymag * aspect);
        clip[1][1] = 1 / camera.ymag;
        clip[2][2] = std::isfinite(f) ? -2 / (f - n) : -1e-6 / camera.ymag;
        clip[3] = glm::dvec4(x, y, std::isfinite(f) ? -(f + n) / (f - n) : -1 - 1e-6 * n / camera.ymag, 1);
    } else {
        const double t = std::tan(camera.yfov / 2);
        clip[0][0] = 1 / (t * aspect);
        clip[1][1] = 1 / t;
        clip[2] = glm::dvec4(0 - x, 0 - y, std::isfinite(f) ? -(f + n) / (f - n) : -1, -1);
        clip[3][2] = std::isfinite(f) ? -2 * f * n / (f - n) : -2 * n;
    }
    return clip;
}

glm::dmat4 viewFromWorld(const View& view) {
    const glm::dmat3 rotation = glm::transpose(glm::dmat3(view.right(), view.up(), view.backward()));
    glm::dmat4 matrix(rotation);
    matrix[3] = glm::dvec4(-(rotation * view.eye()), 1);
    return matrix;
}

Json cameraJson(const View& view, const InputCorrections& corrections) {
    Json json = jsonOf(cameraOf(view));
    json.erase("choice");
    json["projection"] = view.camera.orthographic ? "orthographic" : "perspective";
    json["fov_degrees"] = view.camera.orthographic ? Json(nullptr) : Json(glm::degrees(view.camera.yfov));
    json["ymag"] = view.camera.orthographic ? Json(view.camera.ymag) : Json(nullptr);
    json["aspect"] = static_cast<double>(view.width) / view.height;
    json["view_from_world"] = listOf(viewFromWorld(view));
    json["clip_from_view"] = listOf(clipFromView(view, corrections));
    return json;
}

double factorOf(LightKind kind, const InputCorrections& corrections) {
    switch (kind) {
        case LightKind::point:
            return corrections.point_factor;
        case LightKind::spot:
            return corrections.spot_factor;
        case LightKind::directional:
            return corrections.directional_factor;
        default:
            return corrections.area_factor;
    }
}

std::vector<Light> passedLights(std::vector<Light> lights, const InputCorrections& corrections) {
    for (Light& light : lights)
        light.intensity = static_cast<float>(light.intensity * factorOf(light.kind, corrections));
    return lights;
}

Json lightsJson(const std::vector<Light>& lights) {
    Json list = Json::array();
    for (const Light& light : lights) list.push_back(jsonOf(light));
    return list;
}

Image fromRightToLeft(const Image& image) {
    Image mirrored = image;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            for (int c = 0; c < image.components; ++c)
                mirrored.at(x, y, c) = image.at(image.width - 1 - x, y, c);
    return mirrored;
}

// Whether the scene is all that its file selects: no built-in scene, and neither another scene (?scene=) nor
// a material variant of the file, which another renderer would not choose.
bool isFile(const Scene& scene) {
    std::error_code error;
    return scene.variant < 0 && !scene.name.starts_with("builtin:") && fs::is_regular_file(scene.name, error);
}

class JobWriter {
public:
    JobWriter(const fs::path& folder, const Scene& scene, const SceneView& view, const Settings& settings,
              const ExternalRenderer& renderer)
        : folder_(folder),
          scene_(scene),
          view_(view),
          settings_(settings),
          renderer_(renderer),
          corrections_(renderer.corrections) {}

    Job write() {
        Job job;
        job.file = folder_ / "job.json";
        job.image = folder_ / "picture.exr";
        SceneView passed = view_;
        passed.view = passedView(view_.view, corrections_);
        passed.lights = passedLights(view_.lights, corrections_);
        const Json json{{"schema", 1},
                        {"software", softwareName},
                        {"version", versionName()},
                        {"renderer", renderer_.name},
                        {"scene", scene(passed, job.notes)},
                        {"time", settings_.time},
                        {"size", {settings_.size.width, settings_.size.height}},
                        {"samples", settings_.msaa},
                        {"camera", cameraJson(passed.view, corrections_)},
                        {"lights", lightsJson(passed.lights)},
                        {"rig", rig(passed, job.notes)},
                        {"environment", environment(view_.environment, "environment.exr")},
                        {"background", background()},
                        {"ambient", {settings_.ambient.r, settings_.ambient.g, settings_.ambient.b}},
                        {"exposure", nullptr},
                        {"tone_curve", nullptr},
                        {"output",
                         {{"file", job.image.string()},
                          {"format", "exr"},
                          {"pixels", "float"},
                          {"origin", "top left"},
                          {"primaries", "rec709"},
                          {"transfer", "linear"}}},
                        {"settings", parseOrderedJson(toJson(settings_))}};
        job.text = jsonText(json, -1);
        writeFile(job.file, jsonText(json) + "\n");
        return job;
    }

private:
    Json scene(const SceneView& passed, std::vector<std::string>& notes) const {
        const bool copied = renderer_.posed || !isFile(scene_);
        Json json{{"name", scene_.name},
                  {"file", copied ? (folder_ / "scene.glb").string() : fs::absolute(scene_.name).string()},
                  {"copy", copied},
                  {"animation", settings_.animation}};
        if (copied) put("scene.glb", sceneGltf(scene_, passed, settings_.skin_normals), "scene.glb", notes);
        return json;
    }

    Json rig(const SceneView& passed, std::vector<std::string>& notes) const {
        put("rig.glb", rigGltf(passed), "rig.glb", notes);
        return {{"file", (folder_ / "rig.glb").string()}};
    }

    void put(const char* name, const WrittenScene& written, const char* who,
             std::vector<std::string>& notes) const {
        writeFile(folder_ / name, written.glb);
        for (const std::string& line : written.notes) {
            const std::string note = fmt::format("{}: omitted from {}: {}", renderer_.name, who, line);
            notes.push_back(note);
        }
    }

    Json environment(const Environment* light, const char* name) const {
        if (!light) return nullptr;
        const fs::path file = folder_ / name;
        const Image mirrored = corrections_.environment_mirrored ? fromRightToLeft(light->radiance) : Image();
        writeExr(file, {{{"R", "G", "B"}, mirrored.empty() ? &light->radiance : &mirrored}});
        return {{"file", file.string()},
                {"mapping", "lat-long"},
                {"rotation_degrees", double{settings_.env_rotation} + corrections_.environment_rotation},
                {"intensity", double{settings_.ibl_intensity} * corrections_.environment_factor}};
    }

    // Our images are 0 without a surface, and those pixels are not compared.
    Json background() const {
        const bool other = view_.background && view_.background != view_.environment;
        return {{"shown", false},
                {"color", listOf(glm::dvec3(scene_.background))},
                {"environment", other ? environment(view_.background, "background.exr") : Json(nullptr)}};
    }

    const fs::path& folder_;
    const Scene& scene_;
    const SceneView& view_;
    const Settings& settings_;
    const ExternalRenderer& renderer_;
    const InputCorrections& corrections_;
};

}  // namespace

Job writeJob(const fs::path& folder, const Scene& scene, const SceneView& view, const Settings& settings,
             const ExternalRenderer& renderer) {
    return JobWriter(folder, scene, view, settings, renderer).write();
}

}  // namespace diptych::external
