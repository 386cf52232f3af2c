// SPDX-License-Identifier: MIT
#include "compare/report/html.h"

#include "compare/output/writers.h"
#include "compare/page/page.h"
#include "compare/report/channel_table.h"
#include "compare/report/folders.h"
#include "compare/report/policy.h"
#include "compare/report/titles.h"
#include "compare/report/trends.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace diptych {

using page::inFolder;
using page::isolated;
using page::markup;

namespace {

std::string titleOf(const Report& report, const ReportLayout& layout, const Comparison& comparison) {
    if (report.device.name.empty())  // two files
        return inFolder(report.test(comparison).origin.file, layout.folder) + " against " +
               inFolder(report.baseline(comparison).origin.file, layout.folder);
    const Frame& left = report.baseline(comparison);
    const Frame& frame = left.origin.file.empty() ? left : report.test(comparison);
    std::string title =
        fmt::format("{} \u00b7 {}", inFolder(frame.scene, layout.folder), viewTitle(report, frame));
    // The pair distinguishes comparisons of one scene, camera and time.
    if (hasMultiplePairs(report)) title += " \u00b7 " + pairTitle(report, comparison);
    return title;
}

std::string header(const Report& report, const ReportLayout& layout, const ReportTexts& texts) {
    const char* verdict = report.passed() && report.errors.empty() ? "pass" : "fail";
    const std::size_t count = report.comparisons.size();
    const std::string title =
        count == 1 ? pairTitle(report, report.comparisons[0]) : fmt::format("{} comparisons", count);
    std::string drawn;
    if (count == 1) {
        const Frame& frame = report.baseline(report.comparisons[0]);
        drawn = fmt::format("{} \u00b7 {}\u00d7{}", isolated(titleOf(report, layout, report.comparisons[0])),
                            frame.settings.size.width, frame.settings.size.height);
        if (!report.device.name.empty())
            drawn += fmt::format(" \u00b7 {} G-buffer \u00b7 ", nameOf(frame.settings.gbuffer));
    }
    std::string devices;
    for (const DrawnOn& one : texts.devices)
        if (!one.device.name.empty())
            devices += fmt::format("{}{} ({}), {}", devices.empty() ? "" : "; ", one.device.name,
                                   one.device.type, one.device.driver);
    if (!report.against.name.empty())
        devices +=
            fmt::format("; and {} ({}), {}", report.against.name, report.against.type, report.against.driver);
    drawn += markup(devices);
    return fmt::format(
        "<header><p class=\"brand\">Diptych</p><h1><span class=\"verdict "
        "{0}\">{0}</span>{1}</h1><p>{3}</p><p class=\"soft\">{2}</p></header>\n",
        verdict, markup(title), drawn, markup(verdictLine(report)));
}

double total(const ReportTexts& texts, double DrawnOn::*ms) {
    double sum = 0;
    for (const DrawnOn& one : texts.devices) sum += one.*ms;
    return sum;
}

std::string listBox(const char* style, const char* heading, const std::string& items) {
    return items.empty() ? ""
                         : fmt::format("<section class=\"box {}\"><h4>{}</h4><ul>{}</ul></section>\n", style,
                                       heading, items);
}

// "builtin:gallery \u00b7 entrance: ", if there are several comparisons.
std::string whereOf(const Report& report, const ReportLayout& layout, const Comparison& comparison) {
    return report.comparisons.size() > 1 ? isolated(titleOf(report, layout, comparison)) + ": " : "";
}

// The first of `items` as a list, then the number of the rest and where to find them.
std::string firstOf(const std::vector<std::string>& items, const char* elsewhere) {
    constexpr std::size_t most = 40;
    std::string out;
    for (std::size_t i = 0; i < std::min(items.size(), most); ++i) out += "<li>" + items[i] + "</li>";
    if (items.size() > most)
        out += fmt::format("<li class=\"soft\">and {} more: {}</li>", items.size() - most, elsewhere);
    return out;
}

std::string firstNotes(const Report& report) {
    std::vector<std::string> items;
    for (const std::string& line : report.first_notes) items.push_back(markup(line));
    return listBox("notes", "Read first", firstOf(items, "report.json has all of them"));
}

// An external renderer's output before it failed, collapsed.
std::string saidBefore(const SceneError& error) {
    if (error.output.empty()) return {};
    return fmt::format("<details><summary>output of {}</summary><pre>{}</pre></details>",
                       isolated(error.renderer), isolated(error.output));
}

// The failures of all comparisons. Channels of a single comparison have their cards here.
std::string failures(const Report& report, const ReportLayout& layout) {
    std::vector<std::string> items;
    for (const auto* unpaired : {&report.errors, &report.failures})
        for (const SceneError& error : *unpaired)
            items.push_back(markup(errorText(error)) + saidBefore(error));
    for (const std::size_t i : layout.order) {
        const Comparison& comparison = report.comparisons[i];
        const std::string where = whereOf(report, layout, comparison);
        for (const std::string& failure : comparison.failures) items.push_back(where + markup(failure));
        for (const ChannelDiff& channel : comparison.channels)
            if (channel.verdict == Verdict::fail && report.comparisons.size() > 1)
                items.push_back(fmt::format("{}{}: {}", where, cardLink(layout.ids[i], *channel.mode),
                                            markup(channel.reason)));
    }
    return listBox("failures", "Failures",
                   firstOf(items, "the comparisons below start with the failed ones"));
}

std::string warnings(const Report& report, const ReportLayout& layout) {
    std::vector<std::string> items;
    for (const std::size_t i : layout.order)
        for (const ChannelDiff& channel : report.comparisons[i].channels)
            if (!channel.warning.empty())
                items.push_back(fmt::format("{}{}: {}", whereOf(report, layout, report.comparisons[i]),
                                            cardLink(layout.ids[i], *channel.mode), markup(channel.warning)));
    return listBox("notes", "Warnings", firstOf(items, "report.json has all of them"));
}

// Each note once, with its scenes if there are several.
std::string notes(const Report& report, const ReportLayout& layout) {
    std::vector<std::string> all, items;
    for (const Comparison& comparison : report.comparisons) {
        const std::string& scene = report.baseline(comparison).scene;
        if (std::ranges::count(all, scene) == 0) all.push_back(scene);
    }
    for (const GroupedNote& note : groupedNotes(report)) {
        std::vector<std::string> names;
        for (const std::string& scene : note.scenes) names.push_back(inFolder(scene, layout.folder));
        const std::string about =
            all.size() == 1 ? ""
            : names.size() == all.size()
                ? fmt::format("{} scenes{}: ", all.size(), note.varies ? ", with different numbers" : "")
                : fmt::format("{}{}: ", listed(names, 3), note.varies ? ", with different numbers" : "");
        items.push_back(fmt::format("<b>{}</b>{}", isolated(about), isolated(note.text)));
    }
    return listBox("notes", "Notes", firstOf(items, "report.json has all of them"));
}

// Links to the visual checks: a feature may be wrong in both paths and still pass.
std::string checksLinks(const Report& report, const ReportLayout& layout) {
    std::vector<std::string> items;
    for (const std::size_t i : layout.order) {
        const Comparison& comparison = report.comparisons[i];
        const std::string line = checksLine(comparison);
        if (line.empty()) continue;
        const std::size_t colon = line.find(':');
        items.push_back(fmt::format("{}<a href=\"#eye-{}\">{}</a><span class=\"soft\">{}</span>",
                                    whereOf(report, layout, comparison), layout.ids[i],
                                    markup(line.substr(0, colon)), markup(line.substr(colon))));
    }
    return listBox("notes", "Both paths may be wrong in the same way",
                   firstOf(items, "each comparison lists its own"));
}

std::string sinceBox(const Report& report, const ReportTexts& texts) {
    if (!texts.since) return {};
    std::string items;
    for (const std::string& line : trendLines(*texts.since, report)) items += "<li>" + markup(line) + "</li>";
    return fmt::format("<section class=\"box notes since\"><h4>Since {}</h4><ul>{}</ul></section>\n",
                       markup(texts.since->report), items);
}

// The keys and gestures that compare/page/gestures.js handles.
constexpr const char* legend =
    "<details class=\"keys box\"><summary>Keys and gestures</summary><dl><dt><kbd>1</kbd> "
    "<kbd>2</kbd></dt><dd>only the left, right picture</dd><dt><kbd>w</kbd> <kbd>s</kbd> "
    "<kbd>f</kbd></dt><dd>wipe, side by side, flicker (again or Esc: stop)</dd><dt><kbd>+</kbd> <kbd>-</kbd> "
    "<kbd>0</kbd></dt><dd>zoom in, out, fit</dd><dt>arrows</dt><dd>move the wipe, or a zoomed picture; with "
    "Shift in larger steps</dd><dt><kbd>n</kbd> <kbd>p</kbd></dt><dd>next, previous worst "
    "pixel</dd><dt>drag</dt><dd>moves the wipe, or a zoomed picture</dd><dt>wheel, "
    "pinch</dt><dd>zoom; the wheel needs a click in the picture or Ctrl</dd></dl><p "
    "class=\"soft\">Keys act on the card last under the pointer; arrows need a click in the "
    "picture.</p></details>\n";

std::string footer(const Report& report, const ReportLayout& layout, const ReportTexts& texts) {
    const std::string several =
        report.comparisons.size() > 1 ? fmt::format("; {} files in all", layout.files().size()) : "";
    return fmt::format(
        "<footer><p><a href=\"report.json\">report.json</a><a "
        "href=\"junit.xml\">junit.xml</a>{}</p><p>compared in {:.0f} ms, pictures, values and EXRs encoded "
        "in {:.0f} ms. Statistics are computed on linear float32 channels, before any colour map. They "
        "exclude background pixels. Percentiles are nearest-rank.</p></footer>\n",
        several, total(texts, &DrawnOn::compare_ms), total(texts, &DrawnOn::encode_ms));
}

std::string exrLinks(const ReportLayout& layout, const Comparison& comparison) {
    std::string links;
    for (const std::size_t frame : {comparison.baseline, comparison.test})
        if (!layout.exr[frame].empty())
            links += fmt::format(" <a href=\"{0}\">{0}</a>", markup(layout.exr[frame]));
    if (links.empty()) return {};
    return "<p class=\"soft camera\">Every channel as float32:" + links + "</p>\n";
}

// `map`: the path of the map of causes; empty: none.
std::string explanation(const Comparison& comparison, const std::string& map) {
    if (!comparison.explained) return {};
    return inHtml(comparison.explained->blocks) + (map.empty() ? "" : inHtml(causeMap(map)));
}

}  // namespace

