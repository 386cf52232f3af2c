// SPDX-License-Identifier: MIT
// The page of a report, and what a terminal shows of it.
#include "compare/report/document.h"

#include "compare/output/writers.h"
#include "compare/page/page.h"
#include "compare/report/titles.h"
#include "compare/report/trends.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace diptych {

using output::Block;
using output::Box;
using output::Heading;
using output::Paragraph;
using output::Span;
using output::Text;
using page::inFolder;

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

std::string deviceText(const ReportDevice& device) {
    return fmt::format("{} ({}), {}", device.name, device.type, device.driver);
}

// The line below the heading names scene, view, size, encoding and devices.
Text aboutOf(const Report& report, const ReportLayout& layout, const ReportTexts& texts) {
    Text about;
    if (report.comparisons.size() == 1) {
        const Frame& frame = report.baseline(report.comparisons[0]);
        about.spans = {
            {titleOf(report, layout, report.comparisons[0]), Span::foreign},
            fmt::format(" \u00b7 {}\u00d7{}", frame.settings.size.width, frame.settings.size.height)};
        if (!report.device.name.empty())
            about.spans.emplace_back(
                fmt::format(" \u00b7 {} G-buffer \u00b7 ", nameOf(frame.settings.gbuffer)));
    }
    std::string devices;
    for (const DrawnOn& one : texts.devices)
        if (!one.device.name.empty()) devices += (devices.empty() ? "" : "; ") + deviceText(one.device);
    if (!report.against.name.empty()) devices += "; and " + deviceText(report.against);
    about.spans.emplace_back(devices);
    return about;
}

// A box with the first of the items, if there are any; `elsewhere`: where to find the others.
void addBox(std::vector<Block>& blocks, const char* style, const std::string& heading,
            std::vector<Text> items, const std::string& elsewhere) {
    constexpr std::size_t max = 40;
    if (items.empty()) return;
    const std::size_t left = items.size() - std::min(items.size(), max);
    items.resize(items.size() - left);
    if (left > 0)
        items.emplace_back(Span(fmt::format("and {} more: {}", left, elsewhere), Span::plain, "soft"));
    blocks.emplace_back(Box{style, {Heading{4, heading}, output::List{std::move(items)}}});
}
constexpr const char* inJson = "report.json has all of them";

// Begins with "builtin:gallery \u00b7 entrance: ", if there are several comparisons.
Text itemOf(const Report& report, const ReportLayout& layout, const Comparison& comparison,
            std::initializer_list<Span> spans) {
    Text text;
    if (report.comparisons.size() > 1)
        text.spans = {{titleOf(report, layout, comparison), Span::foreign}, ": "};
    text.spans.insert(text.spans.end(), spans);
    return text;
}

// The failures of all comparisons. Channels of a single comparison have their cards here.
void addFailures(std::vector<Block>& blocks, const Report& report, const ReportLayout& layout) {
    std::vector<Text> items;
    std::vector<Block> outputs;  // of external renderers before they failed
    for (const auto* unpaired : {&report.errors, &report.failures})
        for (const SceneError& error : *unpaired) {
            items.emplace_back(errorText(error));
            if (!error.output.empty())
                outputs.emplace_back(Box{"said",
                                         {Paragraph{Span(error.output, Span::foreign)}},
                                         "",
                                         {"output of ", Span(error.renderer, Span::foreign)}});
        }
    for (const std::size_t i : layout.order) {
        const Comparison& comparison = report.comparisons[i];
        for (const std::string& failure : comparison.failures)
            items.push_back(itemOf(report, layout, comparison, {failure}));
        for (const ChannelDiff& channel : comparison.channels)
            if (channel.verdict == Verdict::fail && report.comparisons.size() > 1)
                items.push_back(itemOf(report, layout, comparison,
                                       {cardLink(layout.ids[i], *channel.mode), ": ", channel.reason}));
    }
    addBox(blocks, "box failures", "Failures", std::move(items),
           "the comparisons below start with the failed ones");
    blocks.insert(blocks.end(), outputs.begin(), outputs.end());
}

void addWarnings(std::vector<Block>& blocks, const Report& report, const ReportLayout& layout) {
    std::vector<Text> items;
    for (const std::size_t i : layout.order)
        for (const ChannelDiff& channel : report.comparisons[i].channels)
            if (!channel.warning.empty())
                items.push_back(itemOf(report, layout, report.comparisons[i],
                                       {cardLink(layout.ids[i], *channel.mode), ": ", channel.warning}));
    addBox(blocks, "box notes", "Warnings", std::move(items), inJson);
}

// Links to the visual checks: a feature may be wrong in both paths and still pass.
void addCheckLinks(std::vector<Block>& blocks, const Report& report, const ReportLayout& layout) {
    std::vector<Text> items;
    for (const std::size_t i : layout.order)
        if (const std::string line = checksLine(report.comparisons[i]); !line.empty())
            items.push_back(itemOf(report, layout, report.comparisons[i],
                                   {{line.substr(0, line.find(':')), Span::link, "#eye-" + layout.ids[i]},
                                    line.substr(line.find(':'))}));
    addBox(blocks, "box notes", "Both paths may be wrong in the same way", std::move(items),
           "each comparison lists its own");
}

