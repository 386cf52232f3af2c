// SPDX-License-Identifier: MIT
// The job of an external renderer: what its files leave out.
#include "compare/external/job.h"
#include "tests/support/files.h"
#include "tests/support/plain_builtin.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace diptych::external {
namespace {

using Notes = std::vector<std::string>;

// A light or texture that glTF lacks is noted for each file without it, by kind and with their number.
TEST(ExternalJob, NotesSayWhatItsFilesLeaveOut) {
    const auto notesOf = [](const Scene& scene) {
        ViewRequest request;
        request.width = request.height = 4;
        ExternalRenderer renderer;
        renderer.name = "fake";
        return writeJob(folder(), scene, makeSceneView(scene, request), Settings(), renderer).notes;
    };
    Scene scene = plainBuiltin("triangle");
    scene.lights.clear();
    const auto shine = [&](LightKind kind) {
        Light light;
        light.kind = kind;
        scene.lights.push_back(light);
    };
    for (const LightKind kind : {LightKind::directional, LightKind::point, LightKind::spot}) shine(kind);
    TextureImage image;
    image.width = image.height = 1;
    image.rgba = {1, 2, 3, 255};
    Texture texture;
    texture.image = static_cast<int>(scene.images.size());
    scene.images.push_back(image);
    scene.textures.push_back(texture);
    Material& material =
        scene.materials[static_cast<std::size_t>(scene.meshes.at(0).primitives.at(0).material)];
    material.base_color_texture.texture = static_cast<int>(scene.textures.size()) - 1;
    EXPECT_EQ(notesOf(scene), Notes{});
    shine(LightKind::rect);
    EXPECT_EQ(notesOf(scene), (Notes{"fake: omitted from scene.glb: 1 rect light: glTF has no such lights",
                                     "fake: omitted from rig.glb: 1 rect light: glTF has no such lights"}));
    shine(LightKind::tube);
    shine(LightKind::rect);
    scene.images.back().rgba.clear();
    scene.images.back().rgba16 = {1, 2, 3, 65535};
    EXPECT_EQ(notesOf(scene), (Notes{"fake: omitted from scene.glb: 1 16-bit texture: written with 8 bits",
                                     "fake: omitted from scene.glb: 2 rect lights: glTF has no such lights",
                                     "fake: omitted from scene.glb: 1 tube light: glTF has no such lights",
                                     "fake: omitted from rig.glb: 2 rect lights: glTF has no such lights",
                                     "fake: omitted from rig.glb: 1 tube light: glTF has no such lights"}));
    scene.lights.clear();
    shine(LightKind::point);
    scene.images.back().rgba16.clear();
    scene.images.back().rgba32 = {1, 2, 3, 1};
    EXPECT_EQ(notesOf(scene),
              Notes{"fake: omitted from scene.glb: 1 float texture: glTF has no float textures"});
    material.base_color_texture.texture = -1;
    material.lightmap_texture.texture = static_cast<int>(scene.textures.size()) - 1;
    material.lightmap_intensity = 0;
    EXPECT_EQ(notesOf(scene), Notes{});
    material.lightmap_intensity = 1;
    EXPECT_EQ(notesOf(scene), Notes{"fake: omitted from scene.glb: 1 lightmap: glTF has no lightmaps"});
}

}  // namespace
}  // namespace diptych::external
