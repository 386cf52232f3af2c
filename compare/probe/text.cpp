// SPDX-License-Identifier: MIT
#include "compare/probe/run.h"

#include "shared/text/counted.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace diptych::probe {
namespace {

std::string number(double x) {
    if (x == 0) return "0";
    if (!(std::abs(x) < 1e100)) return "none";
    return x >= 1e5 || x < 1e-3 ? fmt::format("{:.1e}", x) : fmt::format("{:.3g}", x);
}

std::string rowText(std::span<const float> row) {
    std::string text;
    for (const float x : row) text += fmt::format("{}{}", text.empty() ? "" : " ", x);
    return text;
}

std::string worstText(const Worst& w, std::span<const float> input) {
    return fmt::format("{} instead of {} ({} allowed) for input {}", w.got, w.expected, number(w.allowed),
                       rowText(input));
}

// The upper end of a histogram bin; 0: exact.
double binEnd(std::size_t bin) {
    return bin == 0 ? 0 : std::exp2(static_cast<double>(bin) - 2);
}

std::string histogramText(const Tally& tally) {
    std::string text;
    for (std::size_t i = 0; i < error_bins; ++i)
        if (tally.histogram[i] > 0)
            text += fmt::format("{}{} {}", text.empty() ? "" : ", ",
                                i == 0 ? "0:" : fmt::format("to {}:", number(binEnd(i))), tally.histogram[i]);
    return text;
}

}  // namespace

std::string tableOf(std::span<const Result> results, bool verbose) {
    std::string text = fmt::format("     {:<34} {:>8} {:>8} {:>8} {:>8} {:<10} {:>8}\n", "probe", "results",
                                   "median", "99.9 %", "worst", "", "of limit");
    std::string group;
    std::uint64_t all = 0, failed = 0;
    for (const Result& r : results) {
        const Tally& t = r.tally;
        all += t.results;
        failed += !r.passed;
        if (r.probe->group != group) text += fmt::format("     {}\n", group = r.probe->group);
        std::string notes;
        if (t.backward > 0) notes += fmt::format("; {} not monotonic", t.backward);
        if (t.unpromised > 0) notes += fmt::format("; {} without a bound", t.unpromised);
        if (t.nonfinite > 0) notes += fmt::format("; {} NaN or infinite", t.nonfinite);
        text += fmt::format("       {:<32} {:>8} {:>8} {:>8} {:>8} {:<10} {:>8}  {}{}\n", r.probe->name,
                            t.results, number(r.median), number(r.p999), number(t.worst.error), r.probe->unit,
                            number(t.tightest.error), r.passed ? "pass" : "FAIL", notes);
        if (!r.passed) text += fmt::format("         {}\n", worstText(t.tightest, r.tight_input));
        if (verbose) {
            text += fmt::format("         inputs: {}\n         allowed: {}\n         errors: {}\n",
                                r.probe->inputs, r.probe->because, histogramText(t));
            if (t.worst.any) text += fmt::format("         worst: {}\n", worstText(t.worst, r.worst_input));
        }
    }
    const std::string verdict = failed ? fmt::format("FAIL: {} of {} probes", failed, results.size())
                                       : fmt::format("pass: {0} of {0} probes", results.size());
    return text + fmt::format("     {}, {}\n", verdict, counted(all, "result"));
}

nlohmann::ordered_json jsonOf(std::span<const Result> results) {
    using Json = nlohmann::ordered_json;
    const auto finite = [](double x) { return std::abs(x) < 1e300 ? Json(x) : Json(nullptr); };
    const auto worst = [&](const Worst& w, const std::vector<float>& input) {
        if (!w.any) return Json(nullptr);
        return Json{{"error", finite(w.error)},
                    {"got", finite(w.got)},
                    {"expected", finite(w.expected)},
                    {"allowed", finite(w.allowed)},
                    {"output", w.output},
                    {"row", w.row},
                    {"input", input}};
    };
    Json all = Json::array();
    for (const Result& r : results) {
        const Tally& t = r.tally;
        Json histogram = Json::array();
        for (std::size_t i = 0; i < error_bins; ++i)
            if (t.histogram[i] > 0) {
                const bool last = i + 1 == error_bins;
                histogram.push_back(
                    {{"to", last ? Json(nullptr) : Json(binEnd(i))}, {"results", t.histogram[i]}});
            }
        all.push_back({{"group", r.probe->group},
                       {"probe", r.probe->name},
                       {"inputs", r.probe->inputs},
                       {"because", r.probe->because},
                       {"unit", r.probe->unit},
                       {"pass", r.passed},
                       {"results", t.results},
                       {"failures", t.failures},
                       {"nonfinite", t.nonfinite},
                       {"unpromised", t.unpromised},
                       {"backward", t.backward},
                       {"median", r.median},
                       {"p99.9", r.p999},
                       {"worst", worst(t.worst, r.worst_input)},
                       {"of_limit", worst(t.tightest, r.tight_input)},
                       {"histogram", histogram}});
    }
    return all;
}

}  // namespace diptych::probe
