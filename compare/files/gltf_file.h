// SPDX-License-Identifier: MIT
// glTF 2.0 as it is written: a document and its buffer, in one file.
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

    nlohmann::ordered_json json;  // the document; this class adds its accessors, views and buffer

    // An accessor's number. `type`: "VEC3"; `component`: 5126 float, 5125 unsigned int.
    template <class T>
    std::size_t add(const std::vector<T>& values, const char* type, int component) {
        return addAccessor(addBytes(std::as_bytes(std::span(values))), values.size(), type, component);
    }
    // The same of positions, with their bounds, which glTF asks for.
    std::size_t addPositions(const std::vector<glm::vec3>& positions);
    // A buffer view's number.
    std::size_t addBytes(std::span<const std::byte> bytes);

    // All in one file: as text with the buffer inside, and as .glb.
    std::string text() const;
    std::string binary() const;

private:
    std::size_t addAccessor(std::size_t view, std::size_t count, const char* type, int component);

    std::vector<std::byte> bytes_;
};

// The factors of a material, by glTF's names; without its textures.
nlohmann::ordered_json gltfMaterial(const Material& material);
// The extensions that gltfMaterial() may use.
std::vector<std::string> gltfMaterialExtensions();

// A camera of a picture so many times as wide as high; an orthographic one without a far plane, which glTF
// does not know, ends at 1e6 times half its height.
nlohmann::ordered_json gltfCamera(const Camera& camera, double aspect);

// Lists of numbers.
nlohmann::ordered_json listOf(const glm::dvec3& vector);
nlohmann::ordered_json listOf(const glm::dmat4& matrix);  // column by column

}  // namespace diptych
