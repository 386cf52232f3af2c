// SPDX-License-Identifier: MIT
// The verdict on a scene's materials and textures, compared with the reference's own: correct paths pass,
// and a fault in both paths fails in its channel.
#include "compare/verdict/pair_reports.h"
#include "shared/material/texture_probe.h"
#include "shared/scene/load.h"
#include "shared/scene/requirements.h"
#include "tests/image/scenes.h"

#include <set>

namespace diptych::tests {
namespace {

Settings tracedImage() {
    Settings settings = smallImage(GBufferEncoding::standard);
    settings.size = {240, 135};
    return settings;
}

Frame tracedReference(UploadedScene& scene) {
    Settings settings = with(tracedImage(), "path reference reference-mode scene");
    return scene.renderer.draw(settings, untimed(allChannels()));
}

// Failed channels of the paths that render `drawn`, against the reference of `scene`: "forward_plus
// roughness".
std::set<std::string> failuresAgainst(const Frame& reference, const std::vector<Frame>& drawn,
                                      const Scene& scene) {
    static const TextureSampling texels = probeTextures(device());
    const Requirements needs = requirements(scene, poseAt(scene, 0));
    const DeviceInfo& info = device().info();
    CompareOptions options;
    options.texels = texels;
    const Report report =
        makeReport({{{reference, drawn[0], drawn[1]}, needs}}, {info.name, info.driver, info.type}, options);
    std::set<std::string> failures;
    for (const std::size_t i : {0u, 1u})
        for (const ChannelDiff& channel : report.comparisons.at(i).channels) {
            if (channel.mode->supported_by == SupportedBy::both) {
                EXPECT_TRUE(channel.footprints.has_value()) << channel.mode->name;
            }
            if (channel.verdict == Verdict::fail)
                failures.insert(drawn[i].name + " " + std::string(channel.mode->name));
        }
    return failures;
}

class SceneVerdict : public testing::TestWithParam<std::string> {};

TEST_P(SceneVerdict, SoundPathsPass) {
    UploadedScene& scene = uploaded(GetParam());
    EXPECT_EQ(failuresAgainst(tracedReference(scene), scene.bothPaths(tracedImage()), scene.scene),
              std::set<std::string>());
}

INSTANTIATE_TEST_SUITE_P(Builtin, SceneVerdict,
                         testing::Values("builtin:gallery", "builtin:cutout", "builtin:lightmaps",
                                         "builtin:ortho"),
                         sceneName);

struct SharedFault {
    const char* channel;
    void (*plant)(Scene&);
};
const SharedFault sharedFaults[] = {
    {"roughness",
     [](Scene& s) {
         for (Material& m : s.materials) m.roughness *= 0.97f;
     }},
    {"albedo",
     [](Scene& s) {
         for (Material& m : s.materials) m.base_color.r *= 0.97f;
     }},
    {"normals",
     [](Scene& s) {
         for (Mesh& mesh : s.meshes)
             for (Primitive& p : mesh.primitives)
                 for (auto& n : p.normals) n.x += 0.1f;
     }},
    {"lit",
     [](Scene& s) {
         for (Light& l : s.lights) l.intensity *= 1.05f;
     }},
};

// Both paths render the changed scene, so they agree with each other.
TEST(SceneVerdictNegativeControl, FaultsOfBothPathsFailInTheirChannels) {
    UploadedScene& scene = uploaded("builtin:gallery");
    const Frame reference = tracedReference(scene);
    for (const SharedFault& fault : sharedFaults) {
        Scene changed = scene.scene;
        fault.plant(changed);
        Renderer renderer(device(), changed, pipelines());
        const std::set<std::string> failures =
            failuresAgainst(reference, bothPaths(renderer, tracedImage()), scene.scene);
        for (const char* path : {"deferred ", "forward_plus "})
            EXPECT_TRUE(failures.contains(std::string(path) + fault.channel)) << path << fault.channel;
    }
}

}  // namespace
}  // namespace diptych::tests
