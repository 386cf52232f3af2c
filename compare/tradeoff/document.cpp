// SPDX-License-Identifier: MIT
// A sweep for terminal, page and folder.
#include "compare/tradeoff/tradeoff.h"

#include "compare/files/listed_folder.h"
#include "compare/files/output.h"
#include "compare/output/writers.h"
#include "compare/page/text.h"
#include "compare/tradeoff/page/page.h"
#include "compare/tradeoff/plot.h"
#include "compare/tradeoff/tables.h"
#include "shared/image/png.h"
#include "shared/text/counted.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace diptych::tradeoff {

using output::Block;
using output::Heading;
using output::Paragraph;
using output::Span;
using page::markup;
using page::number;

namespace {

std::string hiddenUnless(bool shown) {
    return shown ? "" : " hidden";
}

std::string again(const char* what, const std::string& command) {
    return inHtml(output::Paragraph{{what, Span(command, Span::command)}, "again"});
}

std::string rangeText(const CameraRange& range) {
    return range.low < range.value || range.high > range.value
               ? fmt::format("{} ({} to {})", number(range.value), number(range.low), number(range.high))
               : number(range.value);
}

std::string switches() {
    std::string out =
        "<div class=\"switches\"><span class=\"soft chooses\">Error</span><span class=\"buttons chooses\">";
    for (std::size_t i = 0; i < errorMetrics.size(); ++i)
        out += fmt::format(
            "<button type=\"button\" data-shows=\"{}\" aria-pressed=\"{}\"{} title=\"{}\">{}</button>",
            errorMetrics[i].name, i == 0, i == 0 ? " class=\"on\"" : "", markup(errorMetrics[i].means),
            markup(errorMetrics[i].title));
    return out +
           "</span><span class=\"soft\">A filled mark with its row's number is on the Pareto front: no other "
           "row is both faster and closer to the reference. A bar spans all timed frames and "
           "cameras.</span></div>\n";
}

// Joins markup for every error; the page's buttons show one of them.
template <class MarkupOf>
std::string ofErrors(const MarkupOf& markupOf) {
    std::string out;
    for (std::size_t metric = 0; metric < errorMetrics.size(); ++metric)
        out += fmt::format("<div data-figure=\"{}\"{}>{}</div>", errorMetrics[metric].name,
                           hiddenUnless(metric == 0), markupOf(metric));
    return out;
}

std::string plotsOf(const Tradeoff& tradeoff, std::optional<Path> path) {
    return ofErrors(
        [&](std::size_t metric) { return tradeoffPlot(tradeoff, metric, path, PlotTarget::page); });
}

std::string images(const Tradeoff& tradeoff, const TradeoffRow& row) {
    std::string out = "<div class=\"pictures\">";
    for (const auto& [file, words] : {std::pair{row.image, "lit"},
                                      {tradeoff.reference_image, "reference"},
                                      {row.errors_map, "FLIP: black 0, pale 1"}})
        out += fmt::format(
            "<figure><img loading=\"lazy\" src=\"{}\" alt=\"{}\"><figcaption>{}</figcaption></figure>",
            markup(file), words, words);
    return out + "</div>";
}

std::string card(const Tradeoff& tradeoff, std::size_t index, bool shown) {
    const TradeoffRow& row = tradeoff.rows[index];
    std::string out = fmt::format(
        "<article class=\"row-card\" data-row=\"{0}\"{1}><h3>{2}</h3><p class=\"soft\">row "
        "{0}</p>{3}<dl><dt>time, ms</dt><dd>{4:.4g} ({5:.4g} to {6:.4g})</dd>",
        index + 1, hiddenUnless(shown), markup(describe(row, tradeoff.requested)), images(tradeoff, row),
        row[Measure::ms], row[Measure::ms_min], row[Measure::ms_max]);
    for (std::size_t metric = 0; metric < errorMetrics.size(); ++metric)
        out += fmt::format("<dt>{}</dt><dd>{}</dd>", markup(errorMetrics[metric].title),
                           rangeText(cameraRangeOf(row, errorMeasure(metric))));
    out += fmt::format("<dt>memory</dt><dd>{}</dd>", inHtml(cellOf(row, Measure::memory).text));
    for (const PassTime& pass : row.passes)
        out += fmt::format("<dt>{}</dt><dd>{:.3g} ms</dd>", markup(pass.name), pass.ms);
    out += "</dl>";
    for (const std::string& warning : row.warnings)
        out += fmt::format("<p class=\"warn\">{}</p>", markup(warning));
    const std::string comparing = comparingCommand(tradeoff, row);
    return out + again("Measure this row again", measuringCommand(tradeoff, row)) +
           (row.renderer.empty() ? again("Draw its picture", renderingCommand(tradeoff, row)) : "") +
           (comparing.empty() ? "" : again("Compare its errors with the other path's", comparing)) +
           "</article>\n";
}

std::string plots(const Tradeoff& tradeoff) {
    const std::vector<std::size_t> front = frontOf(tradeoff, 0);
    const std::size_t first = front.empty() ? 0 : front.front();
    std::string out = "<div class=\"plots\"><div class=\"drawn\"><div class=\"box\">" +
                      plotsOf(tradeoff, {}) + "</div><div class=\"front\">" +
                      ofErrors([&](std::size_t metric) { return inHtml(frontTable(tradeoff, metric)); }) +
                      "</div><div class=\"each\">";
    for (const Path path : pathsOf(tradeoff))
        out += fmt::format("<div class=\"box\"><h3>{}</h3>{}</div>", nameOf(path), plotsOf(tradeoff, path));
    out += "</div></div><div class=\"box\">";
    for (std::size_t i = 0; i < tradeoff.rows.size(); ++i) out += card(tradeoff, i, i == first);
    return out + "</div></div>\n";
}

// A line for each error.
output::List frontList(const Tradeoff& tradeoff) {
    output::List list;
    for (std::size_t metric = 0; metric < errorMetrics.size(); ++metric) {
        std::vector<std::size_t> numbers;
        for (const std::size_t row : frontOf(tradeoff, metric)) numbers.push_back(row + 1);
        list.items.emplace_back(fmt::format(
            "Pareto front of time and {}: {}", errorMetrics[metric].title,
            numbers.empty()
                ? "none"
                : fmt::format("row{} {}", numbers.size() == 1 ? "" : "s", fmt::join(numbers, ", "))));
    }
    return list;
}

// Sentences on the cost of the sweep and on drift of the device's speed.
std::vector<std::string> howItWent(const Tradeoff& tradeoff) {
    std::vector<std::string> lines;
    const SweepCost& cost = tradeoff.cost;
    lines.push_back(fmt::format("It took {:.1f} s, {:.1f} s of which to draw and time the rows",
                                cost.whole / 1e3, cost.drawing / 1e3));
    if (tradeoff.resumed_rows > 0)
        lines.push_back(fmt::format("{} of {} rows come from an interrupted run and keep its times",
                                    tradeoff.resumed_rows, tradeoff.rows.size()));
    if (const std::optional<CameraRange> drift = driftOf(tradeoff))
        lines.push_back(
            fmt::format("Frames timed after all rows were drawn, in random order, took {:.3g} times as long "
                        "as each row's first frames ({:.3g} to {:.3g} for single rows): a smaller difference "
                        "between two rows may be chance",
                        drift->value, drift->low, drift->high));
    return lines;
}

std::string measuredHow(const Tradeoff& tradeoff) {
    const char* const blocks =
        tradeoff.runs > 1
            ? "Each row is timed in several blocks: one when it is drawn, more in later rounds over all rows "
              "in random order, interleaved as far as their images fit into memory. A temporary disturbance "
              "of the device thus affects all rows alike. A row's time is the mean of its blocks' medians"
            : "Each row has one timed frame";
    return fmt::format(
        "Time is that of a whole frame, not split into passes, from culling to linear lit, with the scene "
        "already uploaded. One uncounted frame comes first. {}; with several cameras, the mean over them. "
        "Pass times come from a separate, profiled run.",
        blocks);
}

// Blocks after the rows: fronts, tables, warnings, skips, notes.
std::vector<Block> resultBlocks(const Tradeoff& tradeoff) {
    std::vector<Block> blocks{{frontList(tradeoff), Block::terminal}};
    for (const auto& tables : {shadowBlocks(tradeoff), sampleBlocks(tradeoff)})
        blocks.insert(blocks.end(), tables.begin(), tables.end());
    output::List warnings{{}, ""}, went{{}, "box how"};
    for (std::size_t i = 0; i < tradeoff.rows.size(); ++i)
        for (const std::string& warning : tradeoff.rows[i].warnings)
            warnings.items.emplace_back(fmt::format("row {}: {}", i + 1, warning));
    if (!warnings.items.empty())
        blocks.insert(blocks.end(), {{Heading{2, "Warnings"}, Block::terminal}, {warnings, Block::terminal}});
    output::Terms skips{{}, "box skips"};
    for (const SkipGroup& group : groupsOf(tradeoff.skips))
        skips.items.emplace_back(group.reason, fmt::format("{}", fmt::join(group.tried, ", ")));
    if (!skips.items.empty()) blocks.insert(blocks.end(), {Heading{2, "Not drawn, and why"}, skips});
    blocks.insert(
        blocks.end(),
        {Heading{2, "How it was measured"},
         {output::List{{measuredHow(tradeoff),
                        "Errors are those of linear lit over the pixels that show a surface in the "
                        "reference: the mean HDR-FLIP, and the root mean square and 99th percentile of "
                        "|t-r| / max(|r|, 1e-3 of the mean luminance). Pixels of all cameras count equally.",
                        "A row of another size is resized bilinearly to the reference's size. A resized "
                        "pixel is background if its nearest source pixel is."},
                       "box how"},
          Block::page}});
    for (const std::vector<std::string>& lines : {howItWent(tradeoff), tradeoff.notes})
        went.items.insert(went.items.end(), lines.begin(), lines.end());
    if (driftOf(tradeoff))
        blocks.push_back({output::List{{"Times above are from each row's first timing block; times in the "
                                        "files are from all its frames"}},
                          Block::terminal});
    blocks.emplace_back(went);
    return blocks;
}

}  // namespace

