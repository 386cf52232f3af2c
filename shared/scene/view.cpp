// SPDX-License-Identifier: MIT
#include "shared/scene/view.h"

#include "shared/scene/model/axes.h"
#include "shared/scene/motion/bounds.h"
#include "shared/text/did_you_mean.h"
#include "shared/text/fail.h"
#include "shared/text/indexed_names.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <optional>
#include <string_view>

namespace diptych {

// ---- the camera's axes -------------------------------------------------------------------------------

namespace {

double tanHalfFov(const Camera& camera) {
    return std::tan(camera.yfov * 0.5);
}

}  // namespace

glm::dvec3 View::eye() const {
    return glm::dvec3(camera.world_from_camera[3]);
}
glm::dvec3 View::target() const {
    return eye() - backward() * target_distance;
}
glm::dvec3 View::backward() const {
    return unitOr(glm::dvec3(camera.world_from_camera[2]), {0, 0, 1});
}
glm::dvec3 View::up() const {
    return glm::cross(backward(), right());
}

// Derived from up and backward, so the image is undistorted even if the node is scaled, sheared or
// mirrored.
glm::dvec3 View::right() const {
    const glm::dvec3 b = backward();
    return unitOr(glm::cross(unitOr(glm::dvec3(camera.world_from_camera[1]), {0, 1, 0}), b),
                  perpendicularTo(b));
}

// ---- projection --------------------------------------------------------------------------------------

// With view depth d, planes n and f, t = tan(fov / 2):
// perspective    z = (n f / (f - n)) / d - n / (f - n);   w = d;   without a far plane f is infinite,
//                which leaves z = n / d
// orthographic   z = (f - d) / (f - n);                   w = 1
glm::dmat4 View::clipFromWorld() const {
    const double aspect = static_cast<double>(width) / height;
    const double n = camera.near, f = camera.far;
    glm::dmat4 clipFromView(0.0);
    if (camera.orthographic) {
        clipFromView[0][0] = 1 / (camera.ymag * aspect);
        clipFromView[1][1] = -1 / camera.ymag;
        clipFromView[2][2] = 1 / (f - n);
        clipFromView[3][2] = f / (f - n);
        clipFromView[3][3] = 1;
    } else {
        const double t = tanHalfFov(camera);
        clipFromView[0][0] = 1 / (t * aspect);
        clipFromView[1][1] = -1 / t;
        clipFromView[2][2] = n / (f - n);
        clipFromView[3][2] = n / (1 - n / f);
        clipFromView[2][3] = -1;
    }
    const glm::dmat4 viewFromWorld(glm::transpose(glm::dmat3(right(), up(), backward())));
    return clipFromView * viewFromWorld;
}

gpu::View View::gpuView() const {
    const glm::dvec3 r = right(), u = up(), b = backward();
    const double aspect = static_cast<double>(width) / height;
    const double n = camera.near, f = camera.far;
    // Half the image's height, m, or m per m of depth. Pixels are square.
    const double half = camera.orthographic ? camera.ymag : tanHalfFov(camera);
    const glm::dvec3 corner = (u - r * aspect) * half;  // pixel coordinates (0, 0), top left
    const glm::dvec3 perX = r * (2 * half / height), perY = u * (-2 * half / height);

    gpu::View view{};
    view.clip_from_world = gpu::mat4(clipFromWorld());
    view.backward = gpu::vec3(b);
    if (camera.orthographic) {
        view.origin_0 = gpu::vec3(corner);
        view.origin_x = gpu::vec3(perX);
        view.origin_y = gpu::vec3(perY);
        view.direction_0 = gpu::vec3(-b);
        view.depth_numerator = gpu::vec2(f, n - f);  // d = f + (n - f) z
        view.depth_denominator = gpu::vec2(1, 0);
    } else {
        view.direction_0 = gpu::vec3(corner - b);
        view.direction_x = gpu::vec3(perX);
        view.direction_y = gpu::vec3(perY);
        view.depth_numerator = gpu::vec2(n / (1 - n / f), 0);  // d = (n f / (f - n)) / (z + n / (f - n))
        view.depth_denominator = gpu::vec2(n / (f - n), 1);
    }
    return view;
}

// ---- choosing a camera -------------------------------------------------------------------------------

namespace {

constexpr std::string_view accepted = "an index, a name, or \"eye=x,y,z target=x,y,z fov=deg near=m far=m\"";

[[noreturn]] void failCamera(std::string_view choice, const std::string& why) {
    fail(fmt::format("--camera \"{}\": {}", choice, why));
}

std::optional<double> number(std::string_view text) {
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || std::isnan(value)) return std::nullopt;
    return value;
}

double numberOf(std::string_view choice, const std::string& key, std::string_view text) {
    const auto value = number(text);
    if (!value) failCamera(choice, fmt::format("{}={} is not a number", key, text));
    return *value;
}

glm::dvec3 pointOf(std::string_view choice, const std::string& key, std::string_view text) {
    glm::dvec3 point(0);
    std::string_view rest = text;
    for (int i = 0; i < 3; ++i) {
        const std::size_t comma = i < 2 ? rest.find(',') : rest.size();
        const auto value = comma == rest.npos ? std::nullopt : number(rest.substr(0, comma));
        if (!value || std::isinf(*value))
            failCamera(choice, fmt::format("{}={} is not three finite numbers x,y,z", key, text));
        point[i] = *value;
        if (i < 2) rest.remove_prefix(comma + 1);
    }
    return point;
}

// Parses "key=value key=value"; each key may occur once.
std::map<std::string, std::string> words(const std::string& choice) {
    std::map<std::string, std::string> result;
    for (std::size_t at = 0; (at = choice.find_first_not_of(" \t", at)) != choice.npos;) {
        const std::size_t end = std::min(choice.find_first_of(" \t", at), choice.size());
        const std::string word = choice.substr(at, end - at);
        const std::size_t equals = word.find('=');
        if (equals == word.npos) failCamera(choice, fmt::format("\"{}\" is not key=value", word));
        if (!result.emplace(word.substr(0, equals), word.substr(equals + 1)).second)
            failCamera(choice, fmt::format("{} is given twice", word.substr(0, equals)));
        at = end;
    }
    return result;
}

View explicitView(const DefaultViewOf& defaultView, const Bounds& bounds, double aspect,
                  const std::string& choice) {
    View view;
    Camera& camera = view.camera = freeCamera(bounds);
    const std::map<std::string, std::string> requested = words(choice);
    glm::dvec3 eye(0), target = usableCentre(bounds);
    if (!requested.contains("eye")) eye = glm::dvec3(worldFromCamera(defaultView(), bounds, aspect)[3]);
    for (const auto& [key, value] : requested) {
        if (key == "eye")
            eye = pointOf(choice, key, value);
        else if (key == "target")
            target = pointOf(choice, key, value);
        else if (key == "fov")
            camera.yfov = glm::radians(numberOf(choice, key, value));
        else if (key == "near")
            camera.near = numberOf(choice, key, value);
        else if (key == "far")
            camera.far = numberOf(choice, key, value);
        else
            failCamera(choice, fmt::format("\"{}\" is not one of eye, target, fov, near, far", key));
    }
    if (!(camera.yfov > 0 && camera.yfov < glm::radians(180.0)))
        failCamera(choice, "fov must be between 0 and 180 degrees");
    if (!(camera.near > 0) || std::isinf(camera.near)) failCamera(choice, "near must be above 0 and finite");
    if (!(camera.far > camera.near))
        failCamera(choice, fmt::format("far must be beyond near ({:g})", camera.near));
    view.target_distance = glm::length(eye - target);
    if (!(view.target_distance > 0) || std::isinf(view.target_distance))
        failCamera(choice, "eye and target are the same point or too far apart");
    camera.world_from_camera = lookAt(eye, target);
    return view;
}

std::vector<std::vector<std::string>> namesOf(const std::vector<Camera>& cameras) {
    std::vector<std::vector<std::string>> names;
    for (const Camera& camera : cameras) names.push_back({camera.name, camera.node_name});
    return names;
}

std::string listOf(const std::vector<Camera>& cameras) {
    if (cameras.empty()) return "the scene has no camera";
    std::string list;
    for (std::size_t i = 0; i < cameras.size(); ++i) {
        const bool own = cameras[i].node_name.empty() || cameras[i].node_name == cameras[i].name;
        list += fmt::format("{}{} \"{}\"{}", i ? ", " : "", i, cameras[i].name,
                            own ? "" : fmt::format(" (node \"{}\")", cameras[i].node_name));
    }
    return "the scene has " + list;
}

const Camera* sceneCamera(const Pose& pose, const std::string& choice) {
    const auto index = indexOfNamed(choice, namesOf(pose.cameras), fmt::format("--camera \"{}\"", choice));
    return index ? &pose.cameras[*index] : nullptr;
}

// Widens the field of view if the camera's frame is wider than the image: the image then shows the full
// width, and more above and below.
void fitFrame(View& view) {
    constexpr double same = 1 + 1e-6;  // tolerance: files store the ratio in float32
    Camera& camera = view.camera;
    const double aspect = static_cast<double>(view.width) / view.height;
    const double framed = camera.orthographic ? camera.xmag / camera.ymag : camera.aspect;
    if (framed > aspect * same) {
        if (camera.orthographic)
            camera.ymag *= framed / aspect;
        else
            camera.yfov = 2 * std::atan(tanHalfFov(camera) * framed / aspect);
        view.wider_frame = framed;
    }
    camera.aspect = camera.xmag = 0;
}

}  // namespace

