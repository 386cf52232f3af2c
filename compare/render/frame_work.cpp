// SPDX-License-Identifier: MIT
#include "compare/render/frame_work.h"

#include "compare/render/prepared_view.h"
#include "forward_plus/prepass.h"
#include "shared/contract/geometry.h"

namespace diptych {

namespace {

// A pass of up to two triangles is full-screen and has no scene geometry.
constexpr std::uint64_t screenTriangles = 2;
constexpr double positionBytes = sizeof(gpu::vec3), attributeBytes = sizeof(gpu::VertexAttributes);

PassWork workOf(Path path, const PassCounts& counts, double textures, double lights) {
    PassWork work{counts};
    const auto fragments = static_cast<double>(counts.fragments);
    const bool shades = counts.name.starts_with("shade");
    const bool geometry = counts.triangles > screenTriangles && !(shades && hasGBuffer(path));
    if (geometry) {
        work.texels = fragments * textures;
        work.vertex_bytes = static_cast<double>(counts.vertices) *
                            (positionBytes + (counts.fragments > 0 ? attributeBytes : 0));
    }
    // With --lighting compute, threads shade, including those of the background.
    if (shades) work.lights = (fragments + static_cast<double>(counts.compute)) * lights;
    return work;
}

}  // namespace

std::vector<FrameWork> countWork(Device& device, SceneViews& views, const std::vector<Settings>& settings) {
    SharedResources shared(device, views.scene());
    std::vector<FrameWork> frames;
    for (const Settings& s : settings) {
        checkSize(device, s.size);
        PreparedFrame prepared(device, shared, views.at(viewRequest(s)), s);
        prepared.passes.run();
        const Overdraw overdraw =
            measureOverdraw(prepared.view.inputs, static_cast<std::uint32_t>(s.size.width),
                            static_cast<std::uint32_t>(s.size.height));
        FrameWork frame{s.path, {}};
        const double lights = lightsAtPixel(prepared.view.inputs);
        for (const PassCounts& counts : prepared.passes.count(0, prepared.passes.size()))
            frame.passes.push_back(workOf(s.path, counts, overdraw.textures, lights));
        frames.push_back(std::move(frame));
    }
    return frames;
}

}  // namespace diptych
