// SPDX-License-Identifier: MIT
#include "shared/scene/gltf/draco.h"

#include "shared/scene/gltf/accessor.h"
#include "shared/scene/gltf/draco_stream.h"
#include "shared/scene/gltf/model.h"
#include "shared/scene/gltf/value.h"
#include "shared/text/fail.h"
#include "shared/text/one_line.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <iterator>
#include <new>

namespace diptych::gltf {

namespace {

using Bytes = std::vector<unsigned char>;
using Json = nlohmann::json;

constexpr const char* dracoName = "KHR_draco_mesh_compression";

std::string primitiveName(std::size_t mesh, std::size_t primitive) {
    return fmt::format("mesh {}, primitive {}: {}", mesh, primitive, dracoName);
}

const tinygltf::Accessor& accessorAt(const Model& model, int index) {
    return model.accessors[static_cast<std::size_t>(index)];
}

std::size_t componentsOf(const tinygltf::Accessor& a) {
    return static_cast<std::size_t>(tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(a.type)));
}

std::size_t elementBytes(const tinygltf::Accessor& a) {
    const int component = tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(a.componentType));
    return static_cast<std::size_t>(component) * componentsOf(a);
}

// ---- the extension's rules ---------------------------------------------------------------------------

DracoPrimitive readExtension(const Model& model, const Json& e, std::size_t mesh, std::size_t index) {
    const tinygltf::Primitive& primitive = model.meshes[mesh].primitives[index];
    const std::string who = primitiveName(mesh, index);
    if (primitive.mode != TINYGLTF_MODE_TRIANGLES && primitive.mode != TINYGLTF_MODE_TRIANGLE_STRIP)
        fail(who, fmt::format("mode {} is not triangles or a triangle strip", primitive.mode));
    DracoPrimitive result{mesh, index, e["bufferView"].get<int>(), {}, 0};
    for (const auto& [name, id] : e["attributes"].items()) {
        const auto at = primitive.attributes.find(name);
        if (at == primitive.attributes.end())
            fail(who, fmt::format("{}: the primitive has no such attribute", oneLine(name)));
        const tinygltf::Accessor& a = accessorAt(model, at->second);
        result.attributes.push_back({name, id.get<std::uint32_t>(), at->second});
        if (result.attributes.size() == 1) result.vertices = a.count;
        if (a.count != result.vertices)
            fail(who, fmt::format("{}: {} vertices, but {} has {}", name, a.count, result.attributes[0].name,
                                  result.vertices));
    }
    return result;
}

// ---- decoding ----------------------------------------------------------------------------------------

struct Result {
    std::vector<Bytes> attributes;  // tightly packed
    std::vector<std::uint32_t> indices;
};

// Converts the components of one value from the stream's type to the accessor's.
template <class T>
bool convert(const draco::PointAttribute& from, draco::AttributeValueIndex index, std::size_t components,
             unsigned char* to) {
    std::array<T, 16> values;  // at most a 4 x 4 matrix
    if (!from.ConvertValue<T>(index, static_cast<std::int8_t>(components), values.data())) return false;
    std::memcpy(to, values.data(), components * sizeof(T));
    return true;
}

struct Type {
    draco::DataType in_stream;
    int in_accessor;
    const char* name;
    bool (*convert)(const draco::PointAttribute&, draco::AttributeValueIndex, std::size_t, unsigned char*);
};
constexpr std::array dracoTypes{
    Type{draco::DT_INT8, TINYGLTF_COMPONENT_TYPE_BYTE, "bytes", convert<std::int8_t>},
    Type{draco::DT_UINT8, TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE, "unsigned bytes", convert<std::uint8_t>},
    Type{draco::DT_INT16, TINYGLTF_COMPONENT_TYPE_SHORT, "shorts", convert<std::int16_t>},
    Type{draco::DT_UINT16, TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT, "unsigned shorts", convert<std::uint16_t>},
    Type{draco::DT_INT32, TINYGLTF_COMPONENT_TYPE_INT, "ints", convert<std::int32_t>},
    Type{draco::DT_UINT32, TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT, "unsigned ints", convert<std::uint32_t>},
    Type{draco::DT_FLOAT32, TINYGLTF_COMPONENT_TYPE_FLOAT, "floats", convert<float>}};