std::string frontsText(const Tradeoff& tradeoff) {
    return output::inText({frontList(tradeoff)});
}

std::string tradeoffEnd(const Tradeoff& tradeoff) {
    return inText(resultBlocks(tradeoff));
}

void checkTradeoffHtml(std::string_view page) {
    output::checkPage(page, tradeoffStyle, tradeoffScript);
}

std::string tradeoffHtml(const Tradeoff& tradeoff) {
    const Size& size = tradeoff.requested.size;
    std::vector<std::string> cameras;
    for (const experiment::Row& camera : tradeoff.rows.front().cameras) cameras.push_back(camera.camera);
    output::Document page{
        .title = "time against error, " + tradeoff.scene,
        .heading = {"Time against error: ", Span(tradeoff.scene, Span::foreign)},
        .about = {fmt::format("{} at {}x{} on {} ({}), {} each; ", counted(tradeoff.rows.size(), "row"),
                              size.width, size.height, tradeoff.device.name, tradeoff.device.driver,
                              counted(static_cast<std::uint64_t>(tradeoff.runs), "timed frame")),
                  Span(fmt::format("{}", fmt::join(cameras, "; ")), Span::foreign),
                  "; errors of lit against the reference"},
        .blocks = {output::Drawing{switches() + plots(tradeoff)},
                   output::Box{"", {Heading{2, "Every row"}, sweepTable(tradeoff)}, "rows"}},
        .files = {"tradeoff.json", "tradeoff.csv", experiment::rowsFile},
        .style = tradeoffStyle,
        .script = tradeoffScript,
        .skip = "rows"};
    for (std::size_t f = 0; f < errorMetrics.size(); ++f) page.files.push_back(plotName(f, {}));
    for (Block& block : resultBlocks(tradeoff)) page.blocks.push_back(std::move(block));
    return inHtml(page);
}

