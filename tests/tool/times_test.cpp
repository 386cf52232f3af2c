// SPDX-License-Identifier: MIT
// Frames at several times on one device: shared data is uploaded and compiled once, and each frame has its
// own pose.
#include "compare/frames/frame_properties.h"
#include "compare/render/prepared_view.h"
#include "shared/scene/load.h"
#include "shared/vulkan/device/device.h"

#include <gtest/gtest.h>

#include <deque>
#include <vector>

namespace diptych {
namespace {

Settings settingsAt(double time, Path path, Skinning skinning) {
    Settings settings;
    settings.size = {32, 18};
    settings.time = time;
    settings.path = path;
    settings.skinning = skinning;
    return settings;
}

TEST(Times, ASecondTimeUploadsItsPoseAndCompilesNothing) {
    Device device(DeviceOptions{});
    const Scene scene = loadScene("builtin:motion");
    SceneViews views(scene);
    SharedResources shared(device, scene);
    for (const Skinning skinning : {Skinning::compute, Skinning::vertex}) {
        std::deque<PreparedFrame> frames;
        std::vector<Image> images;
        const auto drawAt = [&](double time) {
            for (const Path path : drawn_paths) {
                const Settings settings = settingsAt(time, path, skinning);
                frames.emplace_back(device, shared, views.at(viewRequest(settings)), settings);
                frames.back().passes.run();
                images.push_back(readLit(frames.back()));
            }
        };
        const std::size_t posed = shared.posings.made();
        drawAt(0.25);
        EXPECT_EQ(shared.posings.made(), posed + 1) << "both paths draw one pose";
        // The target weight is 0 at time 0.25 and nonzero from 0.5 on: its shader is compiled on demand.
        drawAt(0.6);
        const std::size_t compiled = shared.pipelines.made();
        const std::uint64_t uploaded = shared.uploader.bytes();
        drawAt(0.5);
        EXPECT_EQ(shared.pipelines.made(), compiled);
        EXPECT_EQ(shared.posings.made(), posed + 3);
        EXPECT_GT(shared.uploader.bytes(), uploaded) << "the third pose";
        EXPECT_LT(shared.uploader.bytes() - uploaded, shared.geometry.bytes() / 4)
            << "of " << shared.geometry.bytes() << " bytes of geometry";
        // Each time gives a different image, whichever was rendered last.
        for (std::size_t i = 0; i < 2; ++i) {
            EXPECT_NE(images[i].data, images[i + 4].data) << i;
            frames[i].passes.run();
            EXPECT_EQ(readLit(frames[i]).data, images[i].data) << i;
        }
    }
}

// One after another, as for an animation: nothing of earlier frames remains.
TEST(Times, ViewsThatAreClearedAreMadeAgainAlike) {
    const Scene scene = loadScene("builtin:motion");
    SceneViews views(scene);
    ViewRequest request = viewRequest(settingsAt(0.5, Path::deferred, Skinning::compute));
    request.camera = "";
    const glm::dvec3 eye = views.at(request).view.eye();
    const auto instances = views.at(request).pose.instances;
    views.clear();
    EXPECT_EQ(views.at(request).pose.instances, instances);
    EXPECT_EQ(views.at(request).view.eye(), eye);
}

}  // namespace
}  // namespace diptych