std::vector<Text> textsIn(const std::vector<std::string>& lines) {
    return {lines.begin(), lines.end()};
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

// With --single-file, later sections are text; the browser parses one only when it is opened.
std::string laterSections(const ReportLayout& layout, const ReportTexts& texts) {
    std::string out;
    if (layout.single_file)
        for (std::size_t at = comparisonsInPage; at < layout.order.size(); ++at)
            out += fmt::format("<script type=\"text/plain\" id=\"section-{}\">{}</script>\n",
                               layout.order[at], texts.section(layout.order[at]));
    return out;
}

std::string sectionHtml(const Report& report, const ReportLayout& layout, std::size_t index) {
    return inHtml(
        Box{"comparison", comparisonBlocks(report, &layout, index), fmt::format("s{}", layout.ids[index])});
}

}  // namespace

std::string sectionTitle(const Report& report, const ReportLayout& layout, std::size_t index) {
    return report.comparisons.size() > 1 ? titleOf(report, layout, report.comparisons[index]) : "";
}

ReportTexts textsOf(const Report& report, const ReportLayout& layout) {
    ReportTexts texts;
    texts.devices.push_back(drawnOn(report, &layout));
    for (const Comparison& comparison : report.comparisons)
        texts.rows.push_back(indexRowOf(report, comparison));
    for (std::size_t i = 0; i < report.closer_paths.size(); ++i)
        texts.closer_boxes.push_back(inHtml(closerPathBlocks(report, &layout, i, false)));
    texts.section = [&](std::size_t index) { return sectionHtml(report, layout, index); };
    return texts;
}

std::string reportHtml(const Report& report, const ReportLayout& layout, const ReportTexts& texts) {
    const std::size_t count = report.comparisons.size();
    const char* const verdict = report.passed() && report.errors.empty() ? "pass" : "fail";
    const std::string line = verdictLine(report);
    output::Document page{.title = line,
                          .heading = {Span(verdict, Span::verdict, verdict),
                                      count == 1 ? pairTitle(report, report.comparisons[0])
                                                 : fmt::format("{} comparisons", count)},
                          .about = aboutOf(report, layout, texts),
                          .blocks = {},
                          .files = {"report.json", "junit.xml"},
                          .script = page::script,
                          .skip = "sections",
                          .finding = line};
    std::vector<Block>& blocks = page.blocks;
    addBox(blocks, "box notes", "Read first", textsIn(report.first_notes), inJson);
    addFailures(blocks, report, layout);
    if (texts.since)
        addBox(blocks, "box notes since", "Since " + texts.since->report,
               textsIn(trendLines(*texts.since, report)), inJson);
    addWarnings(blocks, report, layout);
    if (!report.closer_paths.empty()) blocks.emplace_back(Heading{2, "Against the reference"});
    for (std::size_t i = 0; i < report.closer_paths.size(); ++i) {
        const Frame& reference = report.frames[report.closer_paths[i].reference];
        Box box{"box closer", {}};
        if (report.closer_paths.size() > 1)
            box.blocks.emplace_back(Heading{3,
                                            {Span(inFolder(reference.scene, layout.folder), Span::foreign),
                                             " \u00b7 ", Span(viewTitle(report, reference), Span::foreign)}});
        box.blocks.emplace_back(output::Drawing{texts.closer_boxes[i]});
        blocks.emplace_back(box);
    }
    for (const Block& block : indexBlocks(report, layout, texts)) blocks.push_back(block);
    std::string sections;
    for (std::size_t at = 0; at < std::min(layout.order.size(), comparisonsInPage); ++at)
        sections += texts.section(layout.order[at]);
    blocks.emplace_back(Box{"", {output::Drawing{std::move(sections)}}, "sections"});
    blocks.emplace_back(output::Drawing{laterSections(layout, texts)});
    addCheckLinks(blocks, report, layout);
    std::vector<Text> notes;
    for (const auto& [about, note] : notesWithScenes(report, layout.folder))
        notes.push_back({Span(about.empty() ? "" : about + ": ", Span::foreign), Span(note, Span::foreign)});
    addBox(blocks, "box notes", "Notes", std::move(notes), inJson);
    blocks.emplace_back(output::Drawing{legend});
    blocks.emplace_back(Paragraph{
        fmt::format("{} files. Statistics are computed on linear float32 channels, before any colour map. "
                    "They exclude background pixels. Percentiles are nearest-rank.",
                    layout.files().size()),
        "soft small"});
    return inHtml(page);
}

std::string sectionScript(const Report& report, const ReportLayout& layout, std::size_t index) {
    const std::string id = layout.part ? nlohmann::json(layout.sections[index]).dump() : layout.ids[index];
    return fmt::format("diptychSection({},{});\n", id,
                       nlohmann::json(sectionHtml(report, layout, index))
                           .dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
}

}  // namespace diptych
