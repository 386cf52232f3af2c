// SPDX-License-Identifier: MIT
#include "compare/bench/scene_plan.h"

#include "compare/bench/compiled_text.h"
#include "compare/bench/estimate.h"
#include "shared/text/counted.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace diptych::bench {
namespace {

using Json = nlohmann::ordered_json;

// Estimates for the compiler's GPU family, or for all GPUs without a compiler.
std::vector<FrameEstimate> estimatesOf(const ScenePlan& plan, const FrameWork& work) {
    std::vector<FrameEstimate> all;
    std::vector<PassCycles> cycles;
    for (const CompiledPath& path : plan.compiled)
        if (path.path == work.path) cycles = passCycles(path);
    for (const GpuRates& gpu : estimatedGpus())
        if (plan.compiler == nullptr || isOfFamily(gpu, plan.compiler->name))
            all.push_back(estimate(work, gpu, {}, cycles));
    return all;
}

Json workJson(const ScenePlan& plan, const FrameWork& work) {
    Json passes = Json::array(), estimates = Json::array();
    for (const PassWork& pass : work.passes)
        passes.push_back({{"name", pass.counts.name},
                          {"vertices", pass.counts.vertices},
                          {"triangles", pass.counts.triangles},
                          {"samples", pass.counts.samples},
                          {"fragments", pass.counts.fragments},
                          {"outputs", pass.counts.outputs},
                          {"compute", pass.counts.compute},
                          {"texels", pass.texels},
                          {"lights", pass.lights},
                          {"bytes_read", pass.counts.read},
                          {"bytes_written", pass.counts.written},
                          {"vertex_bytes", pass.vertex_bytes}});
    for (const FrameEstimate& estimate : estimatesOf(plan, work)) {
        Json each = Json::array();
        for (const PassEstimate& pass : estimate.passes)
            each.push_back({{"name", pass.name}, {"ms", pass.ms}, {"bound", pass.bound}});
        estimates.push_back({{"gpu", estimate.gpu->name}, {"ms", estimate.ms}, {"passes", each}});
    }
    return {{"path", nameOf(work.path)}, {"passes", passes}, {"estimates", estimates}};
}

std::string workText(const ScenePlan& plan, const FrameWork& work) {
    std::string text;
    text += fmt::format("  workload of {}\n    {:<26} {:>10} {:>10} {:>10} {:>10} {:>10} {:>10} {:>9}\n",
                        nameOf(work.path), "pass", "vertices", "triangles", "fragments", "texels", "lights",
                        "compute", "MB");
    for (const PassWork& pass : work.passes)
        text += fmt::format(
            "    {:<26} {:>10} {:>10} {:>10} {:>10.0f} {:>10.0f} {:>10} {:>9.2f}\n", pass.counts.name,
            pass.counts.vertices, pass.counts.triangles, pass.counts.fragments, pass.texels, pass.lights,
            pass.counts.compute,
            (static_cast<double>(pass.counts.read + pass.counts.written) + pass.vertex_bytes) * 1e-6);
    for (const FrameEstimate& estimate : estimatesOf(plan, work))
        text += fmt::format("    estimate, {}\n", describe(estimate));
    return text;
}

bool isDrawn(const ScenePlan& plan, std::size_t variant) {
    return static_cast<int>(variant) == plan.variant;
}

Json variantsJson(const ScenePlan& plan) {
    Json variants = Json::array();
    for (std::size_t i = 0; i < plan.variants.size(); ++i)
        variants.push_back({{"name", plan.variants[i]}, {"drawn", isDrawn(plan, i)}});
    return variants;
}

// "16 bytes per pixel, 48 with lit; with --msaa 4 96 and 176"
std::string bytesText(const PathPlan& path) {
    const SampledBytes& planned = path.bytes.front();
    std::string sentence = fmt::format("{} bytes per pixel, {} with lighting", planned.geometry, planned.all);
    for (const SampledBytes& other : path.bytes)
        if (other.samples != planned.samples)
            sentence += fmt::format("; {} and {} with --msaa {}", other.geometry, other.all, other.samples);
    return sentence;
}

}  // namespace