std::string writeTradeoff(const Tradeoff& measured, const std::filesystem::path& path,
                          const std::filesystem::path& kept, const Image8& reference, bool force) {
    ListedFolder folder(path, tradeoffManifest, force);
    Tradeoff tradeoff = measured;
    for (std::size_t i = 0; i < tradeoff.rows.size(); ++i)
        for (const auto& [member, name] :
             {std::pair{&TradeoffRow::image, fmt::format("row-{:03}.png", i + 1)},
              {&TradeoffRow::errors_map, fmt::format("row-{:03}.flip.png", i + 1)}}) {
            linkOrCopy(kept, tradeoff.rows[i].*member, folder / name);
            tradeoff.rows[i].*member = name;
            folder.list(name);
        }
    tradeoff.reference_image = "reference.png";
    writePng(folder / tradeoff.reference_image, reference);
    folder.list(tradeoff.reference_image);
    for (std::size_t metric = 0; metric < errorMetrics.size(); ++metric) {
        folder.put(plotName(metric, {}), tradeoffPlot(tradeoff, metric, {}, PlotTarget::file));
        for (const Path one : pathsOf(tradeoff))
            folder.put(plotName(metric, one), tradeoffPlot(tradeoff, metric, one, PlotTarget::file));
    }
    folder.put("tradeoff.csv", inCsv(csvTable(tradeoff)));
    folder.put(experiment::rowsFile, inCsv(experiment::rowsTable(experiment::pointersTo(tradeoff.rows))));
    folder.put("index.html", tradeoffHtml(tradeoff));
    return folder.finish(tradeoffJson(tradeoff));
}

}  // namespace diptych::tradeoff
