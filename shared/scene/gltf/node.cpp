// SPDX-License-Identifier: MIT
#include "shared/scene/gltf/node.h"

#include "shared/scene/gltf/extras.h"
#include "shared/scene/gltf/model.h"
#include "shared/scene/gltf/value.h"
#include "shared/scene/motion/animation.h"
#include "shared/text/fail.h"
#include "shared/text/indexed_names.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace diptych::gltf {

using Json = nlohmann::json;

namespace {

std::string nodeName(std::size_t node) {
    return fmt::format("node {}", node);
}

// ---- transforms --------------------------------------------------------------------------------------

glm::dquat rotationOf(const tinygltf::Node& node) {
    const std::vector<double>& r = node.rotation;
    return {r[3], r[0], r[1], r[2]};
}

glm::dmat4 transformOf(const tinygltf::Node& node, const std::string& who, NoteList& notes) {
    if (!node.matrix.empty()) {
        glm::dmat4 m(1.0);
        for (int i = 0; i < 16; ++i) m[i / 4][i % 4] = node.matrix[static_cast<std::size_t>(i)];
        // Tolerance of a matrix's last row: exporters multiply matrices in float32.
        constexpr double rounding = 1e-4;
        const glm::dvec4 row(m[0][3], m[1][3], m[2][3], m[3][3] - 1);
        if (!(glm::length(row) <= rounding)) fail(who, "the last row of its matrix is not 0 0 0 1");
        m[0][3] = m[1][3] = m[2][3] = 0;
        m[3][3] = 1;
        return m;
    }
    if (!node.rotation.empty() && !(glm::length(rotationOf(node)) > 0))
        notes.add(who + ": rotation 0 0 0 0: no rotation is used");
    return matrixOf(partsOf(node));
}

// ---- hierarchy ---------------------------------------------------------------------------------------

std::vector<int> parentsOf(const Model& model) {
    std::vector<int> parent(model.nodes.size(), -1);
    for (std::size_t n = 0; n < model.nodes.size(); ++n)
        for (const int child : model.nodes[n].children) {
            int& p = parent[static_cast<std::size_t>(child)];
            if (p >= 0)
                fail(nodeName(static_cast<std::size_t>(child)),
                     fmt::format("is a child of node {} and of node {}", p, n));
            p = static_cast<int>(n);
        }
    return parent;
}

// Throws if the parents form a cycle: if a walk to the root meets a node that it has visited. It ends at one
// that an earlier walk visited.
void refuseCircles(const std::vector<int>& parent) {
    constexpr std::size_t none = static_cast<std::size_t>(-1);
    std::vector<std::size_t> walk(parent.size(), none);  // the first that visited the node
    for (std::size_t start = 0, n; start < parent.size(); ++start) {
        for (n = start; n < parent.size() && walk[n] == none; n = static_cast<std::size_t>(parent[n]))
            walk[n] = start;
        if (n < parent.size() && walk[n] == start) fail(nodeName(n), "is its own ancestor");
    }
}

// Whether each node is in the scene; all are if the file has no scenes.
std::vector<bool> reached(const Model& model, int index, const std::vector<int>& parent) {
    if (index < 0) return std::vector<bool>(model.nodes.size(), true);
    const std::string who = fmt::format("scene {}", index);
    std::vector<bool> result(model.nodes.size(), false);
    std::vector<int> waiting = model.scenes[static_cast<std::size_t>(index)].nodes;
    for (const int root : waiting) {
        if (parent[static_cast<std::size_t>(root)] >= 0)
            fail(who, fmt::format("node {} is not a root: it is a child of node {}", root,
                                  parent[static_cast<std::size_t>(root)]));
    }
    while (!waiting.empty()) {
        const auto n = static_cast<std::size_t>(waiting.back());
        waiting.pop_back();
        if (result[n]) continue;
        result[n] = true;
        waiting.insert(waiting.end(), model.nodes[n].children.begin(), model.nodes[n].children.end());
    }
    return result;
}

// ---- what hangs on nodes -----------------------------------------------------------------------------

// Clamps `x`, with a note if that changes it.
double bounded(const std::string& who, const char* what, double x, double min, double max, NoteList& notes) {
    const double inside = std::clamp(x, min, max);
    if (inside != x) notes.add(fmt::format("{}: {} {}: {:g} is used", who, what, x, inside));
    return inside;
}

void readCone(const Json& spot, const std::string& who, Light& light, NoteList& notes) {
    static constexpr double right = glm::half_pi<double>();
    // Accepts a pi / 2 that was rounded up.
    const auto rounded = [](double x) { return x <= right + 1e-6 ? std::min(x, right) : x; };
    const double outer =
        bounded(who, "outerConeAngle", rounded(spot.value("outerConeAngle", glm::quarter_pi<double>())), 0,
                right, notes);
    light.outer_cone = static_cast<float>(outer);
    light.inner_cone = static_cast<float>(
        bounded(who, "innerConeAngle", rounded(spot.value("innerConeAngle", 0.0)), 0, outer, notes));
}

Light readLight(const Json& file, const std::string& who, NoteList& notes) {
    Light light;
    light.name = file.value("name", std::string());
    const std::string type = file["type"];
    light.kind = type == "directional" ? LightKind::directional
                 : type == "spot"      ? LightKind::spot
                                       : LightKind::point;
    constexpr double max = std::numeric_limits<float>::max();
    if (const Json* color = memberOf(file, "color"))
        for (int c = 0; c < 3; ++c)
            light.color[c] = static_cast<float>(
                bounded(who, "color", (*color)[static_cast<std::size_t>(c)], 0, max, notes));
    light.intensity =
        static_cast<float>(bounded(who, "intensity", file.value("intensity", 1.0), 0, max, notes));
    const double range = file.value("range", 0.0);  // 0: unlimited
    if (range < 0) notes.add(fmt::format("{}: range {}: ignored", who, range));
    if (range > 0 && light.kind != LightKind::directional) light.range = static_cast<float>(range);
    if (light.kind == LightKind::spot) readCone(file["spot"], who, light, notes);
    return light;
}

// Throws if the camera's parameters give no valid projection.
Camera readCamera(const tinygltf::Camera& c, const std::string& who, NoteList& notes) {
    Camera camera;
    camera.name = c.name;
    if (c.type == "perspective") {
        camera.yfov = c.perspective.yfov;
        camera.near = c.perspective.znear;
        if (c.perspective.zfar != 0) camera.far = c.perspective.zfar;
        if (c.perspective.aspectRatio < 0)
            notes.add(fmt::format("{}: aspectRatio {}: ignored", who, c.perspective.aspectRatio));
        else
            camera.aspect = c.perspective.aspectRatio;
        if (!(camera.yfov > 0 && camera.yfov < glm::pi<double>()))
            fail(who, fmt::format("yfov {} is not between 0 and pi", camera.yfov));
        if (!(camera.near > 0)) fail(who, fmt::format("znear {} is not above 0", camera.near));
        if (!(camera.far > camera.near)) {
            notes.add(fmt::format("{}: zfar {} is not beyond znear {}: no far plane is used", who, camera.far,
                                  camera.near));
            camera.far = std::numeric_limits<double>::infinity();
        }
    } else {
        camera.orthographic = true;
        camera.ymag = std::abs(c.orthographic.ymag);
        camera.xmag = std::abs(c.orthographic.xmag);
        camera.near = c.orthographic.znear;
        camera.far = c.orthographic.zfar;
        if (!(camera.ymag > 0)) fail(who, "ymag is 0");
        if (!(camera.near >= 0)) fail(who, fmt::format("znear {} is negative", camera.near));
        if (!(camera.far > camera.near))
            fail(who, fmt::format("zfar {} is not beyond znear {}", camera.far, camera.near));
        for (const auto& [what, mag] :
             {std::pair{"xmag", c.orthographic.xmag}, std::pair{"ymag", c.orthographic.ymag}})
            if (mag < 0) notes.add(fmt::format("{}: {} {}: {} is used", who, what, mag, -mag));
    }
    return camera;
}

}  // namespace