Json toJson(const ScenePlan& plan) {
    Json modelled = Json::array(), omitted = Json::array(), paths = Json::array();
    for (const auto& line : plan.lines)
        (line.modelled ? modelled : omitted).push_back({{"what", line.what}, {"why", line.why}});
    Json work = Json::array();
    for (const FrameWork& frame : plan.work) work.push_back(workJson(plan, frame));
    for (const PathPlan& path : plan.paths) {
        Json samples = Json::array();
        for (const SampledBytes& bytes : path.bytes)
            samples.push_back({{"samples", bytes.samples},
                               {"bytes_per_pixel", bytes.geometry},
                               {"bytes_per_sample", bytes.geometry / static_cast<unsigned>(bytes.samples)},
                               {"image_bytes_per_pixel", bytes.all}});
        paths.push_back({{"path", path.path},
                         {"passes", path.passes},
                         {"bytes_per_pixel", path.bytes.front().geometry},
                         {"samples", samples},
                         {"shared_bytes_per_pixel", path.shared_bytes_per_pixel},
                         {"triangles_in_view", path.drawn.in_view},
                         {"triangles_drawn", path.drawn.drawn},
                         {"vertices_drawn", path.drawn.vertices},
                         {"instances_drawn", path.drawn.instances},
                         {"draws", path.drawn.draws},
                         {"notes", path.notes}});
    }
    Json json{{"scene", plan.scene},
              {"draws", plan.needs.draws},
              {"triangles", plan.needs.triangles},
              {"materials", plan.needs.materials},
              {"textures", plan.needs.textures},
              {"lights", plan.needs.lights()},
              {"modelled", modelled},
              {"left_out", omitted},
              {"notes", plan.notes},
              {"variants", variantsJson(plan)},
              {"paths", paths},
              {"work", work}};
    if (plan.compiler != nullptr) json["compiled"] = compiledJson(plan.compiled, *plan.compiler);
    return json;
}

std::string describe(const ScenePlan& plan) {
    std::string text;
    const Requirements& needs = plan.needs;
    text += fmt::format("{}: {}, {}, {}, {}, {}\n", plan.scene, counted(needs.draws, "draw"),
                        counted(needs.triangles, "triangle"), counted(needs.materials, "material"),
                        counted(needs.textures, "texture"), counted(needs.lights(), "light"));
    for (const bool modelled : {true, false}) {
        text += fmt::format("  {}\n", modelled ? "modelled" : "left out");
        for (const auto& line : plan.lines)
            if (line.modelled == modelled) text += fmt::format("    {:<26} {}\n", line.what, line.why);
    }
    if (!plan.variants.empty())
        text += fmt::format("  material variants{}\n",
                            plan.variant < 0 ? "; none is drawn: primitives have their own materials" : "");
    for (std::size_t i = 0; i < plan.variants.size(); ++i)
        text += fmt::format("    {:<26} {}\n", fmt::format("{} {}", i, plan.variants[i]),
                            isDrawn(plan, i) ? "drawn" : fmt::format("--variant {} draws it", i));
    for (const PathPlan& path : plan.paths) {
        text += fmt::format(
            "  {}: {}; {}{}\n", path.path, fmt::join(path.passes, " > "), bytesText(path),
            path.shared_bytes_per_pixel > 0
                ? fmt::format("; images that share memory save {} more", path.shared_bytes_per_pixel)
                : "");
        text += fmt::format("    {} of {} triangles are in view; {} are drawn with {} and {}; vertices: {}\n",
                            path.drawn.in_view, needs.triangles, path.drawn.drawn,
                            counted(path.drawn.draws, "draw"), counted(path.drawn.instances, "instance"),
                            path.drawn.vertices);
        for (const std::string& line : path.notes) text += fmt::format("    {}\n", line);
    }
    if (plan.compiler != nullptr) text += compiledText(plan.compiled, *plan.compiler);
    for (const FrameWork& work : plan.work) text += workText(plan, work);
    for (const std::string& line : plan.notes) text += fmt::format("  note: {}\n", line);
    return text;
}

}  // namespace diptych::bench