template <class Key>
const Type* typeOf(Key Type::*member, Key key) {
    const auto at = std::ranges::find(dracoTypes, key, member);
    return at == dracoTypes.end() ? nullptr : at;
}

// The attribute's values in the accessor's type. Integers may have another width in the stream, because
// many exporters write JOINTS_0 so. Normalized integers may not, because their values would change.
Bytes valuesOf(const draco::Mesh& mesh, const DracoPrimitive::Attribute& attribute,
               const tinygltf::Accessor& to, const std::string& who) {
    const draco::PointAttribute* from = mesh.GetAttributeByUniqueId(attribute.id);
    if (!from) fail(who, fmt::format("its stream has no attribute {}", attribute.id));
    const std::size_t components = componentsOf(to), bytes = elementBytes(to);
    if (from->num_components() != components)
        fail(who, fmt::format("its stream has {} components, but accessor {} has {}", from->num_components(),
                              attribute.accessor, components));
    const Type* stored = typeOf(&Type::in_stream, from->data_type());
    const Type* asked = typeOf(&Type::in_accessor, to.componentType);
    const bool same = stored == asked;
    if (!stored || !asked || (!same && (to.normalized || stored->in_stream == draco::DT_FLOAT32)))
        fail(who, fmt::format("its stream has {}, but accessor {} has {}{}",
                              stored ? stored->name : "another type", attribute.accessor,
                              to.normalized ? "normalized " : "", asked ? asked->name : "another type"));
    const std::size_t width = static_cast<std::size_t>(draco::DataTypeLength(from->data_type())) * components;
    if (!from->IsValid() || from->byte_offset() != 0 ||
        from->byte_stride() != static_cast<std::int64_t>(width) ||
        from->buffer()->data_size() < from->size() * width ||
        (!from->is_mapping_identity() && from->indices_map_size() < mesh.num_points()))
        fail(who, "its stream is damaged");

    Bytes result(mesh.num_points() * bytes);
    for (std::uint32_t p = 0; p < mesh.num_points(); ++p) {
        const draco::AttributeValueIndex index = from->mapped_index(draco::PointIndex(p));
        if (index.value() >= from->size()) fail(who, fmt::format("its stream has no value for vertex {}", p));
        unsigned char* out = &result[p * bytes];
        if (same)
            std::memcpy(out, from->GetAddress(index), bytes);
        else if (!asked->convert(*from, index, components, out))
            fail(who, fmt::format("vertex {} does not fit into {}", p, asked->name));
    }
    return result;
}

Result decoded(const Model& model, const DracoPrimitive& p, std::size_t limit) {
    const std::string who = primitiveName(p.mesh, p.primitive);
    const tinygltf::Primitive& primitive = model.meshes[p.mesh].primitives[p.primitive];
    DracoExpectation expected{p.vertices, {}, p.attributes.size(), limit};
    if (primitive.mode == TINYGLTF_MODE_TRIANGLES && primitive.indices >= 0) {
        const std::size_t indices = accessorAt(model, primitive.indices).count;
        if (indices % 3)
            fail(who,
                 fmt::format("accessor {}: {} indices are not a multiple of 3", primitive.indices, indices));
        expected.triangles = indices / 3;
    }
    const std::span<const unsigned char> stream = viewBytes(model, p.view);
    std::unique_ptr<draco::Mesh> mesh;
    try {
        mesh = decodeDracoStream(stream, expected);
    } catch (const std::bad_alloc&) {
        fail(who, "its stream does not fit in memory");
    } catch (const std::exception& e) {
        fail(who, firstLine(e.what()));
    }

    Result result;
    for (const DracoPrimitive::Attribute& a : p.attributes)
        result.attributes.push_back(valuesOf(*mesh, a, accessorAt(model, a.accessor), who + ": " + a.name));
    result.indices.reserve(3 * mesh->num_faces());
    for (std::uint32_t f = 0; f < mesh->num_faces(); ++f)
        for (const draco::PointIndex& corner : mesh->face(draco::FaceIndex(f)))
            result.indices.push_back(corner.value());
    return result;
}

