// SPDX-License-Identifier: MIT
#include "compare/choose/plot.h"

#include "compare/page/text.h"
#include "compare/plot/error_over_time.h"
#include "compare/plot/labels.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace diptych::choose {

using page::markup;

namespace {

// SVG user units.
constexpr double plotWidth = 720, plotHeight = 440, leftEdge = 74, rightEdge = 16, topEdge = 54,
                 bottomEdge = 56;
constexpr PlotBox axesBox{leftEdge, topEdge, plotWidth - rightEdge, plotHeight - bottomEdge};

class ChoicePlot {
public:
    explicit ChoicePlot(const ChoiceReport& report)
        : report_(report),
          choice_(report.choice),
          drawn_(drawn(report.choice)),
          axes_(axesBox, times(), errors(), pointErrors()) {}

    std::string svg(PlotPlace place) const {
        std::string out = axes_.axes(report_.figure + " against the reference") + limits() + frontLine();
        const bool file = place == PlotPlace::file;
        for (const bool raced : {false, true})  // finalists on top
            for (const std::size_t i : drawn_)
                if ((choice_.candidates[i].status == CandidateStatus::raced) == raced) out += point(i, file);
        out += names() + legend();
        return plotElement(
            plotWidth, plotHeight,
            fmt::format("{} over time of the measured candidates, {}", report_.figure, report_.scene), place,
            out);
    }

private:
    // Confidence interval of a finalist's time, ms; a missing end is 0.
    std::pair<double, double> intervalOf(const Candidate& candidate) const {
        const double best = candidate.ms() / candidate.race_time->ratio;
        const auto known = [&](double ratio) { return std::isfinite(ratio) ? best * ratio : 0.0; };
        return {known(candidate.race_time->low), known(candidate.race_time->high)};
    }
    static std::vector<std::size_t> drawn(const Choice& choice) {
        std::vector<std::size_t> all;
        for (std::size_t i = 0; i < choice.candidates.size(); ++i)
            if (choice.candidates[i].judged && choice.candidates[i].timings > 0) all.push_back(i);
        return all;
    }
    std::vector<double> times() const {
        std::vector<double> all;
        for (const std::size_t i : drawn_) {
            const Candidate& candidate = choice_.candidates[i];
            all.push_back(candidate.ms());
            if (!candidate.race_time) continue;
            const auto [low, high] = intervalOf(candidate);
            all.insert(all.end(), {low, high});
        }
        if (report_.budget.ms) all.push_back(*report_.budget.ms);
        return all;
    }
    std::vector<double> pointErrors() const {
        std::vector<double> all;
        for (const std::size_t i : drawn_) all.push_back(choice_.candidates[i].judged->error);
        return all;
    }
    std::vector<double> errors() const {
        std::vector<double> all = pointErrors();
        if (report_.budget.error) all.push_back(*report_.budget.error);
        return all;
    }
    double x(double ms) const { return axes_.x(ms); }
    double y(double error) const { return axes_.y(error); }

    std::string limits() const {
        std::string out;
        const auto line = [&](double x1, double y1, double x2, double y2, const std::string& words) {
            out += fmt::format(
                "<line class=\"budget\" x1=\"{}\" y1=\"{}\" x2=\"{}\" y2=\"{}\"><title>{}</title></line>",
                svgNumber(x1), svgNumber(y1), svgNumber(x2), svgNumber(y2), markup(words));
        };
        if (report_.budget.error)
            line(leftEdge, y(*report_.budget.error), plotWidth - rightEdge, y(*report_.budget.error),
                 fmt::format("at most {:.4g}", *report_.budget.error));
        if (report_.budget.ms)
            line(x(*report_.budget.ms), topEdge, x(*report_.budget.ms), plotHeight - bottomEdge,
                 fmt::format("at most {:.4g} ms", *report_.budget.ms));
        return out;
    }

    // Pareto front: the least error within each time.
    std::string frontLine() const {
        std::vector<std::pair<double, double>> points;
        for (const std::size_t i : drawn_)
            points.emplace_back(choice_.candidates[i].ms(), choice_.candidates[i].judged->error);
        std::ranges::sort(points);
        double least = std::numeric_limits<double>::infinity();
        std::vector<std::pair<double, double>> front;
        for (const auto& [ms, error] : points) {
            if (!(error < least)) continue;
            least = error;
            front.emplace_back(ms, error);
        }
        return axes_.front(front);
    }

