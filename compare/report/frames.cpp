// SPDX-License-Identifier: MIT
// The Frames of a comparison: origin, times, memory, Settings and camera.
#include "compare/report/document.h"
#include "compare/report/titles.h"
#include "shared/text/counted.h"
#include "shared/text/json.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace diptych {

using output::Block;
using output::Box;
using output::Column;
using output::Heading;
using output::Paragraph;
using output::Span;
using output::Table;
using page::bytes;

namespace {

// The file of an image not rendered in this run, and what made it.
std::string fileLine(const Frame& frame) {
    const FrameOrigin& origin = frame.origin;
    std::string line = fmt::format("{}: {}", frame.name, origin.file);
    if (origin.external)
        line += origin.corrections.empty() ? ", external renderer, no corrections"
                                           : fmt::format(", external renderer, corrections: {}",
                                                         fmt::join(origin.corrections, "; "));
    else if (!origin.device.empty())
        line += fmt::format(", on {}, {}, commit {}", origin.device, origin.driver, origin.commit);
    return line;
}

std::string lineOf(const Frame& frame) {
    if (!frame.origin.file.empty()) return fileLine(frame);
    if (isReference(frame.settings.path))
        return fmt::format("{}: double precision, mode {}, rendered in {:.3g} s", frame.name,
                           nameOf(frame.settings.reference_mode), frame.made_in_ms / 1000);
    std::string line = frame.name;
    if (frame.time.runs > 0)
        line += fmt::format(": {:.4g} ms ({:.4g} to {:.4g}, {})", frame.time.median, frame.time.min,
                            frame.time.max, counted(frame.time.runs, "run"));
    if (frame.time.object_lists > 0)
        line +=
            fmt::format(", {:.3g} ms on the host to choose each object's lights", frame.time.object_lists);
    if (!frame.origin.device.empty())
        line += fmt::format(", on {}, {}", frame.origin.device, frame.origin.driver);
    return line + fmt::format(", {} bytes per pixel of {}", frame.bytes.gbuffer_per_pixel,
                              hasGBuffer(frame.settings.path) ? "G-buffer and depth" : "depth");
}

Box times(const Frame& a, const Frame& b) {
    double top = 0;
    for (const Frame* frame : {&a, &b}) {
        top = std::max(top, frame->time.median);
        for (const PassTime& pass : frame->passes) top = std::max(top, pass.ms);
    }
    if (!(top > 0)) return {"box", {Heading{4, "Time"}, Paragraph{"not timed", "soft"}}};
    Table table{.columns = {{"frame and passes"}, {.title = "", .style = "bars"}, {"ms", Column::number}},
                .style = "",
                .box = "scroll",
                .note =
                    "Whole frames are timed without profiling, both paths interleaved. Passes are medians "
                    "of separate, profiled runs and need not add up to a frame. Host times are not "
                    "included."};
    for (const auto& [frame, which] : {std::pair{&a, 'a'}, {&b, 'b'}}) {
        const auto add = [&, kind = which](const Span& name, double ms, Span::Kind weight) {
            const std::string bar =
                fmt::format("<i class=\"bar {}\" style=\"width:{:.2f}%\"></i>", kind, 100 * ms / top);
            table.rows.push_back({{name, Span(bar, Span::drawn), Span(fmt::format("{:.2f}", ms), weight)}});
        };
        add(Span(frame->name, Span::strong), frame->time.median, Span::strong);
        for (const PassTime& pass : frame->passes)
            add(Span(pass.name, Span::plain, "soft"), pass.ms, Span::plain);
    }
    return {"box", {Heading{4, "Time"}, table}};
}

Box costs(const Frame& a, const Frame& b) {
    Table table{
        .columns = {{""}, {a.name, Column::number}, {b.name, Column::number}}, .style = "", .box = "scroll"};
    const auto row = [&](const char* name, const auto& value) {
        table.rows.push_back({{name, value(a), value(b)}});
    };
    const auto count = [&](const char* name, std::uint64_t FrameCounters::*counter) {
        row(name, [counter](const Frame& f) { return fmt::format("{}", f.counters.*counter); });
    };
    row("images", [](const Frame& f) { return bytes(f.bytes.images); });
    row("buffers", [](const Frame& f) { return bytes(f.bytes.buffers); });
    row("G-buffer and depth per pixel", [](const Frame& f) { return bytes(f.bytes.gbuffer_per_pixel); });
    count("lights", &FrameCounters::lights);
    count("overflowed light lists", &FrameCounters::overflowed_lists);
    if (a.counters.shadow_pages.requested + b.counters.shadow_pages.requested > 0)
        row("shadow pages, and those replaced by a coarser level", [](const Frame& f) {
            return fmt::format("{}, {}", f.counters.shadow_pages.requested, f.counters.shadow_pages.fallback);
        });
    if (a.counters.unsorted.fragments + b.counters.unsorted.fragments > 0)
        row("blended fragments that did not fit in a list, and their pixels", [](const Frame& f) {
            return fmt::format("{}, {}", f.counters.unsorted.fragments, f.counters.unsorted.pixels);
        });
    row("flux that the light cutoff removes from lights without a range",
        [](const Frame& f) { return fmt::format("{:.3g} %", 100 * f.counters.energy_cut); });
    count("NaN or infinite lit pixels", &FrameCounters::nonfinite_pixels);
    row("pixels that a second run changed", [](const Frame& f) {
        std::uint64_t pixels = 0;
        for (const auto& [mode, noise] : f.noise) pixels = std::max(pixels, noise.pixels);
        return f.noise.empty() ? std::string("not run") : fmt::format("{}", pixels);
    });
    count("pixels the capture did not reproduce", &FrameCounters::unreproduced_pixels);
    return {"box", {Heading{4, "Memory and counters"}, table}};
}

Box settings(const Frame& a, const Frame& b) {
    const nlohmann::ordered_json left = parseOrderedJson(toJson(a.settings)),
                                 right = parseOrderedJson(toJson(b.settings));
    Table table{
        .columns = {{""}, {.title = a.name, .style = "mono wide"}, {.title = b.name, .style = "mono wide"}},
        .style = "",
        .box = "scroll"};
    const auto text = [](const nlohmann::ordered_json& json) {
        return json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
    };
    for (const auto& [key, value] : left.items()) {
        const auto& other = right.at(key);
        table.rows.push_back(
            {{Span(key, Span::name), text(value), text(other)}, value == other ? "" : "differs"});
    }
    return {"box settings",
            {table},
            "",
            {Span("Settings ", Span::strong), Span("all; differences are coloured", Span::plain, "soft")}};
}

Paragraph camera(const Report& report, const Frame& frame) {
    const FrameCamera& c = frame.camera;
    const std::string lens =
        c.fov_degrees > 0 ? fmt::format("{:.4g}\u00b0 vertical", c.fov_degrees) : "orthographic";
    output::Text text{"Scene ", Span(frame.scene, Span::foreign), ". Camera ",
                      Span(viewTitle(report, frame), Span::foreign)};
    if (!c.choice.empty()) text.spans.insert(text.spans.end(), {" (", Span(c.choice, Span::foreign), ")"});
    text.spans.emplace_back(fmt::format(
        ": eye {:.5g}, {:.5g}, {:.5g}; target {:.5g}, {:.5g}, {:.5g}; {}; near {:.4g}, far {:.4g} m",
        c.eye[0], c.eye[1], c.eye[2], c.target[0], c.target[1], c.target[2], lens, c.near, c.far));
    return {text, "soft camera"};
}

}  // namespace

output::List frameLines(const Frame& baseline, const Frame& test) {
    return {{Span(lineOf(baseline), Span::foreign), Span(lineOf(test), Span::foreign)}, "box says"};
}

void addFrames(std::vector<Block>& blocks, const Report& report, const Comparison& comparison) {
    const Frame &a = report.baseline(comparison), &b = report.test(comparison);
    blocks.emplace_back(frameLines(a, b));
    if (!a.origin.file.empty() && !b.origin.file.empty()) return;
    blocks.insert(blocks.end(),
                  {Box{"columns", {times(a, b), costs(a, b)}}, settings(a, b), camera(report, b)});
}

}  // namespace diptych
