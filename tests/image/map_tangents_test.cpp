// SPDX-License-Identifier: MIT
// Tangents of maps that have texture coordinates of their own, in both paths and the reference.
#include "shared/scene/model/material_slots.h"
#include "shared/scene/model/tangents.h"
#include "tests/image/square.h"

namespace diptych::tests {
namespace {

// Frames of both paths and the reference, each with the coat's normal and the direction of anisotropy.
std::vector<Frame> drawMaps(Scene scene, double degrees) {
    Primitive& p = scene.meshes[0].primitives[0];
    const Material& m = scene.materials[0];
    const RotatedMaps rotated = rotatedMaps(m, true);
    makeTangents(p, tangentMap(m), false, rotated.layers != 0 ? &rotated.map : nullptr);
    scene.nodes[0].parent_from_node =
        glm::scale(glm::rotate(glm::dmat4(1), glm::radians(degrees), glm::dvec3(0, 0, 1)), {2, -1, 1});
    Settings settings = smallImage(GBufferEncoding::full);
    settings.size = {4, 4};
    std::vector<Frame> frames = bothPaths(scene, settings);
    settings.path = Path::reference;
    settings.reference_mode = ReferenceMode::scene;
    Renderer renderer(device(), scene, pipelines());
    frames.push_back(renderer.draw(settings, untimed(allChannels())));
    return frames;
}

// A normal map that changes no normal (scale 0) changes neither the coat nor the direction of anisotropy,
// whatever its coordinates, on a turned, stretched and mirrored node.
TEST(MapTangents, AFlatNormalMapLeavesTheLayersTheirTangents) {
    Scene plain = square();
    plain.images[0] = {"tilted", 1, 1, {200, 90, 220, 255}};
    Material& m = plain.materials[0];
    m.double_sided = true;
    m.clearcoat = 1;
    m.anisotropy = 0.7f;
    m.anisotropy_rotation = 0.5f;
    for (const int set : {0, 1}) {
        m.clearcoat_normal_texture.texture = m.anisotropy_texture.texture = 0;
        m.clearcoat_normal_texture.texcoord = m.anisotropy_texture.texcoord = set;
        const std::vector<Frame> expected = drawMaps(plain, 20);
        for (const double degrees : {0.0, 40.0, 90.0, 250.0})
            for (const double across : {1.0, -2.0}) {
                Scene mapped = plain;
                Material& base = mapped.materials[0];
                base.normal_texture.texture = 0;
                base.normal_scale = 0;
                const double c = std::cos(glm::radians(degrees)), s = std::sin(glm::radians(degrees));
                base.normal_texture.u = {c * across, s, 0.25};
                base.normal_texture.v = {-s * across, c, 0};
                const std::vector<Frame> frames = drawMaps(mapped, 20);
                for (std::size_t i = 0; i < frames.size(); ++i)
                    for (const Channel channel : {Channel::clearcoat_normal, Channel::anisotropy_direction}) {
                        const glm::vec3 seen = colorAt(frames[i], channel, 1, 2),
                                        own = colorAt(expected[i], channel, 1, 2);
                        EXPECT_NEAR(glm::length(own), 1, 1e-5) << frames[i].name;
                        EXPECT_NEAR(std::min(glm::distance(seen, own), glm::distance(seen, -own)), 0, 3e-6)
                            << frames[i].name << " " << set << " " << degrees << " " << across << " "
                            << debugMode(channel).name;
                    }
            }
    }
}

}  // namespace
}  // namespace diptych::tests
