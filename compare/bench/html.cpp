// SPDX-License-Identifier: MIT
#include "compare/bench/bench.h"
#include "compare/bench/conclusion.h"
#include "compare/bench/growth.h"
#include "compare/bench/sample_table.h"
#include "compare/bench/style.h"
#include "compare/page/page.h"
#include "compare/page/text.h"
#include "shared/text/counted.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace diptych::bench {

using page::bytes;
using page::markup;

namespace {

std::string cell(const std::string& text) {
    return "<td>" + markup(text) + "</td>";
}
std::string wholeCell(const std::string& text) {
    return "<td class=\"whole\">" + markup(text) + "</td>";
}
std::string numberCell(const std::string& text) {
    return "<td class=\"n\">" + markup(text) + "</td>";
}

std::string head(std::initializer_list<std::pair<const char*, bool>> columns) {
    std::string out = "<div class=\"box scroll rows\"><table class=\"stack\"><thead><tr>";
    for (const auto& [name, isNumber] : columns)
        out += fmt::format("<th{}>{}</th>", isNumber ? " class=\"n\"" : "", markup(name));
    return out + "</tr></thead>\n<tbody>";
}

// The row's notes that other rows lack.
std::vector<std::string> ownNotes(const BenchRow& row, const std::vector<std::string>& common) {
    std::vector<std::string> own;
    for (const std::string& note : row.notes)
        if (std::ranges::count(common, note) == 0) own.push_back(note);
    return own;
}

// ", 1e+06 triangles" with --table growth.
std::string grownTo(const BenchRow& row) {
    return row.growth ? fmt::format(", {:.6g} {}", row.growth->value, nameOf(row.growth->axis)) : "";
}

std::string rows(const Bench& bench) {
    if (bench.rows.empty()) return {};
    const std::vector<std::string> common = commonNotes(bench);
    std::string out = "<h2>Every mode</h2>\n" + head({{"lights", true},
                                                      {"size", true},
                                                      {"path", false},
                                                      {"assign", false},
                                                      {"ms", true},
                                                      {"min", true},
                                                      {"max", true},
                                                      {"assign ms", true},
                                                      {"share", true},
                                                      {"memory", true},
                                                      {"passes, ms", false},
                                                      {"notes", false}});
    for (const BenchRow& row : bench.rows) {
        std::string passes;
        for (const PassTime& pass : row.passes)
            passes += fmt::format("{}{} {:.3g}", passes.empty() ? "" : ", ", pass.name, pass.ms);
        out += "<tr>" + numberCell(fmt::format("{}", row.counters.lights)) +
               numberCell(fmt::format("{}x{}", row.settings.size.width, row.settings.size.height)) +
               cell(std::string(nameOf(row.settings.path)) + grownTo(row)) +
               cell(assignLabel(row.settings.assign, row.parts)) + numberCell(msText(row.time.median)) +
               numberCell(msText(row.time.min)) + numberCell(msText(row.time.max)) +
               numberCell(fmt::format("{:.3g}", assignMs(row))) +
               numberCell(fmt::format("{:.1f} %", 100 * assignShare(row))) +
               numberCell(bytes(row.bytes.images + row.bytes.buffers)) + wholeCell(passes) +
               wholeCell(fmt::format("{}", fmt::join(ownNotes(row, common), "; "))) + "</tr>\n";
    }
    out += "</tbody></table></div>\n";
    if (hasAnotherPicture(bench)) out += fmt::format("<p class=\"soft\">{}</p>\n", starMeans);
    return out;
}

// The conclusions, at the top of the page.
std::string conclusions(const Bench& bench) {
    const std::vector<Conclusion> all = conclusionsOf(bench);
    if (all.empty()) return {};
    std::string out = "<div class=\"box says\"><ul>";
    for (const Conclusion& conclusion : all) out += fmt::format("<li>{}</li>", markup(conclusion.inWords()));
    return out + "</ul></div>\n";
}

std::string skips(const Bench& bench) {
    if (bench.skips.empty()) return {};
    std::string out = "<h2>Not timed, and why</h2>\n<div class=\"box skips\"><dl>";
    for (const BenchSkip& skip : bench.skips)
        out += fmt::format("<dt>{}</dt><dd>{}</dd>", markup(skipName(skip)), markup(skip.reason));
    return out + "</dl></div>\n";
}

std::string kernels(const Bench& bench) {
    if (!bench.kernels) return {};
    const KernelReport& report = *bench.kernels;
    std::string out =
        fmt::format(
            "<h2>One listed point light at one pixel</h2>\n<p class=\"soft\">Nanoseconds per light and "
            "pixel: the difference between lists of {} and {} out of {} lights, {}x{}, {}, {}</p>\n",
            report.short_list, report.long_list, report.lights, report.size.width, report.size.height,
            counted(static_cast<std::uint64_t>(report.runs), "interleaved run"),
            counted(static_cast<std::uint64_t>(report.threads), "thread")) +
        head({{"kernel", false}, {"ns", true}, {"ratio to CPU", true}, {"goal", true}});
    for (const KernelRow& row : report.rows)
        out += "<tr>" + wholeCell(row.name) + numberCell(fmt::format("{:.3f}", row.ns)) +
               numberCell(row.ratio ? fmt::format("{:.2f}", *row.ratio) : "") +
               numberCell(row.goal ? fmt::format("at most {:.1f}", *row.goal) : "") + "</tr>\n";
    out += "</tbody></table></div>\n";
    for (const std::string& note : report.notes) out += "<p class=\"soft\">" + markup(note) + "</p>\n";
    return out;
}

std::string how(const Bench& bench) {
    std::string out =
        "<h2>How it was measured</h2>\n<div class=\"box how\"><ul><li>Time is the median over whole frames, "
        "not split into passes, from culling to linear lit. It includes making the light lists; the scene is "
        "already uploaded. Min and max are of single frames, and so are the ends of bars.</li><li>All modes "
        "and sizes of one light count are interleaved, one frame of each per round, so a device that slows "
        "down affects all alike.</li><li>Pass times are medians over as many other frames, with each pass "
        "timed by itself. The share is the fraction of pass time that makes light lists.</li><li>The ratio "
        "of two modes is the median over frames of the same round. Its interval comes from a sign test, "
        "which holds for any distribution of times.</li>";
    for (const std::string& note : commonNotes(bench)) out += "<li>" + markup(note) + "</li>";
    return out + "</ul></div>\n<footer><p><a href=\"bench.json\">bench.json</a>" +
           (bench.rows.empty() ? "" : " <a href=\"bench.svg\">bench.svg</a>") + "</p></footer>\n";
}

}  // namespace

