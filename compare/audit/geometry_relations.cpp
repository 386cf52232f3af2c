// SPDX-License-Identifier: MIT
#include "compare/audit/relations.h"

#include "compare/audit/small_scene.h"
#include "shared/scene/gltf/gltf.h"
#include "shared/scene/lights/lights_json.h"

#include <algorithm>
#include <utility>

namespace diptych::audit {

namespace {

bool hasRigidPrimitives(const Mesh& mesh) {
    return std::ranges::all_of(mesh.primitives, isRigid);
}
bool isBlended(const Scene& scene, const Primitive& primitive) {
    return blends(scene.materials[static_cast<std::size_t>(primitive.material)]);
}

std::string lacksRigidMesh(const Subject& subject) {
    const bool any = std::ranges::any_of(subject.original.scene.meshes, [](const Mesh& mesh) {
        return !mesh.primitives.empty() && hasRigidPrimitives(mesh);
    });
    return any ? "" : "every mesh of the scene is skinned or morphed";
}

std::string lacksOrder(const Subject& subject) {
    const bool unsorted = subject.original.settings.transparency == Transparency::unsorted;
    return unsorted ? "--transparency unsorted blends in file order" : "";
}

// Blended surfaces at equal distance are blended in the order of the file.
bool isReversible(const Scene& scene, const Mesh& mesh) {
    return hasRigidPrimitives(mesh) && std::ranges::none_of(mesh.primitives, [&](const Primitive& primitive) {
               return isBlended(scene, primitive);
           });
}

void reverseDraws(Related& related, const Subject&) {
    Scene& scene = related.changed.scene;
    for (std::size_t i = scene.nodes.size(); i-- > 0;) {
        const int mesh = scene.nodes[i].mesh;
        if (mesh < 0 || !isReversible(scene, scene.meshes[static_cast<std::size_t>(mesh)])) continue;
        carry(scene, i, mesh);
        scene.nodes[i].mesh = -1;
    }
    for (Mesh& mesh : scene.meshes)
        if (isReversible(scene, mesh)) std::ranges::reverse(mesh.primitives);
}

// Splits every mesh into two, with the first and the last half of its triangles.
void splitMeshes(Related& related, const Subject&) {
    Scene& scene = related.changed.scene;
    const std::size_t meshes = scene.meshes.size(), nodes = scene.nodes.size();
    std::vector<int> other(meshes, -1);
    for (std::size_t m = 0; m < meshes; ++m) {
        if (!hasRigidPrimitives(scene.meshes[m])) continue;
        Mesh rest = scene.meshes[m];
        bool any = false;
        for (std::size_t p = 0; p < rest.primitives.size(); ++p) {
            std::vector<std::uint32_t>&first = scene.meshes[m].primitives[p].indices,
            &last = rest.primitives[p].indices;
            // Blended triangles are sorted per draw call, so they stay together.
            const auto count = isBlended(scene, rest.primitives[p]) ? last.size() / 3 : last.size() / 6;
            last.erase(last.begin(), last.begin() + static_cast<std::ptrdiff_t>(3 * count));
            first.resize(3 * count);
            any = any || !last.empty();
        }
        const auto isEmpty = [](const Primitive& primitive) { return primitive.indices.empty(); };
        for (Mesh* half : {&rest, &scene.meshes[m]}) std::erase_if(half->primitives, isEmpty);
        if (!any) continue;
        other[m] = static_cast<int>(scene.meshes.size());
        scene.meshes.push_back(std::move(rest));
    }
    for (std::size_t i = 0; i < nodes; ++i)
        if (const int mesh = scene.nodes[i].mesh; mesh >= 0 && other[static_cast<std::size_t>(mesh)] >= 0)
            carry(scene, i, other[static_cast<std::size_t>(mesh)]);
}

void unindex(Related& related, const Subject&) {
    for (Mesh& mesh : related.changed.scene.meshes)
        for (Primitive& primitive : mesh.primitives) {
            if (!isRigid(primitive)) continue;
            Primitive separated = withoutVertices(primitive);
            for (const std::uint32_t i : primitive.indices) addVertex(separated, primitive, i);
            primitive = std::move(separated);
        }
}

// Whether its interpolated attributes are linear, so that its parts interpolate equally: normals and
// tangents are normalised at a mesh's vertices.
bool isFlat(const Primitive& primitive, const std::uint32_t* corners) {
    const auto same = [&](const auto& values) {
        return values[corners[0]] == values[corners[1]] && values[corners[0]] == values[corners[2]];
    };
    return same(primitive.normals) && same(primitive.tangents);
}

// Adds the vertex between two of a flat triangle.
std::uint32_t middleOf(Primitive& primitive, std::uint32_t a, std::uint32_t b) {
    eachAttribute(primitive, primitive,
                  [&](auto& to, const auto& from) { to.push_back((from[a] + from[b]) * 0.5f); });
    return static_cast<std::uint32_t>(primitive.positions.size() - 1);
}

std::string lacksFlat(const Subject& subject) {
    // Edge midpoints round to 2^-24 of their distance from the mesh's origin.
    if (subject.has_surface && subject.bounds.radius() > 1000 * subject.nearest)
        return "the scene's farthest surface is over 1000 times as far as its nearest: rounded edge "
               "midpoints would be visible";
    for (const Mesh& mesh : subject.original.scene.meshes)
        for (const Primitive& primitive : mesh.primitives)
            for (std::size_t t = 0; isRigid(primitive) && t + 2 < primitive.indices.size(); t += 3)
                if (isFlat(primitive, &primitive.indices[t])) return {};
    return "the scene has no flat triangle outside skinned and morphed meshes";
}

// Splits each flat triangle into four.
void splitTriangles(Related& related, const Subject&) {
    for (Mesh& mesh : related.changed.scene.meshes)
        for (Primitive& primitive : mesh.primitives) {
            if (!isRigid(primitive)) continue;
            std::vector<std::uint32_t> indices;
            for (std::size_t t = 0; t + 2 < primitive.indices.size(); t += 3) {
                const std::uint32_t* const corners = &primitive.indices[t];
                const std::uint32_t a = corners[0], b = corners[1], c = corners[2];
                if (!isFlat(primitive, corners)) {
                    indices.insert(indices.end(), {a, b, c});
                    continue;
                }
                const std::uint32_t ab = middleOf(primitive, a, b), bc = middleOf(primitive, b, c),
                                    ca = middleOf(primitive, c, a);
                indices.insert(indices.end(), {a, ab, ca, ab, b, bc, ca, bc, c, ab, bc, ca});
            }
            primitive.indices = std::move(indices);
        }
}

std::string lacksMaterials(const Subject& subject) {
    const Scene& scene = subject.original.scene;
    if (scene.materials.size() < 2) return "the scene has one material";
    for (const Animation& animation : scene.animations)
        for (const AnimationChannel& channel : animation.channels)
            if (channel.part >= AnimatedPart::base_color)
                return "an animation refers to a material by its index";
    return {};
}

void permuteMaterials(Related& related, const Subject&) {
    Scene& scene = related.changed.scene;
    const int last = static_cast<int>(scene.materials.size()) - 1;
    std::ranges::reverse(scene.materials);
    for (Mesh& mesh : scene.meshes)
        for (Primitive& primitive : mesh.primitives) primitive.material = last - primitive.material;
    std::map<int, MaterialParts> parts;
    for (auto& [index, of] : scene.material_parts) parts.emplace(last - index, std::move(of));
    scene.material_parts = std::move(parts);
    for (int i = 0; i <= last; ++i) related.map.ids.push_back(last - i);
}

std::string lacksFile(const Subject& subject) {
    return flattened(subject.original)
               ? ""
               : "joints, morph targets or a rotated normal map move vertices, and the "
                 "written file leaves them out";
}

// The scene without textures, environment and animation, written to a file and read back.
Case readAgain(const Case& flat, const std::string& file, const char* name) {
    Case read = flat;
    read.scene = parseGltf({file.begin(), file.end()}, name);
    read.scene.lights = lightsFromJson(lightsFileOf(flat), "lights.json");
    read.scene.background = flat.scene.background;
    return read;
}

void throughGltf(Related& related, const Subject& subject) {
    related.own_base = true;
    related.base = *flattened(subject.original);
    related.changed = readAgain(related.base, gltfOf(related.base), "relation.gltf");
    // Unused materials are not written; the others are numbered in order of first use.
    related.map.ids = writtenMaterials(related.base.scene);
}
void throughGlb(Related& related, const Subject& subject) {
    related.own_base = true;
    const Case flat = *flattened(subject.original);
    related.base = readAgain(flat, gltfOf(flat), "relation.gltf");
    related.changed = readAgain(flat, glbOf(flat), "relation.glb");
}

}  // namespace

std::vector<Relation> geometryRelations() {
    return {
        {.name = "draws_reversed",
         .changes = "draw calls are reversed: the last comes first",
         .because = "the nearest surface is visible in any drawing order",
         .lacks = {lacksOrder, lacksRigidMesh},
         .change = reverseDraws,
         .reorders = true,
         .same_pipelines = true},
        {.name = "meshes_split",
         .changes = "each mesh becomes two with half the triangles each",
         .because = "a triangle is drawn the same way in any draw call",
         .lacks = {lacksRigidMesh},
         .change = splitMeshes,
         .reorders = true,
         .same_pipelines = true},
        {.name = "unindexed",
         .changes = "no triangle shares a vertex with another",
         .because = "the same vertices are read from other indices",
         .lacks = {lacksRigidMesh},
         .change = unindex,
         .same_pipelines = true},
        {.name = "triangles_split",
         .changes = "each flat triangle becomes four",
         .equality = Equality::rounding,
         .because = "edge midpoints are rounded to float32, and interpolation starts from them",
         .lacks = {lacksPerObject, lacksFlat},
         .change = splitTriangles},
        {.name = "materials_permuted",
         .changes = "the order of the materials is reversed",
         .because = "the same values are read from other indices",
         .lacks = {lacksMaterials},
         .change = permuteMaterials,
         .reorders = true,
         .same_pipelines = true},
        {.name = "through_gltf",
         .changes = "the scene without textures and motion is written to a .gltf file and read again",
         .equality = Equality::rounding,
         .because = "the file keeps float32 exactly, but the reader normalizes normals again",
         .lacks = {lacksFile},
         .change = throughGltf},
        {.name = "through_glb",
         .changes = "the same scene is read from a .glb file instead of a .gltf file",
         .because = "a data URI and a binary chunk hold the same bytes",
         .lacks = {lacksFile},
         .change = throughGlb,
         .same_pipelines = true},
    };
}

}  // namespace diptych::audit
