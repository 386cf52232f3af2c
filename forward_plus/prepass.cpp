// SPDX-License-Identifier: MIT
#include "forward_plus/prepass.h"

#include "forward_plus/forward_plus.h"
#include "shared/draw/pipeline_keys.h"
#include "shared/draw/pipeline_parts.h"
#include "shared/draw/record.h"
#include "shared/vulkan/device/commands.h"
#include "shared/vulkan/instance/check.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <span>

namespace diptych {

namespace {

int texturesOf(const Variant& variant) {
    int count = 0;
    for (const gpu::uint feature : slotFeatures) count += variant.get(feature) == gpu::TEXEL_OWN;
    return count;
}

class Queries {
public:
    explicit Queries(Device& device)
        : device_(device), pool_(makeQueryPool(device.handle(), VK_QUERY_TYPE_OCCLUSION, 2)) {
        device.submit([&](VkCommandBuffer commands) { vkCmdResetQueryPool(commands, pool_, 0, 2); });
    }
    void begin(VkCommandBuffer commands, std::uint32_t query) const {
        vkCmdBeginQuery(commands, pool_, query, VK_QUERY_CONTROL_PRECISE_BIT);
    }
    void end(VkCommandBuffer commands, std::uint32_t query) const { vkCmdEndQuery(commands, pool_, query); }
    std::array<std::uint64_t, 2> results() const {
        std::array<std::uint64_t, 2> samples{};
        checkResult(vkGetQueryPoolResults(device_.handle(), pool_, 0, 2, sizeof samples, samples.data(), 8,
                                          VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT),
                    "vkGetQueryPoolResults");
        return samples;
    }

private:
    Device& device_;
    OwnedQueryPool pool_;
};

// Whether any triangle of an opaque draw may be visible.
bool drawsSolids(const DrawList& draws) {
    return std::ranges::any_of(draws.solids(), [&](const DrawItem& item) {
        const auto runs = std::span(draws.runs).subspan(item.first_run, item.runs);
        return runs.empty() || std::ranges::any_of(runs, [](const IndexRange& run) { return run.count > 0; });
    });
}

}  // namespace

Overdraw measureOverdraw(const FrameInputs& inputs, std::uint32_t width, std::uint32_t height) {
    Overdraw overdraw;
    for (const DrawItem& item : inputs.draws.solids()) {
        const std::uint64_t triangles = item.range.index_count / 3;
        overdraw.triangles += triangles;
        overdraw.textures += static_cast<double>(triangles) * texturesOf(item.variant);
    }
    overdraw.textures /= static_cast<double>(std::max<std::uint64_t>(overdraw.triangles, 1));
    // lavapipe 22.3 crashes if a full-screen triangle without a fragment shader is the first draw.
    if (!drawsSolids(inputs.draws) || !inputs.device.support().has(DeviceFeature::occlusionQueryPrecise))
        return overdraw;
    const std::uint32_t part = std::max({1u, width / 320, height / 180});
    PassList passes(inputs.device, std::max(1u, width / part), std::max(1u, height / part));
    const Queries queries(inputs.device);
    const ImageRef depth = sceneDepth(passes, inputs);
    const auto draws = recordDraws(inputs, inputs.draws.solids(), depthKey);
    readGeometry(passes, passes.draw("count fragments"), inputs)
        .depth(depth, Load::clear)
        .record([&](VkCommandBuffer commands) {
            queries.begin(commands, 0);
            draws(commands);
            queries.end(commands, 0);
        });
    // As in deferred lighting, the full-screen triangle passes the depth test on covered pixels.
    const Pipeline pipeline =
        inputs.pipelines.get(inputs.depth.stored({.vertex = Shader::full_screen_vert,
                                                  .fragment = Shader::none,
                                                  .variant = {},
                                                  .input = NO_VERTICES,
                                                  .colors = {},
                                                  .depth = depthFormat,
                                                  .depth_compare = VK_COMPARE_OP_LESS_OR_EQUAL,
                                                  .depth_write = false,
                                                  .samples = inputs.samples}));
    passes.draw("count pixels").depthTest(depth).record([&](VkCommandBuffer commands) {
        queries.begin(commands, 1);
        recordTriangle(commands, pipeline);
        queries.end(commands, 1);
    });
    passes.run();
    const auto [fragments, covered] = queries.results();  // in samples
    overdraw.fragments = fragments * part * part / inputs.samples;
    overdraw.covered = covered * part * part / inputs.samples;
    return overdraw;
}

PrepassChoice choosePrepass(const Overdraw& overdraw, double lights, const DeviceProfile& device) {
    const DeviceCosts& costs = device.costs;
    const auto fragments = static_cast<double>(overdraw.fragments),
               covered = static_cast<double>(overdraw.covered);
    const double saved = (fragments - covered) *
                         (costs.surface + costs.texture * overdraw.textures + costs.light * lights) * 1e-6;
    const double cost =
        (static_cast<double>(overdraw.triangles) * costs.triangle + fragments * costs.depth) * 1e-6;
    const bool on = saved > cost;
    return {on, fmt::format(
                    "--prepass auto is {}: {:.2f} fragments per covered pixel; the pre-pass would take about "
                    "{:.2g} ms on {} device and save {:.2g} ms of shading",
                    on ? "on" : "off", covered > 0 ? fragments / covered : 0.0, cost,
                    device.software ? "this CPU" : "this GPU", saved)};
}

std::vector<std::string> prepareForwardPlus(FrameInputs& inputs, const Settings& settings) {
    inputs.prepass = settings.prepass != Switch::off;
    // With quantised depth, both paths shade at the stored depth, which needs a pre-pass.
    if (inputs.depth.inSteps()) return {};
    // The depth of a tile bounds its lights, so tiles need a pre-pass.
    if (settings.prepass != Switch::automatic || settings.assign == Assignment::tiled) return {};
    if (inputs.samples > 1 && inputs.device.profile().shades_failed_samples) {
        inputs.prepass = false;
        return {
            "--prepass auto is off: with multisampling this CPU device also shades fragments that fail the "
            "depth test"};
    }
    const PrepassChoice choice =
        choosePrepass(measureOverdraw(inputs, static_cast<std::uint32_t>(settings.size.width),
                                      static_cast<std::uint32_t>(settings.size.height)),
                      lightsAtPixel(inputs), inputs.device.profile());
    inputs.prepass = choice.on;
    return {choice.because};
}

}  // namespace diptych