std::string benchHtml(const Bench& bench) {
    return fmt::format(
        "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
        "content=\"width=device-width, initial-scale=1\"><title>Diptych: times, "
        "{0}</title>\n<style>{1}{2}{3}</style></head>\n<body>\n<a class=\"skip\" href=\"#rows\">Skip to the "
        "table</a><header><p class=\"brand\">Diptych</p><h1>Times side by side: <bdi>{0}</bdi></h1><p "
        "class=\"soft\">{4} of {5} each on {6} ({7})</p></header>\n{8}{15}{9}<div "
        "id=\"rows\">{10}</div>{11}{12}{13}<script>{14}</script></body></html>\n",
        markup(bench.scene), page::style, plotStyle, benchStyle, counted(bench.rows.size(), "row"),
        counted(static_cast<std::uint64_t>(bench.runs), "frame"), markup(bench.device.name),
        markup(bench.device.driver), conclusions(bench),
        bench.rows.empty() ? ""
                           : "<div class=\"box drawn\">" + benchPlot(bench, PlotPlace::page) + "</div>\n",
        rows(bench), kernels(bench), skips(bench), how(bench), page::tables,
        bench.options.table == BenchTable::growth ? growthHtml(bench) : sampleTablesHtml(bench));
}

}  // namespace diptych::bench
