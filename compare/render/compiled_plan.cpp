// SPDX-License-Identifier: MIT
#include "compare/render/compiled_plan.h"

#include "compare/frames/frame_properties.h"
#include "compare/render/prepared_view.h"
#include "shared/draw/pipeline_parts.h"
#include "shared/frame/debug_modes.h"
#include "shared/frame/supported_channels.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <utility>

namespace diptych {

namespace {

// Every channel that the path supports of a scene with these layers, and lit channels also through the
// encoding.
CaptureRequest everyChannel(const Settings& settings, gpu::uint layers) {
    CaptureRequest request;
    for (const DebugMode& mode : debugModes()) {
        if (!unsupportedReason(settings, mode).empty() || !mayShow(mode.channel, layers)) continue;
        request.modes.push_back(mode.channel);
        if (shadesFragments(settings.path) && isLit(mode.channel))
            request.through_gbuffer.push_back(mode.channel);
    }
    return request;
}

PipelineRequest without(PipelineRequest request, gpu::uint feature) {
    request.variant().set(feature, 0);
    if (feature == gpu::FEATURE_samples) {
        request.key.samples = VK_SAMPLE_COUNT_1_BIT;
        request.key.sample_shading = false;
    }
    return request;
}

struct Ablation {
    const FeatureRow* feature;
    std::size_t pipeline;  // the one compiled without the feature
};

// The heaviest pipeline of the frame with each feature. A depth-only draw is never the heaviest.
std::vector<Ablation> ablations(std::span<const PipelineRequest> requests,
                                std::span<const PlannedPipeline> pipelines) {
    std::vector<Ablation> all;
    for (const FeatureRow& row : featureRows) {
        if (!row.switches) continue;
        std::optional<std::size_t> heaviest;
        for (std::size_t i = 0; i < requests.size(); ++i) {
            const ShaderCost* const cost = pipelines[i].cost();
            if (cost == nullptr || requests[i].variant().get(row.id) == 0) continue;
            if (!heaviest || isHeavier(*cost, *pipelines[*heaviest].cost())) heaviest = i;
        }
        if (heaviest) all.push_back({&row, *heaviest});
    }
    return all;
}

bool isSame(const ShaderCost& a, const ShaderCost& b) {
    return std::ranges::all_of(shaderCostRows(),
                               [&](const ShaderCostRow& row) { return a.*row.value == b.*row.value; });
}

std::vector<FeatureCost> featureCosts(const DeviceCompiler& compiler,
                                      std::span<const PipelineRequest> requests,
                                      std::span<const PlannedPipeline> pipelines) {
    const std::vector<Ablation> all = ablations(requests, pipelines);
    std::vector<PipelineRequest> ablated;
    for (const Ablation& each : all) ablated.push_back(without(requests[each.pipeline], each.feature->id));
    const std::vector<CompiledPipeline> compiled = compiler.compile(ablated);
    std::vector<FeatureCost> costs;
    for (std::size_t i = 0; i < all.size(); ++i) {
        const PlannedPipeline& with = pipelines[all[i].pipeline];
        if (compiled[i].shaders.empty()) continue;
        const ShaderCost& rest = compiled[i].shaders.back().cost;
        if (!isSame(*with.cost(), rest))
            costs.push_back({all[i].feature->name, with.pass, with.name, *with.cost(), rest});
    }
    return costs;
}

// Also compiles a frame's light-evaluating pipelines without lights.
void addUnlitCycles(const DeviceCompiler& compiler, std::span<const PipelineRequest> requests,
                    std::span<PlannedPipeline> pipelines) {
    constexpr gpu::uint kinds[] = {gpu::FEATURE_directional_lights, gpu::FEATURE_point_lights,
                                   gpu::FEATURE_spot_lights, gpu::FEATURE_area_lights};
    std::vector<PipelineRequest> unlit;
    std::vector<std::size_t> of;
    for (std::size_t i = 0; i < requests.size(); ++i) {
        PipelineRequest request = requests[i];
        for (const gpu::uint kind : kinds)
            if (requests[i].variant().get(kind) != 0) request = without(std::move(request), kind);
        if (request.variant() == requests[i].variant()) continue;
        unlit.push_back(std::move(request));
        of.push_back(i);
    }
    const std::vector<CompiledPipeline> compiled = compiler.compile(unlit);
    for (std::size_t i = 0; i < of.size(); ++i)
        if (!compiled[i].shaders.empty())
            pipelines[of[i]].unlit_cycles = compiled[i].shaders.back().cost.cycles;
}

std::vector<PlannedPipeline> planned(const DeviceCompiler& compiler,
                                     std::span<const PipelineRequest> requests, bool captures) {
    std::vector<CompiledPipeline> compiled = compiler.compile(requests);
    std::vector<PlannedPipeline> all;
    for (std::size_t i = 0; i < requests.size(); ++i)
        all.push_back({requests[i].pass, captures, requests[i].name(), describe(requests[i].variant()),
                       std::move(compiled[i])});
    return all;
}

CompiledPath compilePath(Device& device, DeviceCompiler& compiler, SharedResources& shared,
                         const SceneView& scene, const Settings& settings) {
    compiler.takeRequests();
    PreparedFrame prepared(device, shared, scene, settings);
    const std::vector<PipelineRequest> frame = compiler.takeRequests();
    prepared.path.capture(prepared.passes, prepared.view.inputs, prepared.images,
                          everyChannel(settings, scene.needs.layers));
    std::vector<PipelineRequest> captures = compiler.takeRequests();
    std::erase_if(captures, [&](const PipelineRequest& request) {
        return std::ranges::any_of(frame, [&](const PipelineRequest& earlier) { return earlier == request; });
    });
    CompiledPath path{settings.path, planned(compiler, frame, false), {}, {}, {}};
    addUnlitCycles(compiler, frame, path.pipelines);
    path.features = featureCosts(compiler, frame, path.pipelines);
    std::ranges::move(planned(compiler, captures, true), std::back_inserter(path.pipelines));
    evaluate(path);
    return path;
}

}  // namespace

std::string describe(const Variant& variant) {
    std::vector<std::string> on;
    for (const FeatureRow& row : featureRows)
        if (const gpu::uint value = variant.get(row.id); value != 0)
            on.push_back(value == 1 ? row.name : fmt::format("{}={}", row.name, value));
    return fmt::format("{}", fmt::join(on, " "));
}

void evaluate(CompiledPath& path) {
    for (const PlannedPipeline& pipeline : path.pipelines) {
        const auto line = [&](const std::string& what) {
            return fmt::format("{}, {}: {} {}{}", nameOf(path.path), pipeline.pass, pipeline.name, what,
                               pipeline.variant.empty() ? "" : " (" + pipeline.variant + ")");
        };
        if (!pipeline.compiled.error.empty()) path.errors.push_back(line(pipeline.compiled.error));
        for (const CompiledShader& shader : pipeline.compiled.shaders) {
            const ShaderCost& cost = shader.cost;
            const double spilled = cost.spilled_vectors.value_or(0) + cost.spilled_scalars.value_or(0);
            if (spilled == 0 && cost.scratch_bytes.value_or(0) == 0) continue;
            path.warnings.push_back(line(
                fmt::format("{}spills {:.0f} vector and {:.0f} scalar registers, {:.0f} bytes of scratch",
                            shader.name == pipeline.name ? "" : "with " + shader.name + " ",
                            cost.spilled_vectors.value_or(0), cost.spilled_scalars.value_or(0),
                            cost.scratch_bytes.value_or(0))));
        }
    }
}

std::vector<CompiledPath> compilePaths(Device& device, DeviceCompiler& compiler, SceneViews& views,
                                       const std::vector<Settings>& settings) {
    SharedResources shared(device, views.scene(), std::make_shared<PipelineSet>(device, Creation::planned));
    std::vector<CompiledPath> paths;
    for (const Settings& s : settings) {
        checkSize(device, s.size);
        paths.push_back(compilePath(device, compiler, shared, views.at(viewRequest(s)), s));
    }
    return paths;
}

}  // namespace diptych