Transform partsOf(const tinygltf::Node& node) {
    Transform parts;
    for (int c = 0; c < 3; ++c) {
        const auto i = static_cast<std::size_t>(c);
        if (!node.translation.empty()) parts.translation[c] = node.translation[i];
        if (!node.scale.empty()) parts.scale[c] = node.scale[i];
    }
    if (!node.rotation.empty() && glm::length(rotationOf(node)) > 0)
        parts.rotation = glm::normalize(rotationOf(node));
    return parts;
}

int chooseScene(const Model& model, const std::string& choice, std::vector<std::string>& notes) {
    const int count = static_cast<int>(model.scenes.size());
    if (choice.empty()) {
        const int index = count == 0 ? -1 : std::max(model.defaultScene, 0);
        if (count > 1) {
            const std::string& name = model.scenes[static_cast<std::size_t>(index)].name;
            notes.push_back(
                fmt::format("{} scenes: scene {}{} is drawn; FILE?scene=INDEX or NAME draws another", count,
                            index, name.empty() ? "" : fmt::format(" \"{}\"", name)));
        }
        return index;
    }
    std::vector<std::string> names;
    for (const tinygltf::Scene& scene : model.scenes) names.push_back(scene.name);
    const std::string who = "scene=" + choice;
    if (const auto index = indexOfNamed(choice, names, who)) return static_cast<int>(*index);
    fail(who, names.empty() ? "the file has no scene" : "the file's scenes are " + indexedNames(names));
}