    std::string point(std::size_t i, bool file) const {
        const Candidate& candidate = choice_.candidates[i];
        const double px = x(candidate.ms()), py = y(candidate.judged->error);
        const bool raced = candidate.status == CandidateStatus::raced;
        const std::string words =
            fmt::format("{}; {:.4g} ms, {} {:.4g}; {}", report_.words[i], candidate.ms(), report_.figure,
                        candidate.judged->error, statusInWords(candidate.status));
        std::string out = fmt::format(
            "<g class=\"point {}{}\" data-row=\"{}\"{}><title>{}</title>", nameOf(candidate.settings.path),
            raced ? " best" : "", i + 1,
            file ? "" : fmt::format(" tabindex=\"0\" role=\"img\" aria-label=\"{}\"", markup(words)),
            markup(words));
        if (candidate.race_time) {
            const auto [low, up] = intervalOf(candidate);
            if (low > 0 && up > low)
                out += fmt::format("<path class=\"bar\" d=\"M{0} {1}V{2}M{0} {3}H{4}M{4} {1}V{2}\"/>",
                                   svgNumber(x(low)), svgNumber(py - 4), svgNumber(py + 4), svgNumber(py),
                                   svgNumber(x(up)));
        }
        return out + pathMark(candidate.settings.path, px, py, raced ? 6 : 4.5) + "</g>";
    }

    // Labels the chosen candidate and the runner-up, or the nearest one if nothing fits.
    std::string names() const {
        std::vector<std::pair<std::size_t, std::string>> named;
        if (choice_.chosen) named.emplace_back(*choice_.chosen, "chosen");
        if (choice_.runner_up) named.emplace_back(*choice_.runner_up, "runner-up");
        if (choice_.nearest) named.emplace_back(*choice_.nearest, "nearest");
        std::vector<Label> labels;
        std::vector<PlotBox> marks;
        for (const std::size_t i : drawn_) {
            const double px = x(choice_.candidates[i].ms()), py = y(choice_.candidates[i].judged->error);
            marks.push_back({px - 5, py - 5, px + 5, py + 5});
        }
        constexpr double letter = 10, line = 17;  // the style's largest text
        for (const auto& [i, word] : named)
            labels.push_back({x(choice_.candidates[i].ms()), y(choice_.candidates[i].judged->error),
                              letter * static_cast<double>(word.size()), line});
        const std::vector<PlotBox> places = placeLabels(labels, marks, axesBox);
        std::string out;
        for (std::size_t k = 0; k < places.size(); ++k) {
            const double px = (places[k].left + places[k].right) / 2;
            const double py = (places[k].top + places[k].bottom) / 2;
            out += fmt::format("<path class=\"lead\" d=\"M{} {}L{} {}\"/>", svgNumber(labels[k].x),
                               svgNumber(labels[k].y), svgNumber(px), svgNumber(py));
            out += fmt::format("<text class=\"row middle\" x=\"{}\" y=\"{}\">{}</text>", svgNumber(px),
                               svgNumber(places[k].bottom - 4), named[k].second);
        }
        return "<g class=\"rows-named\">" + out + "</g>";
    }

    // Above the plot, from the right: only entries that the plot shows.
    std::string legend() const {
        std::string out;
        double px = plotWidth - rightEdge;
        const double py = 14;
        const auto entry = [&](const std::string& name, const std::string& kind, const auto& drawing) {
            px -= 7.2 * static_cast<double>(name.size()) + 32;
            out += fmt::format("<g class=\"point {}\">{}<text class=\"tick\" x=\"{}\" y=\"{}\">{}</text></g>",
                               kind, drawing(px, py), svgNumber(px + 13), svgNumber(py + 4), name);
        };
        if (report_.budget.error || report_.budget.ms)
            entry("limit", "", [](double at, double up) {
                return fmt::format("<line class=\"budget\" x1=\"{}\" y1=\"{}\" x2=\"{}\" y2=\"{}\"/>",
                                   svgNumber(at - 10), svgNumber(up), svgNumber(at + 9), svgNumber(up));
            });
        const auto isDrawn = [&](const auto& what) { return std::ranges::any_of(drawn_, what); };
        if (isDrawn([&](std::size_t i) { return choice_.candidates[i].status == CandidateStatus::raced; }))
            entry("finalist, 99 % interval", "best", [](double at, double up) {
                return fmt::format("<path class=\"bar\" d=\"M{0} {1}V{2}M{0} {3}H{4}M{4} {1}V{2}\"/>",
                                   svgNumber(at - 9), svgNumber(up - 4), svgNumber(up + 4), svgNumber(up),
                                   svgNumber(at + 9)) +
                       pathMark(Path::deferred, at, up, 5);
            });
        for (const Path path : drawn_paths)
            if (isDrawn([&](std::size_t i) { return choice_.candidates[i].settings.path == path; }))
                entry(std::string(nameOf(path)), std::string(nameOf(path)),
                      [path](double at, double up) { return pathMark(path, at, up, 4.5); });
        return out;
    }

    const ChoiceReport& report_;
    const Choice& choice_;
    const std::vector<std::size_t> drawn_;  // indices of candidates
    const ErrorOverTime axes_;
};

}  // namespace

std::string choicePlot(const ChoiceReport& report, PlotPlace place) {
    return ChoicePlot(report).svg(place);
}

}  // namespace diptych::choose
