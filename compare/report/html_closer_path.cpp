// SPDX-License-Identifier: MIT
// Both paths against the truth, beside what they differ by: which is nearer, where, and by how much.
#include "compare/report/html.h"
#include "compare/report/titles.h"

#include <fmt/format.h>

namespace diptych {
namespace {

std::string cell(const std::string& text, bool best) {
    return fmt::format("<td class=\"n\">{}{}{}</td>", best ? "<b>" : "", text, best ? "</b>" : "");
}

// One figure of all three, the nearer path's in bold.
template <class Value>
std::string row(const char* name, const CloserPathChannel& channel, const Value& value) {
    const double first = value(channel.paths[0]), second = value(channel.paths[1]);
    return fmt::format("<tr><td class=\"soft\">{}</td>{}{}{}</tr>", name, cell(number(first), first < second),
                       cell(number(second), second < first), cell(number(value(channel.between)), false));
}

std::string figures(const Report& report, const CloserPath& nearer) {
    const auto name = [&](std::size_t k) { return markup(report.frames[nearer.paths[k]].name); };
    const std::string truth = markup(report.frames[nearer.truth].name);
    std::string out = fmt::format(
        "<div class=\"scroll\"><table><tr><th>errors</th><th class=\"n\">{}</th><th class=\"n\">{}</th>"
        "<th class=\"n\">between them</th></tr>",
        name(0), name(1));
    for (const CloserPathChannel& channel : nearer.channels) {
        out += fmt::format("<tr><td><b>{}</b></td><td></td><td></td><td></td></tr>", channel.mode->name);
        out += row("mean", channel, [](const PathError& s) { return s.stats.mean; });
        out += row("p99", channel, [](const PathError& s) { return s.stats.p99; });
        out += row("p99.9", channel, [](const PathError& s) { return s.stats.p999; });
        out += row("max", channel, [](const PathError& s) { return s.stats.max; });
        out += row("relative RMSE", channel, [](const PathError& s) { return s.relative_rmse; });
        out += row("FLIP", channel, [](const PathError& s) { return s.flip.value_or(0); });
    }
    return out +
           fmt::format(
               "</table></div><p class=\"soft\">Each path's from the {}; the nearer one's in bold. Between "
               "them: of {} from {}.</p>\n",
               truth, name(1), name(0));
}

std::string materials(const Report& report, const CloserPath& nearer, const CloserPathChannel& channel) {
    if (channel.materials.empty() || channel.nearer < 0) return {};
    const auto name = [&](std::size_t k) { return markup(report.frames[nearer.paths[k]].name); };
    std::string out = fmt::format(
        "<div class=\"scroll\"><table><tr><th>{} by material</th><th class=\"n\">pixels</th><th "
        "class=\"n\">{}</th>"
        "<th class=\"n\">{}</th></tr>",
        channel.mode->name, name(0), name(1));
    for (const MaterialError& m : channel.materials)
        out += fmt::format(
            "<tr><td class=\"wide\">{} <span class=\"soft\">{}</span></td><td class=\"n\">{}</td>{}{}</tr>",
            m.id, markup(m.name), m.pixels, cell(number(m.mean[0]), m.mean[0] < m.mean[1]),
            cell(number(m.mean[1]), m.mean[1] < m.mean[0]));
    return out +
           "</table></div><p class=\"soft\">Mean errors; the materials first where the paths stand furthest "
           "apart from each other.</p>\n";
}

std::string picture(const Report& report, const ReportLayout& layout, const CloserPath& nearer,
                    std::size_t index, std::size_t channel) {
    const std::string& file = layout.nearer[index][channel];
    if (file.empty()) return {};
    return fmt::format(
        "<figure><img class=\"whole\" loading=\"lazy\" src=\"{}\" alt=\"which path is nearer, pixel by "
        "pixel\">"
        "<figcaption><span><i class=\"swatch first\"></i>{} nearer</span><span><i class=\"swatch "
        "second\"></i>{} "
        "nearer</span><span>{}: as bright as their errors are apart, full at "
        "{}</span></figcaption></figure>\n",
        layout.source(file), markup(report.frames[nearer.paths[0]].name),
        markup(report.frames[nearer.paths[1]].name), nearer.channels[channel].mode->name,
        number(closerPathTop(nearer.channels[channel].apart)));
}

}  // namespace

std::string closerPathSection(const Report& report, const ReportLayout& layout) {
    if (report.nearer.empty()) return {};
    std::string out = "<h2 id=\"truth\">Against the truth</h2>\n";
    for (std::size_t i = 0; i < report.nearer.size(); ++i) {
        const CloserPath& nearer = report.nearer[i];
        const Frame& truth = report.frames[nearer.truth];
        out += "<section class=\"box nearer\">\n";
        if (report.nearer.size() > 1)
            out += fmt::format("<h3>{} \u00b7 {}</h3>\n", markup(truth.scene), markup(cameraTitle(truth)));
        std::string lines;
        for (const CloserPathChannel& channel : nearer.channels)
            lines += "<li>" + markup(closerPathLine(nearer, channel, report.frames)) + "</li>";
        out += "<ul>" + lines + "</ul>\n<div class=\"columns\">\n";
        if (!nearer.channels.empty())
            out += "<div>" + picture(report, layout, nearer, i, 0) +
                   materials(report, nearer, nearer.channels.front()) + "</div>\n";
        out += "<div>" + figures(report, nearer) + "</div></div></section>\n";
    }
    return out;
}

}  // namespace diptych