std::string sectionTitle(const Report& report, const ReportLayout& layout, std::size_t index) {
    return report.comparisons.size() > 1 ? markup(titleOf(report, layout, report.comparisons[index])) : "";
}

std::string section(const Report& report, const ReportLayout& layout, std::size_t index) {
    const Comparison& comparison = report.comparisons[index];
    return fmt::format("<section class=\"comparison\" id=\"s{}\"><h2>{}</h2>\n", layout.ids[index],
                       layout.part ? std::string(titleLater) : sectionTitle(report, layout, index)) +
           leadingCards(report, layout, index) + "<h2>Channels</h2>\n" +
           inHtml(channelTable(comparison, layout.ids[index])) +
           explanation(comparison, layout.source(layout.cause_maps[index])) +
           otherCards(report, layout, index) + checksSection(report, layout, index) +
           "<h2>What was compared</h2>\n" + frameTables(report, comparison) + exrLinks(layout, comparison) +
           "</section>\n";
}

namespace {

// With --single-file, later sections are text; the browser parses one only when it is opened.
std::string laterSections(const ReportLayout& layout, const ReportTexts& texts) {
    std::string out;
    if (layout.single_file)
        for (std::size_t at = comparisonsInPage; at < layout.order.size(); ++at)
            out += fmt::format("<script type=\"text/plain\" id=\"section-{}\">{}</script>\n",
                               layout.order[at], texts.section(layout.order[at]));
    return out;
}

}  // namespace

