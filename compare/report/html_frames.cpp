// SPDX-License-Identifier: MIT
#include "compare/output/writers.h"
#include "compare/report/html.h"
#include "compare/report/titles.h"
#include "shared/text/json.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace diptych {

using page::bytes;
using page::markup;

namespace {

std::string bar(double value, double top, char which) {
    return fmt::format("<i class=\"bar {}\" style=\"width:{:.2f}%\"></i>", which,
                       top > 0 ? 100 * value / top : 0);
}

std::string hostRow(const char* what, double ms) {
    return fmt::format("<tr><td colspan=\"2\" class=\"soft\">{}</td><td class=\"n soft\">{:.2f}</td></tr>",
                       what, ms);
}

std::string times(const Frame& a, const Frame& b) {
    double top = 0;
    for (const Frame* frame : {&a, &b}) {
        top = std::max(top, frame->time.median);
        for (const PassTime& pass : frame->passes) top = std::max(top, pass.ms);
    }
    if (!(top > 0)) return "<div class=\"box\"><h4>Time</h4><p class=\"soft\">not timed</p></div>\n";
    std::string out = "<div class=\"box\"><h4>Time, ms</h4><div class=\"scroll\"><table>";
    for (const auto& [frame, which] : {std::pair{&a, 'a'}, {&b, 'b'}}) {
        const FrameTime& time = frame->time;
        out += fmt::format(
            "<tr><td><b>{}</b></td><td class=\"bars\">{}</td><td class=\"n\"><b>{:.2f}</b></td></tr>",
            markup(frame->name), bar(time.median, top, which), time.median);
        for (const PassTime& pass : frame->passes)
            out += fmt::format(
                "<tr><td class=\"soft\">{}</td><td class=\"bars\">{}</td><td class=\"n\">{:.2f}</td></tr>",
                markup(pass.name), bar(pass.ms, top, which), pass.ms);
        out += fmt::format("<tr><td colspan=\"3\" class=\"soft wide\">{}</td></tr>",
                           time.runs == 1 ? "one run"
                                          : fmt::format("median of {} runs, {:.2f} to {:.2f}", time.runs,
                                                        time.min, time.max));
        out += hostRow("command recording, host", time.record);
        if (time.object_lists > 0) out += hostRow("light selection per object, host", time.object_lists);
    }
    return out +
           "</table></div><p class=\"soft\">Whole frames are timed without profiling, both paths "
           "interleaved. Passes are medians of separate, profiled runs and need not add up to a frame. Host "
           "times are not included.</p></div>\n";
}

std::string costs(const Frame& a, const Frame& b) {
    std::string out = fmt::format(
        "<div class=\"box\"><h4>Memory and counters</h4><div class=\"scroll\"><table><tr><th></th><th "
        "class=\"n\">{}</th><th class=\"n\">{}</th></tr>",
        markup(a.name), markup(b.name));
    const auto row = [&](const char* name, const auto& value) {
        out += fmt::format("<tr><td>{}</td><td class=\"n\">{}</td><td class=\"n\">{}</td></tr>", name,
                           value(a), value(b));
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
        row("shadow pages replaced by a coarser level", [](const Frame& f) {
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
    return out + "</table></div></div>\n";
}

std::string settings(const Frame& a, const Frame& b) {
    using Json = nlohmann::ordered_json;
    const Json left = parseOrderedJson(toJson(a.settings)), right = parseOrderedJson(toJson(b.settings));
    output::Table table{
        .columns = {{""}, {.title = a.name, .style = "mono wide"}, {.title = b.name, .style = "mono wide"}},
        .style = "",
        .box = "scroll"};
    const auto text = [](const Json& json) {
        return json.dump(-1, ' ', false, Json::error_handler_t::replace);
    };
    for (const auto& [key, value] : left.items()) {
        const Json& other = right.at(key);
        table.rows.push_back({{output::Span(key, output::Span::name), text(value), text(other)},
                              value == other ? "" : "differs"});
    }
    return "<details class=\"box settings\"><summary><b>Settings</b> <span class=\"soft\">all; differences "
           "are "
           "coloured</span></summary>" +
           inHtml(table) + "</details>\n";
}

std::string camera(const Report& report, const Frame& frame) {
    const FrameCamera& c = frame.camera;
    const std::string lens =
        c.fov_degrees > 0 ? fmt::format("{:.4g}\u00b0 vertical", c.fov_degrees) : "orthographic";
    return fmt::format(
        "<p class=\"soft camera\">Scene {}. Camera {}{}: eye {:.5g}, {:.5g}, {:.5g}; target {:.5g}, {:.5g}, "
        "{:.5g}; {}; near {:.4g}, far {:.4g} m</p>\n",
        page::isolated(frame.scene), page::isolated(viewTitle(report, frame)),
        c.choice.empty() ? "" : fmt::format(" ({})", page::isolated(c.choice)), c.eye[0], c.eye[1], c.eye[2],
        c.target[0], c.target[1], c.target[2], lens, c.near, c.far);
}

// The corrections of an external renderer's input.
std::string grantsOf(const FrameOrigin& origin) {
    return origin.granted.empty()
               ? std::string("external renderer, no corrections")
               : fmt::format("external renderer, corrections: {}", fmt::join(origin.granted, "; "));
}

// The files of images not rendered in this run, and the devices of a cross-device comparison.
std::string origins(const Frame& a, const Frame& b) {
    std::string rows;
    for (const Frame* frame : {&a, &b}) {
        const FrameOrigin& origin = frame->origin;
        if (origin.file.empty() && origin.device.empty()) continue;
        rows += fmt::format("<tr><td>{}</td><td class=\"mono wide\">{}</td><td class=\"wide\">{}</td></tr>",
                            markup(frame->name), markup(origin.file),
                            markup(origin.external         ? grantsOf(origin)
                                   : origin.device.empty() ? ""
                                   : origin.file.empty() ? fmt::format("{}, {}", origin.device, origin.driver)
                                                         : fmt::format("{}, {}, commit {}", origin.device,
                                                                       origin.driver, origin.commit)));
    }
    if (rows.empty()) return {};
    return (a.origin.file.empty() && b.origin.file.empty()
                ? "<div class=\"box scroll\"><h4>Devices</h4><table>"
                : "<div class=\"box scroll\"><h4>Files</h4><table>") +
           rows + "</table></div>\n";
}

}  // namespace

std::string frameTables(const Report& report, const Comparison& comparison) {
    const Frame &a = report.baseline(comparison), &b = report.test(comparison);
    const std::string files = origins(a, b);
    if (!a.origin.file.empty() && !b.origin.file.empty()) return files;
    return files + "<div class=\"columns\">" + times(a, b) + costs(a, b) + "</div>\n" + settings(a, b) +
           camera(report, b);
}

}  // namespace diptych