std::vector<int> readNodes(const Model& model, int chosen, Scene& scene) {
    const Json &nodes = arrayAt(model.rest, "/nodes"),
               &lights = arrayAt(model.rest, "/extensions/KHR_lights_punctual/lights");
    const std::vector<int> parent = parentsOf(model);
    refuseCircles(parent);
    const std::vector<bool> inScene = reached(model, chosen, parent);

    std::vector<int> node_index(model.nodes.size(), -1);  // the file's node -> index in Scene::nodes
    int count = 0;
    for (std::size_t n = 0; n < node_index.size(); ++n)
        if (inScene[n]) node_index[n] = count++;

    NoteList nodeNotes("nodes"), notes("lights and cameras");
    std::vector<std::pair<int, Camera>> cameras;  // (the file's node index, camera)
    for (std::size_t n = 0; n < model.nodes.size(); ++n) {
        if (!inScene[n]) continue;
        const tinygltf::Node& file = model.nodes[n];
        Node node;
        node.name = file.name;
        node.parent = parent[n] < 0 ? -1 : node_index[static_cast<std::size_t>(parent[n])];
        node.parent_from_node = transformOf(file, nodeName(n), nodeNotes);
        node.mesh = file.mesh;
        if (file.camera >= 0)
            readOrNote(notes, [&] {
                Camera camera = readCamera(model.cameras[static_cast<std::size_t>(file.camera)],
                                           fmt::format("camera {}", file.camera), notes);
                camera.node_name = file.name;
                if (camera.name.empty()) camera.name = file.name;
                camera.node = node_index[n];
                camera.source = file.camera;
                cameras.emplace_back(file.camera, camera);
            });
        const Json* e = extension(elementOf(nodes, n), "KHR_lights_punctual");
        if (const int index = e ? e->value("light", -1) : -1; index >= 0) {
            const Json& own = lights[static_cast<std::size_t>(index)];
            Light light = readLight(own, fmt::format("light {}", index), notes);
            addExtras(own, index, light, notes);
            if (light.name.empty()) light.name = file.name;
            light.node = node_index[n];
            light.source = index;
            scene.lights.push_back(light);
        }
        scene.nodes.push_back(std::move(node));
    }
    if (chosen >= 0)
        attachLights(elementOf(arrayAt(model.rest, "/scenes"), static_cast<std::size_t>(chosen)), chosen,
                     node_index, scene, notes);
    nodeNotes.moveTo(scene.notes);
    notes.moveTo(scene.notes);
    std::stable_sort(cameras.begin(), cameras.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    for (const auto& [index, camera] : cameras) scene.cameras.push_back(camera);
    return node_index;
}

}  // namespace diptych::gltf