std::string cardLink(const std::string& comparison, const DebugMode& mode) {
    return fmt::format("<a href=\"#{}\">{}</a>", cardId(comparison, mode), markup(mode.name));
}

ReportTexts textsOf(const Report& report, const ReportLayout& layout) {
    ReportTexts texts;
    texts.devices.push_back(drawnOn(report, &layout));
    for (const Comparison& comparison : report.comparisons)
        texts.rows.push_back(indexRowOf(report, comparison));
    for (std::size_t i = 0; i < report.closer_paths.size(); ++i)
        texts.closer_boxes.push_back(closerPathBox(report, layout, i));
    texts.section = [&](std::size_t index) { return section(report, layout, index); };
    return texts;
}

std::string reportHtml(const Report& report, const ReportLayout& layout) {
    return reportHtml(report, layout, textsOf(report, layout));
}

std::string reportHtml(const Report& report, const ReportLayout& layout, const ReportTexts& texts) {
    std::string body = header(report, layout, texts) + firstNotes(report) + failures(report, layout) +
                       sinceBox(report, texts) + warnings(report, layout) +
                       closerPathSection(report, layout, texts) + indexTable(report, layout, texts) +
                       "<div id=\"sections\">\n";
    for (std::size_t at = 0; at < std::min(layout.order.size(), comparisonsInPage); ++at)
        body += texts.section(layout.order[at]);
    body += "</div>\n" + laterSections(layout, texts) + checksLinks(report, layout) + notes(report, layout) +
            legend;
    const std::string script = std::string(page::tables) + page::script;
    return fmt::format(
        "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">{}<meta name=\"viewport\" "
        "content=\"width=device-width, initial-scale=1\"><title>Diptych: "
        "{}</title>\n<style>{}</style></head>\n<body>\n<a class=\"skip\" href=\"#sections\">Skip to the "
        "channels</a>{}{}<script>{}</script>\n</body></html>\n",
        pagePolicy(script), markup(verdictLine(report)), page::style, body, footer(report, layout, texts),
        script);
}

std::string sectionScript(const Report& report, const ReportLayout& layout, std::size_t index) {
    using Json = nlohmann::json;
    return fmt::format(
        "diptychSection({},{});\n", layout.part ? Json(layout.sections[index]).dump() : layout.ids[index],
        Json(section(report, layout, index)).dump(-1, ' ', false, Json::error_handler_t::replace));
}

}  // namespace diptych