// Appends an accessor like `accessor` with the elements `bytes`; returns its index.
int append(Model& model, tinygltf::Accessor accessor, Bytes bytes) {
    const int index = static_cast<int>(model.accessors.size());
    accessor.sparse = {};
    model.accessors.push_back(std::move(accessor));
    model.decoded_accessors[index] = std::move(bytes);
    return index;
}

}  // namespace

std::vector<DracoPrimitive> findDraco(const Model& model, const std::vector<bool>& drawn,
                                      std::map<std::size_t, std::string>& broken) {
    const Json& meshes = arrayAt(model.rest, "/meshes");
    std::vector<DracoPrimitive> result;
    for (std::size_t m = 0; m < model.meshes.size(); ++m) {
        const Json* primitives = memberOf(elementOf(meshes, m), "primitives");
        if (!drawn[m] || !primitives) continue;
        std::vector<DracoPrimitive> of_mesh;
        const std::string fault = faultOf([&] {
            for (std::size_t p = 0; p < primitives->size(); ++p)
                if (const Json* e = extension((*primitives)[p], dracoName))
                    of_mesh.push_back(readExtension(model, *e, m, p));
            std::ranges::move(of_mesh, std::back_inserter(result));
        });
        if (!fault.empty()) broken.emplace(m, fault);
    }
    return result;
}

double dracoCost(const Model& model, const DracoPrimitive& p) {
    std::size_t vertexBytes = 0;
    for (const DracoPrimitive::Attribute& a : p.attributes)
        vertexBytes += elementBytes(accessorAt(model, a.accessor));
    const int indices = model.meshes[p.mesh].primitives[p.primitive].indices;
    const std::size_t corners = indices < 0 ? 0 : accessorAt(model, indices).count;
    return static_cast<double>(p.vertices) * static_cast<double>(vertexBytes) +
           static_cast<double>(corners) * static_cast<double>(dracoBytesPerCorner);
}

void decodeDraco(Model& model, const std::vector<DracoPrimitive>& primitives, std::size_t limit,
                 std::map<std::size_t, std::string>& broken) {
    std::vector<Result> results(primitives.size());
    std::vector<std::string> faults(primitives.size());
    forEachInParallel(primitives.size(), [&](std::size_t i) {
        faults[i] = faultOf([&] { results[i] = decoded(model, primitives[i], limit); });
    });
    for (std::size_t i = 0; i < primitives.size(); ++i)
        if (!faults[i].empty()) broken.emplace(primitives[i].mesh, faults[i]);
    for (std::size_t i = 0; i < primitives.size(); ++i) {
        if (broken.contains(primitives[i].mesh)) continue;
        tinygltf::Primitive& primitive = model.meshes[primitives[i].mesh].primitives[primitives[i].primitive];
        for (std::size_t a = 0; a < primitives[i].attributes.size(); ++a) {
            const DracoPrimitive::Attribute& attribute = primitives[i].attributes[a];
            primitive.attributes[attribute.name] =
                append(model, accessorAt(model, attribute.accessor), std::move(results[i].attributes[a]));
        }
        // Decoding expands triangle strips to triangles.
        tinygltf::Accessor indices;
        indices.componentType = TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
        indices.type = TINYGLTF_TYPE_SCALAR;
        indices.count = results[i].indices.size();
        Bytes bytes(results[i].indices.size() * sizeof(std::uint32_t));
        if (!bytes.empty()) std::memcpy(bytes.data(), results[i].indices.data(), bytes.size());
        results[i].indices = {};
        primitive.indices = append(model, std::move(indices), std::move(bytes));
        primitive.mode = TINYGLTF_MODE_TRIANGLES;
    }
}

}  // namespace diptych::gltf