View makeView(const Scene& scene, const Pose& pose, const std::string& choice, int width, int height,
              const DefaultViewOf& kept) {
    if (width < 1 || height < 1) fail(fmt::format("--size {}x{}: must be at least 1x1", width, height));

    View view;
    const Camera* own =
        choice.empty() ? (pose.cameras.empty() ? nullptr : &pose.cameras.front()) : sceneCamera(pose, choice);
    if (own) {
        view.camera = *own;
    } else if (choice.empty() || choice.find('=') != choice.npos) {
        const double aspect = static_cast<double>(width) / height;
        const Bounds bounds = boundsAtStart(scene, pose);
        std::optional<DefaultView> own_default;
        const DefaultViewOf defaultView = kept ? kept : DefaultViewOf([&]() -> const DefaultView& {
            return own_default.emplace(chooseDefaultView(scene, pose.animation));
        });
        if (choice.empty()) {
            const DefaultView& chosen = defaultView();
            view.camera = freeCamera(bounds);
            view.camera.world_from_camera = worldFromCamera(chosen, bounds, aspect);
            view.target_distance = targetDistance(chosen, bounds, aspect);
        } else {
            view = explicitView(defaultView, bounds, aspect, choice);
        }
    } else {
        std::vector<std::string> names;
        if (!isIndex(choice))
            for (const auto& of : namesOf(pose.cameras)) names.insert(names.end(), of.begin(), of.end());
        failCamera(choice, fmt::format("{}{}; it takes {}", listOf(pose.cameras), didYouMean(choice, names),
                                       accepted));
    }
    view.width = width;
    view.height = height;
    fitFrame(view);
    return view;
}

}  // namespace diptych
