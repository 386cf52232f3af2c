// SPDX-License-Identifier: MIT
// Writes glTF 2.0: a document and its buffer in one file.
#pragma once

#include "shared/scene/model/scene.h"

#include <glm/mat4x4.hpp>
#include <nlohmann/json.hpp>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace diptych {

class GltfFile {
public:
    explicit GltfFile(const std::string& generator);

    nlohmann::ordered_json json;  // the document; this class adds accessors, views and buffer

    // Returns the accessor's index. `type`: "VEC3"; `component`: 5126 float, 5125 unsigned int.
    template <class T>
    std::size_t add(const std::vector<T>& values, const char* type, int component) {
        return addAccessor(addBytes(std::as_bytes(std::span(values))), values.size(), type, component);
    }
    // The same for positions, with the bounds that glTF requires.
    std::size_t addPositions(const std::vector<glm::vec3>& positions);
    // Returns the buffer view's index.
    std::size_t addBytes(std::span<const std::byte> bytes);

    // The complete file: as JSON with an embedded buffer, and as .glb.
    std::string text() const;
    std::string binary() const;

private:
    std::size_t addAccessor(std::size_t view, std::size_t count, const char* type, int component);

    std::vector<std::byte> bytes_;
};

inline constexpr const char* specularGlossiness = "KHR_materials_pbrSpecularGlossiness";

// A factor of a material: a number or an array.
nlohmann::ordered_json gltfFactor(const Material& material, AnimatedPart part);
// A material's factors in glTF terms, without textures.
nlohmann::ordered_json gltfMaterial(const Material& material);
// Extensions that gltfMaterial() may use.
std::vector<std::string> gltfMaterialExtensions();

// A camera; `aspect`: width over height. An infinite orthographic far plane becomes 1e6 times half the
// height, because glTF requires a finite one.
nlohmann::ordered_json gltfCamera(const Camera& camera, double aspect);

// JSON arrays.
nlohmann::ordered_json listOf(const glm::dvec3& vector);
nlohmann::ordered_json listOf(const glm::dmat4& matrix);  // column-major

}  // namespace diptych
