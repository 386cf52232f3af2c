// SPDX-License-Identifier: MIT
// Both paths' errors against the reference and their difference from each other: which path has the lower
// error, where, and by how much.
#include "compare/report/html.h"
#include "compare/report/titles.h"

#include <fmt/format.h>

namespace diptych {

using page::isolated;
using page::markup;
using page::number;

namespace {

std::string cell(const std::string& text, bool best) {
    return fmt::format("<td class=\"n\">{}{}{}</td>", best ? "<b>" : "", text, best ? "</b>" : "");
}

// One metric of both paths and of their difference; the lower error is bold.
template <class Value>
std::string row(const char* name, const CloserPathChannel& channel, const Value& value) {
    const double first = value(channel.paths[0]), second = value(channel.paths[1]);
    return fmt::format("<tr><td class=\"soft\">{}</td>{}{}{}</tr>", name, cell(number(first), first < second),
                       cell(number(second), second < first), cell(number(value(channel.between)), false));
}

std::string figures(const Report& report, const CloserPath& closer) {
    const auto name = [&](std::size_t k) { return markup(report.frames[closer.paths[k]].name); };
    const std::string reference = markup(report.frames[closer.reference].name);
    std::string out = fmt::format(
        "<div class=\"scroll\"><table><tr><th>errors</th><th class=\"n\">{}</th><th class=\"n\">{}</th>"
        "<th class=\"n\">between them</th></tr>",
        name(0), name(1));
    for (const CloserPathChannel& channel : closer.channels) {
        out += fmt::format("<tr><td colspan=\"4\"><b>{}</b></td></tr>", channel.mode->name);
        out += row("mean", channel, [](const PathError& error) { return error.stats.mean; });
        out += row("p99", channel, [](const PathError& error) { return error.stats.p99; });
        out += row("p99.9", channel, [](const PathError& error) { return error.stats.p999; });
        out += row("max", channel, [](const PathError& error) { return error.stats.max; });
        out += row("relative RMSE", channel, [](const PathError& error) { return error.relative_rmse; });
        out += row("FLIP", channel, [](const PathError& error) { return error.flip.value_or(0); });
    }
    return out + fmt::format(
                     "</table></div><p class=\"soft\">Each path's error against the {}; the smaller one in "
                     "bold. Between them: {} against {}.</p>\n",
                     reference, name(1), name(0));
}

std::string materials(const Report& report, const CloserPath& closer, const CloserPathChannel& channel) {
    if (channel.materials.empty() || channel.closer < 0) return {};
    const auto name = [&](std::size_t k) { return markup(report.frames[closer.paths[k]].name); };
    std::string out = fmt::format(
        "<div class=\"scroll\"><table><tr><th>{} by material</th><th class=\"n\">pixels</th><th "
        "class=\"n\">{}</th>"
        "<th class=\"n\">{}</th></tr>",
        page::breakable(std::string(channel.mode->name)), name(0), name(1));
    for (const MaterialError& m : channel.materials)
        out += fmt::format(
            "<tr><td class=\"wide\">{} <span class=\"soft\">{}</span></td><td class=\"n\">{}</td>{}{}</tr>",
            m.id, markup(m.name), m.pixels, cell(number(m.mean[0]), m.mean[0] < m.mean[1]),
            cell(number(m.mean[1]), m.mean[1] < m.mean[0]));
    return out +
           "</table></div><p class=\"soft\">Mean errors. The materials that add most to the difference of "
           "the paths (mean times pixels) come first.</p>\n";
}

std::string picture(const Report& report, const ReportLayout& layout, const CloserPath& closer,
                    std::size_t index, std::size_t channel) {
    const std::string& file = layout.closer_paths[index][channel];
    if (file.empty()) return {};
    return fmt::format(
        "<figure><img class=\"whole\" loading=\"lazy\" src=\"{}\" alt=\"which path is closer, pixel by "
        "pixel\">"
        "<figcaption><span><i class=\"swatch first\"></i>{} closer</span><span><i class=\"swatch "
        "second\"></i>{} "
        "closer</span><span>{}: brightness is the difference of the errors, full at "
        "{}</span></figcaption></figure>\n",
        layout.source(file), markup(report.frames[closer.paths[0]].name),
        markup(report.frames[closer.paths[1]].name), closer.channels[channel].mode->name,
        number(closerPathTop(closer.channels[channel].apart)));
}

}  // namespace

std::string closerPathBox(const Report& report, const ReportLayout& layout, std::size_t index) {
    const CloserPath& closer = report.closer_paths[index];
    std::string lines;
    for (const CloserPathChannel& channel : closer.channels)
        lines += "<li>" + markup(closerPathLine(closer, channel, report.frames)) + "</li>";
    std::string out = "<ul>" + lines + "</ul>\n<div class=\"columns\">\n";
    if (!closer.channels.empty())
        out += "<div>" + picture(report, layout, closer, index, 0) +
               materials(report, closer, closer.channels.front()) + "</div>\n";
    return out + "<div>" + figures(report, closer) + "</div></div>";
}

std::string closerPathSection(const Report& report, const ReportLayout& layout, const ReportTexts& texts) {
    if (report.closer_paths.empty()) return {};
    std::string out = "<h2 id=\"reference\">Against the reference</h2>\n";
    for (std::size_t i = 0; i < report.closer_paths.size(); ++i) {
        const CloserPath& closer = report.closer_paths[i];
        const Frame& reference = report.frames[closer.reference];
        out += "<section class=\"box closer\">\n";
        if (report.closer_paths.size() > 1)
            out += fmt::format("<h3>{} \u00b7 {}</h3>\n",
                               isolated(page::inFolder(reference.scene, layout.folder)),
                               isolated(viewTitle(report, reference)));
        out += texts.closer_boxes[i] + "</section>\n";
    }
    return out;
}

}  // namespace diptych
