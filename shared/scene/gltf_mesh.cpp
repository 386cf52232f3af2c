// SPDX-License-Identifier: MIT
#include "shared/scene/gltf_mesh.h"

#include "shared/scene/gltf_accessor.h"
#include "shared/scene/gltf_value.h"
#include "shared/scene/tangents.h"

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace diptych::gltf {

namespace {

[[noreturn]] void fail(const std::string& who, const std::string& why) {
    throw std::runtime_error(who + ": " + why);
}

template <class Vec>
bool isFinite(const Vec& v) {
    for (int c = 0; c < Vec::length(); ++c)
        if (!std::isfinite(v[c])) return false;
    return true;
}

// One primitive of the file on its way to being a Primitive.
class PrimitiveReader {
public:
    PrimitiveReader(const tinygltf::Model& model, const tinygltf::Primitive& file, std::string who)
        : model_(model), file_(file), who_(std::move(who)) {}

    std::vector<std::string> notes;

    // Without indices where nothing is to be drawn.
    Primitive read(const std::vector<Material>& materials) {
        if (file_.mode < TINYGLTF_MODE_TRIANGLES || file_.mode > TINYGLTF_MODE_TRIANGLE_FAN) {
            if (file_.mode < 0 || file_.mode > TINYGLTF_MODE_TRIANGLE_FAN)
                fail(who_, fmt::format("{} is no mode", file_.mode));
            notes.push_back(who_ + ": points or lines, left out");
            return {};
        }
        if (!file_.attributes.contains("POSITION")) {
            notes.push_back(who_ + ": has no POSITION, left out");
            return {};
        }
        result_.material = checkedIndex(file_.material, model_.materials.size(), who_, "material");
        if (result_.material < 0) result_.material = static_cast<int>(materials.size()) - 1;
        readAttributes();
        readTriangles();
        if (result_.indices.empty()) {
            notes.push_back(who_ + ": has no triangle, left out");
            return {};
        }
        finishNormals();
        finishTangents(materials[static_cast<std::size_t>(result_.material)]);
        return std::move(result_);
    }

private:
    const tinygltf::Model& model_;
    const tinygltf::Primitive& file_;
    std::string who_;
    Primitive result_;

    // An attribute that is there has one finite element per position.
    template <class Vec, class Read>
    std::vector<Vec> attribute(const char* name, const Read& read) const {
        const auto at = file_.attributes.find(name);
        if (at == file_.attributes.end()) return {};
        const std::string who = fmt::format("{}: {}", who_, name);
        std::vector<Vec> values = read(model_, at->second, who);
        const std::size_t expected = result_.positions.empty() ? values.size() : result_.positions.size();
        if (values.size() != expected)
            fail(who, fmt::format("{} elements for {} positions", values.size(), expected));
        for (std::size_t i = 0; i < values.size(); ++i)
            if (!isFinite(values[i])) fail(who, fmt::format("vertex {} is not finite", i));
        return values;
    }

    void readAttributes() {
        result_.positions = attribute<glm::vec3>("POSITION", readVectors<glm::vec3>);
        if (result_.positions.size() > std::numeric_limits<std::uint32_t>::max() / 4)
            fail(who_, "has more vertices than 32 bits can index");
        if (result_.positions.empty()) return;
        result_.normals = attribute<glm::vec3>("NORMAL", readVectors<glm::vec3>);
        result_.tangents = attribute<glm::vec4>("TANGENT", readVectors<glm::vec4>);
        result_.texcoords[0] = attribute<glm::vec2>("TEXCOORD_0", readVectors<glm::vec2>);
        result_.texcoords[1] = attribute<glm::vec2>("TEXCOORD_1", readVectors<glm::vec2>);
        result_.colors = attribute<glm::vec4>("COLOR_0", readColors);
        for (glm::vec4& color : result_.colors) color = glm::clamp(color, 0.0f, 1.0f);
    }

    // The vertices in the order in which the file draws them, as a list of triangles.
    void readTriangles() {
        std::vector<std::uint32_t> order;
        if (file_.indices == -1) {
            order.resize(result_.positions.size());
            for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
        } else {
            order = readIndices(model_, file_.indices, who_ + ": indices");
        }
        for (std::size_t i = 0; i < order.size(); ++i)
            if (order[i] >= result_.positions.size())
                fail(who_, fmt::format("index {} of its indices is {}, past its {} vertices", i, order[i],
                                       result_.positions.size()));

        std::vector<std::uint32_t>& out = result_.indices;
        if (file_.mode == TINYGLTF_MODE_TRIANGLES) {
            if (order.size() % 3)
                notes.push_back(
                    fmt::format("{}: the last {} indices make no triangle", who_, order.size() % 3));
            order.resize(order.size() - order.size() % 3);
            out = std::move(order);
            return;
        }
        for (std::size_t i = 0; i + 2 < order.size(); ++i) {
            if (file_.mode == TINYGLTF_MODE_TRIANGLE_FAN)
                out.insert(out.end(), {order[i + 1], order[i + 2], order[0]});
            else  // a strip: every other triangle is turned back to front
                out.insert(out.end(), {order[i], order[i + 1 + i % 2], order[i + 2 - i % 2]});
        }
    }

    // Missing normals are flat, and then the file's tangents must not be used. Present ones are made unit;
    // one without a direction gets that of the triangles around it.
    void finishNormals() {
        if (result_.normals.empty()) {
            result_.tangents.clear();
            makeFlatNormals(result_);
            return;
        }
        std::vector<std::uint32_t> broken;
        for (std::uint32_t v = 0; v < result_.normals.size(); ++v) {
            const glm::dvec3 n(result_.normals[v]);
            const double length = glm::length(n);
            if (length > 0)
                result_.normals[v] = glm::vec3(n / length);
            else
                broken.push_back(v);
        }
        if (!broken.empty()) repairNormals(broken);
    }

    void repairNormals(const std::vector<std::uint32_t>& broken) {
        std::vector<glm::dvec3> sum(result_.positions.size(), glm::dvec3(0));  // weighted by area
        for (std::size_t i = 0; i + 2 < result_.indices.size(); i += 3) {
            const std::uint32_t* t = &result_.indices[i];
            const glm::dvec3 a(result_.positions[t[0]]), b(result_.positions[t[1]]),
                c(result_.positions[t[2]]);
            for (int corner = 0; corner < 3; ++corner) sum[t[corner]] += glm::cross(b - a, c - a);
        }
        for (const std::uint32_t v : broken) {
            const double length = glm::length(sum[v]);
            result_.normals[v] = length > 0 ? glm::vec3(sum[v] / length) : glm::vec3(0, 0, 1);
        }
        notes.push_back(
            fmt::format("{}: {} normals have no direction: taken from the triangles", who_, broken.size()));
    }

    // A normal texture asks for MikkTSpace's tangents where the file has none; nothing else reads them.
    void finishTangents(const Material& material) {
        if (result_.tangents.empty()) {
            const TextureSlot& slot = material.normal_texture;
            return makeTangents(result_, slot.texture >= 0 ? slot.texcoord : -1);
        }
        std::vector<glm::vec4> read = std::move(result_.tangents);
        makeTangents(result_, -1);  // what stays where the file's has no direction
        for (std::size_t v = 0; v < read.size(); ++v) {
            const glm::dvec3 t(read[v]);
            const double length = glm::length(t);
            if (length > 0) result_.tangents[v] = glm::vec4(glm::vec3(t / length), read[v].w < 0 ? -1 : 1);
        }
    }
};

void noteMorphs(const tinygltf::Model& model, std::vector<std::string>& notes) {
    for (std::size_t m = 0; m < model.meshes.size(); ++m)
        for (const tinygltf::Primitive& p : model.meshes[m].primitives)
            if (!p.targets.empty()) {
                notes.push_back(
                    fmt::format("mesh {}: its morph targets are left out, morphing is not built yet", m));
                break;
            }
}

}  // namespace

std::vector<Mesh> readMeshes(const tinygltf::Model& model, const std::vector<Material>& materials,
                             std::vector<std::string>& notes) {
    struct Task {
        std::size_t mesh, primitive;
        Primitive result;
        std::vector<std::string> notes;
    };
    std::vector<Task> tasks;
    for (std::size_t m = 0; m < model.meshes.size(); ++m)
        for (std::size_t p = 0; p < model.meshes[m].primitives.size(); ++p) tasks.push_back({m, p, {}, {}});
    forEachInParallel(tasks.size(), [&](std::size_t i) {
        Task& task = tasks[i];
        PrimitiveReader reader(model, model.meshes[task.mesh].primitives[task.primitive],
                               fmt::format("mesh {}, primitive {}", task.mesh, task.primitive));
        task.result = reader.read(materials);
        task.notes = std::move(reader.notes);
    });

    std::vector<Mesh> meshes(model.meshes.size());
    for (std::size_t m = 0; m < meshes.size(); ++m) meshes[m].name = model.meshes[m].name;
    for (Task& task : tasks) {
        notes.insert(notes.end(), task.notes.begin(), task.notes.end());
        if (!task.result.indices.empty()) meshes[task.mesh].primitives.push_back(std::move(task.result));
    }
    noteMorphs(model, notes);
    return meshes;
}

}  // namespace diptych::gltf
