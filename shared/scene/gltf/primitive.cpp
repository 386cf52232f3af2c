// SPDX-License-Identifier: MIT
#include "shared/scene/gltf/primitive.h"

#include "shared/scene/gltf/accessor.h"
#include "shared/scene/gltf/attributes.h"
#include "shared/scene/gltf/value.h"
#include "shared/scene/model/material_slots.h"
#include "shared/scene/model/tangents.h"
#include "shared/text/counted.h"
#include "shared/text/fail.h"

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace diptych::gltf {

namespace {

bool drawsTriangles(int mode) {
    return mode >= TINYGLTF_MODE_TRIANGLES && mode <= TINYGLTF_MODE_TRIANGLE_FAN;
}

// Components that readVectors() requires of an attribute; 0: checked there.
std::size_t widthOf(const std::string& attribute) {
    return attribute == "POSITION" || attribute == "NORMAL" ? 3
           : attribute == "TANGENT"                         ? 4
           : attribute.starts_with("TEXCOORD_")             ? 2
                                                            : 0;
}

class PrimitiveReader : AttributeReader {
public:
    PrimitiveReader(const AttributeReader& all, const PrimitiveUse& use) : AttributeReader(all), use_(use) {}

    Primitive result() {
        if (!drawsTriangles(file.mode)) return skipped("points or lines");
        if (!file.attributes.contains("POSITION")) return skipped("has no POSITION");
        result_.material = file.material;
        if (result_.material < 0) result_.material = static_cast<int>(use_.materials.size()) - 1;
        countVertices();
        readTriangles();
        if (result_.indices.empty()) return skipped("has no triangles");
        keepTouched();
        readPositions();
        readAttributes();
        if (use_.joints > 0) readJointSets(*this, use_.joints, touched_, result_);
        readTargets(*this, use_.targets, result_);
        finishNormals();
        finishTangents();
        return std::move(result_);
    }

private:
    const PrimitiveUse& use_;
    Primitive result_;
    std::size_t count_ = 0;               // vertices in the file
    std::vector<std::uint32_t> touched_;  // vertices that triangles use, ascending

    Primitive skipped(const char* why) {
        note("{}, left out", why);
        return {};
    }

    // ---- triangles -----------------------------------------------------------------------------------

    // Checks that all attributes have as many elements as POSITION.
    void countVertices() {
        count_ = soundCount(model, file.attributes.at("POSITION"), who + ": POSITION", "vertices", 3);
        if (count_ > std::numeric_limits<std::uint32_t>::max() / 4)
            fail(who, "has more vertices than 32 bits can index");
        const auto check = [&](const std::string& name, int accessor, std::size_t width) {
            const std::string asks = fmt::format("{}: {}", who, name);
            const std::size_t count = soundCount(model, accessor, asks, "vertices", width);
            if (count != count_) fail(asks, fmt::format("has {} elements for {} positions", count, count_));
        };
        for (const auto& [name, accessor] : file.attributes)
            if (!name.starts_with('_')) check(name, accessor, widthOf(name));
        for (std::size_t t = 0; t < file.targets.size(); ++t)
            for (const auto& [name, accessor] : file.targets[t])
                if (!name.starts_with('_')) check(fmt::format("target {}: {}", t, name), accessor, 0);
    }

    // Converts the indices to a triangle list in draw order.
    void readTriangles() {
        std::vector<std::uint32_t> order;
        if (file.indices == -1) {
            order.resize(count_);
            std::iota(order.begin(), order.end(), 0u);
        } else {
            order = readIndices(model, file.indices, who + ": indices");
        }
        for (std::size_t i = 0; i < order.size(); ++i)
            if (order[i] >= count_)
                fail(who,
                     fmt::format("index {} of its indices is {}, past its {} vertices", i, order[i], count_));

        std::vector<std::uint32_t>& out = result_.indices;
        if (file.mode == TINYGLTF_MODE_TRIANGLES) {
            if (order.size() % 3)
                note("the last {} cannot form a triangle", counted(order.size() % 3, "index", "indices"));
            order.resize(order.size() - order.size() % 3);
            out = std::move(order);
            return;
        }
        if (order.size() >= 3) out.reserve(3 * (order.size() - 2));
        for (std::size_t i = 0; i + 2 < order.size(); ++i) {
            if (file.mode == TINYGLTF_MODE_TRIANGLE_FAN)
                out.insert(out.end(), {order[i + 1], order[i + 2], order[0]});
            else  // strips: every other triangle is reversed
                out.insert(out.end(), {order[i], order[i + 1 + i % 2], order[i + 2 - i % 2]});
        }
    }

    // Keeps only vertices that triangles use. The cost grows with the indices, not with the vertices: a
    // thousand primitives may each draw a small part of one large accessor.
    void keepTouched() {
        std::vector<std::uint32_t>& indices = result_.indices;
        if (count_ / 4 > indices.size()) {
            touched_ = indices;
            std::sort(touched_.begin(), touched_.end());
            touched_.erase(std::unique(touched_.begin(), touched_.end()), touched_.end());
            for (std::uint32_t& i : indices)
                i = static_cast<std::uint32_t>(std::lower_bound(touched_.begin(), touched_.end(), i) -
                                               touched_.begin());
            which = touched_;
            return;
        }
        constexpr std::uint32_t untouched = ~0u;
        std::vector<std::uint32_t> new_index(count_, untouched);
        for (const std::uint32_t i : indices) new_index[i] = 0;
        touched_.clear();
        for (std::uint32_t v = 0; v < count_; ++v)
            if (new_index[v] != untouched) {
                new_index[v] = static_cast<std::uint32_t>(touched_.size());
                touched_.push_back(v);
            }
        which = touched_.size() == count_ ? Selection() : Selection(touched_);
        for (std::uint32_t& i : indices) i = new_index[i];
    }

    void readPositions() {
        std::vector<glm::vec3>& positions = result_.positions;
        positions = read<glm::vec3>("POSITION", readVectors<glm::vec3>);
        if (std::all_of(positions.begin(), positions.end(), isUsable<glm::vec3>)) return;
        std::vector<std::uint32_t> sound;
        for (std::size_t i = 0; i + 2 < result_.indices.size(); i += 3) {
            const std::uint32_t* t = &result_.indices[i];
            if (isUsable(positions[t[0]]) && isUsable(positions[t[1]]) && isUsable(positions[t[2]]))
                sound.insert(sound.end(), {touched_[t[0]], touched_[t[1]], touched_[t[2]]});
        }
        note("{} of {} triangles with a vertex that is not finite or beyond {:g} m: left out",
             (result_.indices.size() - sound.size()) / 3, result_.indices.size() / 3, maxCoordinate);
        result_.indices = std::move(sound);
        if (result_.indices.empty())
            fail(who, fmt::format("every triangle has a vertex that is not finite or beyond {:g} m",
                                  maxCoordinate));
        keepTouched();
        positions = read<glm::vec3>("POSITION", readVectors<glm::vec3>);
    }

    // ---- attributes ----------------------------------------------------------------------------------

    void readAttributes() {
        result_.normals = read<glm::vec3>("NORMAL", readVectors<glm::vec3>);
        result_.tangents = read<glm::vec4>("TANGENT", readVectors<glm::vec4>);
        result_.colors = read<glm::vec4>("COLOR_0", readColors);
        for (std::size_t set = 0; set < 2; ++set) {
            const std::string name = fmt::format("TEXCOORD_{}", set);
            result_.texcoords[set] = read<glm::vec2>(name, readVectors<glm::vec2>);
            repair(result_.texcoords[set], glm::vec2(0), name, "0, 0");
            if (result_.texcoords[set].empty() && materialReads(set))
                note("its material reads {}, which it lacks: 0, 0 is used", name);
        }
        repair(result_.colors, glm::vec4(1), "COLOR_0", "white");
        for (glm::vec4& color : result_.colors) color = glm::clamp(color, 0.0f, 1.0f);
    }

    bool materialReads(std::size_t set) const {
        const Material& material = use_.materials[static_cast<std::size_t>(result_.material)];
        for (std::size_t slot = 0; slot < materialSlots.size(); ++slot)
            if (readsSlot(material, slot) &&
                (material.*materialSlots[slot].texture).texcoord == static_cast<int>(set))
                return true;
        return false;
    }

    // ---- what is missing -----------------------------------------------------------------------------

    // Missing normals become flat, and the file's tangents are then ignored. Existing normals are
    // normalized; one without a direction is replaced by the mean of the adjacent triangles' normals.
    void finishNormals() {
        if (result_.normals.empty()) {
            result_.tangents.clear();
            for (MorphTarget& target : result_.targets) target.tangents.clear();
            makeFlatNormals(result_);
            result_.flat = true;
            return;
        }
        std::vector<std::uint32_t> broken;
        for (std::uint32_t v = 0; v < result_.normals.size(); ++v) {
            const glm::dvec3 n(result_.normals[v]);
            const double length = glm::length(n);
            if (length > 0 && std::isfinite(length))
                result_.normals[v] = glm::vec3(n / length);
            else
                broken.push_back(v);
        }
        if (!broken.empty()) repairNormals(broken);
    }

    void repairNormals(const std::vector<std::uint32_t>& broken) {
        // Sums of face normals, weighted by area.
        std::vector<glm::dvec3> sum(result_.positions.size(), glm::dvec3(0));
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
        note("{} no direction: triangle normals are used",
             broken.size() == 1 ? "1 normal has" : counted(broken.size(), "normal") + " have");
    }

    // Without tangents in the file, normal maps and anisotropy need MikkTSpace's. Nothing else reads them.
    void finishTangents() {
        if (result_.tangents.empty()) {
            result_.tangents_made = true;
            const auto material = static_cast<std::size_t>(result_.material);
            const bool anisotropic = use_.anisotropic[material];
            if (!anisotropic && tangentSlot(use_.materials[material]) == gpu::SLOT_COUNT)
                return makeAnyTangents(result_);
            const TextureSlot map = tangentMap(use_.materials[material]);
            const RotatedMaps rotated = rotatedMaps(use_.materials[material], anisotropic);
            if (anisotropic &&
                result_.texcoords[(rotated.layers & gpu::LAYER_ANISOTROPY ? rotated.map : map).texcoord]
                    .empty())
                note("direction of anisotropy is arbitrary: no tangents, no texture coordinates");
            if (rotated.third)
                note("anisotropy takes the tangents of the normal map: only the clear coat's map has others");
            if (rotated.layers != 0 && (use_.maps_that_turn[material] || use_.layer_maps_that_turn[material]))
                note(
                    "animations turn texture coordinates: the clear coat's and anisotropy's tangents keep "
                    "their angle to the normal map's");
            return makeTangents(result_, map, use_.maps_that_turn[material],
                                rotated.layers != 0 ? &rotated.map : nullptr);
        }
        const std::vector<glm::vec4> own = std::move(result_.tangents);
        makeAnyTangents(result_);  // fallback for the file's tangents without a direction
        std::size_t broken = 0;
        for (std::size_t v = 0; v < own.size(); ++v) {
            const glm::dvec3 t(own[v]);
            const double length = glm::length(t);
            if (length > 0 && std::isfinite(length))
                result_.tangents[v] = glm::vec4(glm::vec3(t / length), own[v].w < 0 ? -1 : 1);
            else
                ++broken;
        }
        if (broken)
            note("{} no direction: any perpendicular to the normal is used",
                 broken == 1 ? "1 tangent has" : counted(broken, "tangent") + " have");
    }
};

}  // namespace

Primitive readPrimitive(const Model& model, const tinygltf::Primitive& file, const std::string& who,
                        const PrimitiveUse& use, std::vector<std::string>& notes) {
    return PrimitiveReader({model, file, who, {}, notes}, use).result();
}

std::size_t decodedBytes(const Model& model, const tinygltf::Primitive& file, const std::string& who) {
    std::size_t bytes = sizeof(Primitive);
    const auto position = file.attributes.find("POSITION");
    if (!drawsTriangles(file.mode) || position == file.attributes.end()) return bytes;
    const std::size_t count = soundCount(model, position->second, who + ": POSITION", "vertices", 3);
    const std::size_t order =
        file.indices == -1 ? count : soundCount(model, file.indices, who + ": indices", "indices", 1);
    const std::size_t corners =
        file.mode == TINYGLTF_MODE_TRIANGLES ? order : 3 * std::max<std::size_t>(order, 2) - 6;
    // With flat normals or generated tangents, every corner may become a vertex.
    const bool split = !file.attributes.contains("NORMAL") || !file.attributes.contains("TANGENT");
    const std::size_t vertices = split ? corners : std::min(count, order);
    std::size_t perVertex = sizeof(glm::vec3) + sizeof(glm::vec4);  // normals and tangents
    const auto add = [&](const auto& attributes) {
        for (const auto& [name, accessor] : attributes) {
            if (name.starts_with('_')) continue;
            if (name != "NORMAL" && name != "TANGENT") perVertex += sizeof(glm::vec4);  // upper bound
            const auto& sparse = model.accessors[static_cast<std::size_t>(accessor)].sparse;
            if (sparse.isSparse) bytes += sizeof(glm::vec4) * static_cast<std::size_t>(sparse.count);
        }
    };
    add(file.attributes);
    // DeformationBounds: at worst every vertex is a cluster.
    if (!file.targets.empty() || file.attributes.contains("JOINTS_0"))
        perVertex += sizeof(DeformationBounds::Cluster);
    for (const auto& [name, accessor] : file.attributes)
        if (name.starts_with("JOINTS_")) perVertex += 4 * sizeof(DeformationBounds::Influence);
    for (const auto& target : file.targets) {
        perVertex += sizeof(VertexBox);
        bytes += sizeof(MorphTarget);
        perVertex += 2 * sizeof(glm::vec3);  // normals and tangents
        add(target);
    }
    if (split && !file.targets.empty()) {  // TangentGroups
        bytes += (corners + 1) * sizeof(std::uint32_t);
        perVertex += 2 * sizeof(std::uint32_t);
    }
    return bytes + corners * sizeof(std::uint32_t) + vertices * perVertex;
}

}  // namespace diptych::gltf
