// SPDX-License-Identifier: MIT
#include "compare/render/light_terms.h"

#include "compare/render/prepared_view.h"
#include "shared/contract/debug_mode.h"
#include "shared/frame/debug_modes.h"

#include <algorithm>
#include <utility>

namespace diptych {

namespace {

Settings withEnvironment(Settings settings, bool environment) {
    if (!environment) settings.ibl_intensity = 0;
    return settings;
}

}  // namespace

struct LightTerms::State {
    State(Device& device, SharedResources& resources, const SceneView& view, const Settings& requested,
          bool environment)
        : shared(resources),
          settings(withEnvironment(requested, environment)),
          frame(device, shared, view, settings),
          lights(frame.view.lights.lights) {
        frame.passes.run();
        first = frame.passes.size();
        const CaptureRequest request{{Channel::lit_diffuse, Channel::lit_specular}, {}, {}};
        captured = frame.path.capture(frame.passes, frame.view.inputs, frame.images, request);
    }

    SharedResources& shared;
    const Settings settings;  // the frame refers to it
    PreparedFrame frame;
    std::vector<gpu::Light> lights;  // with their original intensity
    std::size_t first = 0;           // first pass of the capture
    std::vector<CapturedImage> captured;
};

LightTerms::LightTerms(Device& device, SharedResources& shared, const SceneView& view,
                       const Settings& settings, bool environment)
    : state_(new State(device, shared, view, settings, environment)) {}
LightTerms::LightTerms(LightTerms&&) noexcept = default;
LightTerms::~LightTerms() = default;

std::array<double, 3> LightTerms::at(std::span<const std::size_t> shining, int x, int y) {
    std::vector<gpu::Light> lights = state_->lights;
    const GpuLights& all = state_->frame.view.lights;
    for (std::size_t i = 0; i < all.sources.size(); ++i)
        if (std::ranges::find(shining, all.sources[i]) == shining.end()) lights[i].intensity = gpu::vec3(0);
    state_->frame.view.buffers.replaceLights(state_->shared.uploader, lights);
    PassList& passes = state_->frame.passes;
    std::array<double, 3> sum{};
    std::size_t next = state_->first;
    for (const CapturedImage& image : state_->captured) {
        // Several images may belong to one pass.
        if (image.pass + 1 > next) {
            passes.run(next, image.pass + 1);
            next = image.pass + 1;
        }
        const PassList::ReadBack request{image.image, 3, {}, image.component};
        const Image read = std::move(readImages(passes, std::span(&request, 1)).front());
        for (std::size_t c = 0; c < 3; ++c) sum.at(c) += double{read.at(x, y, static_cast<int>(c))};
    }
    return sum;
}

std::optional<std::vector<std::size_t>> LightTerms::listAt(int x, int y, float depth) const {
    if (state_->settings.assign == Assignment::per_object) return {};
    PreparedView& view = state_->frame.view;
    const LightLists& lists = view.buffers.lists();
    const auto& sources = view.lights.sources;
    std::vector<std::size_t> listed;
    if (lists.any()) {
        for (gpu::uint i = 0; i < view.lights.directional; ++i) listed.push_back(sources.at(i));
        for (const gpu::uint light : lists.lightsAt(x, y, depth)) listed.push_back(sources.at(light));
    } else {
        listed = sources;
    }
    std::ranges::sort(listed);
    return listed;
}

}  // namespace diptych
