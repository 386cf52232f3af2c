// SPDX-License-Identifier: MIT
#include "compare/bench/bench.h"
#include "compare/frames/frame_properties.h"
#include "compare/page/text.h"
#include "compare/render/sample_counts.h"
#include "shared/text/counted.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <utility>

namespace diptych::bench {

using page::cameraTitle;

namespace {

// Minimum number of profiled frames.
constexpr int fewestProfiled = 3;

// First frames include driver compilation: only those slower than this factor times --max-ms are not
// repeated.
constexpr double compiling = 4;

BenchRow rowOf(const Bench& bench, const Settings& settings, const BenchGroup& group) {
    BenchRow row{{.scene = group.scene, .settings = settings},
                 group.lights,
                 partsOf(bench.options, settings),
                 group.growth,
                 group.cover};
    if (group.growth) {
        row.varied = nameOf(group.growth->axis);
        row.measured[Measure::magnitude] = group.growth->value;
    } else if (group.cover) {
        row.varied = group.cover->kind;
        row.measured[Measure::magnitude] = group.cover->percent;
    }
    return row;
}

void skip(Bench& bench, const Settings& settings, const BenchGroup& group, std::string reason) {
    bench.skips.push_back(rowOf(bench, settings, group));
    bench.skips.back().failed = std::move(reason);
}

bool isMode(const Settings& a, const Settings& b) {
    return a.path == b.path && a.assign == b.assign && a.size == b.size && a.transparency == b.transparency &&
           a.msaa == b.msaa && a.lighting == b.lighting && a.layers == b.layers;
}

// Reason to skip the Settings, based on smaller light counts or growth values; empty if they must be
// measured.
std::string hopeless(const Bench& bench, const BenchGroup& group, const Settings& settings) {
    if (group.growth) {
        for (const BenchRow& skip : bench.skips)
            if (skip.growth && skip.growth->axis == group.growth->axis && skip.settings.path == settings.path)
                return skip.point() + " were too many already";
        return {};
    }
    if (!group.lights) return {};
    for (const BenchRow& skip : bench.skips)
        if (isMode(skip.settings, settings) && skip.cover == group.cover && skip.requested_lights &&
            *skip.requested_lights < *group.lights)
            return fmt::format("already over --max-ms {:.6g} with {}", bench.options.max_ms,
                               counted(*skip.requested_lights, "light"));
    std::vector<std::pair<std::uint32_t, double>> measured;
    for (const BenchRow& row : bench.rows)
        if (row.requested_lights && row.cover == group.cover && isMode(row.settings, settings))
            measured.emplace_back(*row.requested_lights, row[Measure::ms]);
    const std::optional<double> predicted = predictedMs(measured, *group.lights);
    if (!predicted || *predicted <= bench.options.max_ms) return {};
    return fmt::format("would take about {} ms (estimated from {} and {} lights), over --max-ms {:.6g}",
                       msText(*predicted), measured[measured.size() - 2].first, measured.back().first,
                       bench.options.max_ms);
}

// Reason to skip: the device or the scene does not support these Settings; empty if both do.
std::string omissionReason(const Settings& settings, const Requirements& needs,
                           std::span<const int> samples) {
    if (std::ranges::find(samples, settings.msaa) == samples.end())
        return fmt::format("the device does not support {} samples per pixel", settings.msaa);
    if (!needs.alpha_blend && (needs.layers & gpu::LAYER_TRANSMISSION) == 0 &&
        settings.transparency != Transparency::off)
        return "no surface of the scene blends or transmits light";
    return {};
}

// The group's Settings that are worth measuring; the others become skips.
std::vector<Settings> triedSettings(Device& device, const BenchGroup& group, const Requirements& needs,
                                    Bench& bench) {
    const std::vector<int> samples = sampleCounts(device);
    std::vector<Settings> tried;
    for (const Settings& settings : group.settings) {
        std::string reason;
        if (bench.options.table == BenchTable::msaa) reason = omissionReason(settings, needs, samples);
        if (reason.empty()) reason = hopeless(bench, group, settings);
        if (reason.empty())
            tried.push_back(settings);
        else
            skip(bench, settings, group, std::move(reason));
    }
    return tried;
}

// Empty if the device's limits are reached, as --table growth is meant to do; then all become skips.
std::optional<PreparedFrames> preparedFrames(Renderer& renderer, const BenchGroup& group,
                                             const std::vector<Settings>& tried, Bench& bench) {
    try {
        return renderer.prepare(tried);
    } catch (const std::runtime_error& error) {
        if (!group.growth) throw;
        for (const Settings& settings : tried) skip(bench, settings, group, error.what());
        return {};
    }
}

}  // namespace

double passMs(const BenchRow& row, std::string_view prefix) {
    double ms = 0;
    for (const PassTime& pass : row.passes)
        if (pass.name.starts_with(prefix)) ms += pass.ms;
    return ms;
}

double assignFraction(const BenchRow& row) {
    const double all = passMs(row);
    return all > 0 ? passMs(row, "assign") / all : 0;
}

std::string msText(double ms) {
    return ms < 1000 ? fmt::format("{:.4g}", ms) : fmt::format("{:.0f}", ms);
}

std::string describeTime(const BenchRow& row) {
    return fmt::format("{} ({} to {})", msText(row[Measure::ms]), msText(row[Measure::ms_min]),
                       msText(row[Measure::ms_max]));
}

bool isHopeless(const Bench& bench, const BenchGroup& group) {
    return group.growth && std::ranges::none_of(group.settings, [&](const Settings& settings) {
               return hopeless(bench, group, settings).empty();
           });
}

void measureGroup(Device& device, const std::shared_ptr<PipelineSet>& pipelines, const BenchGroup& group,
                  const Scene& scene, Bench& bench, const Stage& progress) {
    SceneViews views(scene);
    const Requirements needs = views.at(viewRequest(group.settings.front())).needs;
    const std::vector<Settings> tried = triedSettings(device, group, needs, bench);
    if (tried.empty()) return;
    Renderer renderer(device, views, pipelines);
    std::optional<PreparedFrames> prepared = preparedFrames(renderer, group, tried, bench);
    if (!prepared) return;
    PreparedFrames& frames = *prepared;
    const int profiled = std::max(bench.runs, fewestProfiled);
    const double steps = static_cast<double>(frames.size()) * (1 + bench.runs + profiled);
    double done = 0;
    const auto step = [&](std::size_t i, const std::string& what) {
        progress.at(done++ / steps,
                    fmt::format("{} {}", modeName(tried[i], partsOf(bench.options, tried[i])), what));
    };
    std::vector<std::size_t> timed;  // indices into `frames`
    for (std::size_t i = 0; i < frames.size(); ++i) {
        step(i, "first frame");
        double ms = frames.draw(i);
        if (ms > bench.options.max_ms && ms < compiling * bench.options.max_ms) ms = frames.draw(i);
        if (ms <= bench.options.max_ms)
            timed.push_back(i);
        else
            skip(bench, tried[i], group,
                 fmt::format("its first frame took {} ms, over --max-ms {:.6g}", msText(ms),
                             bench.options.max_ms));
    }
    std::vector<TimedFrame> times = timeInterleaved(frames, timed, bench.runs, profiled, step);
    for (std::size_t k = 0; k < timed.size(); ++k) {
        const std::size_t i = timed[k];
        const Frame frame = frames.frame(i);
        BenchRow row = rowOf(bench, tried[i], group);
        row.camera = cameraTitle(frame);
        row.ms = std::move(times[k].ms);
        row.passes = std::move(times[k].passes);
        row.measured.set(times[k].time);
        row.measured[Measure::record_ms] = times[k].time.record;
        row.measured[Measure::lists_ms] = times[k].time.object_lists;
        row.measured.set(frame.bytes);
        row.measured.set(frame.counters);
        row.warnings = frame.notes;
        bench.rows.push_back(std::move(row));
    }
}

}  // namespace diptych::bench
