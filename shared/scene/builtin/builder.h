// SPDX-License-Identifier: MIT
// Builds a scene; each call adds one object to `scene`.
#pragma once

#include "shared/scene/builtin/shapes.h"
#include "shared/scene/model/scene.h"

#include <glm/ext/matrix_transform.hpp>

#include <limits>
#include <string>

namespace diptych {

struct Surface {
    glm::vec3 base_color{0.8f};
    float metallic = 0, roughness = 0.5f;
    glm::vec3 emissive{0};  // W/(sr m^2)
};

class Builder {
public:
    static constexpr float noEnd = std::numeric_limits<float>::infinity();  // a light's range
    Scene scene;

    // Adds a material and returns its index; the caller may then modify it as last().
    int material(const std::string& name, const Surface& surface);
    Material& last() { return scene.materials.back(); }

    // Adds a texture and returns a slot that reads it by the first UV set, repeated `tiles` times over [0,
    // 1].
    TextureSlot texture(TextureImage image, double tiles = 1, const Sampler& sampler = {});

    // Adds a node whose mesh is one primitive; returns the node's index.
    int add(const std::string& name, Primitive shape, int material,
            const glm::dmat4& worldFromShape = glm::dmat4(1.0));
    int add(const std::string& name, Primitive shape, int material, const glm::dvec3& position);
    int addMesh(Primitive shape, int material, const std::string& name);
    int addNode(const std::string& name, int mesh, const glm::dmat4& parentFromNode, int parent = -1);

    // Units: candela, for the sun lux; m; cone half angles in degrees. `direction` need not be normalized.
    void point(const glm::dvec3& position, const glm::vec3& color, float candela, float range = noEnd);
    struct Cone {
        double inner, outer;
    };
    void spot(const glm::dvec3& position, const glm::dvec3& target, const glm::vec3& color, float candela,
              float range, const Cone& cone);
    void sun(const glm::dvec3& direction, const glm::vec3& color, float lux);
    // Adds an area light of 1 m^2 that shines towards `target`. Returns it, so that the caller can change
    // its shape.
    Light& rect(const glm::dvec3& position, const glm::dvec3& target, const glm::vec3& color, float nits,
                float range = noEnd);

    // Adds a camera at `eye` looking at `target`, with +Y up (unless it looks along Y).
    Camera& camera(const std::string& name, const glm::dvec3& eye, const glm::dvec3& target,
                   double yfovDegrees, double near = 0.1, double far = 1000);

private:
    Light& light(const char* name, LightKind kind, const glm::vec3& color, float intensity, float range,
                 const glm::dvec3& position, const glm::dvec3& direction);
};

glm::dmat4 at(double x, double y, double z);
glm::dmat4 rotated(double degrees, const glm::dvec3& axis = {0, 1, 0});
glm::dmat4 scaled(double x, double y, double z);

}  // namespace diptych
