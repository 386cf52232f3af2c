// SPDX-License-Identifier: MIT
// Every report prints each metric under its own name, and the worst pixel at its position.
#include "compare/report/image_diff_json.h"
#include "compare/report/image_diff_report.h"
#include "compare/report/json.h"
#include "compare/report/report.h"
#include "compare/report/titles.h"
#include "compare/verdict/image_diff.h"
#include "shared/image/exr.h"
#include "tests/support/error_spread.h"
#include "tests/support/files.h"
#include "tests/support/frames.h"
#include "tests/support/report_builder.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <regex>
#include <sstream>

namespace diptych {

using namespace error_spread;

namespace {

Metrics printedMetrics() {
    return ofPixels(errorsOf(spread()).absolute);
}

// A Frame with these channels; the counted pixels show material 3, the others background.
Frame spreadFrame(Path path, const Image& lit, const Image& roughness) {
    Frame frame = flatFrame(path, wide, high, 0, -1);
    frame.scene = "builtin:one";
    frame.channels[Channel::lit] = lit;
    frame.channels[Channel::roughness] = roughness;
    for (std::size_t i = 0; i < counted; ++i) frame.channels[Channel::material_id].data[spreadPixel(i)] = 3;
    return frame;
}

// Component 0 of the spread; its absolute errors are the steps.
Image redOf(const Image& image) {
    Image red(wide, high, 1);
    for (std::size_t i = 0; i < everywhere; ++i) red.data[i] = image.pixel(i)[0];
    return red;
}

Report spreadReport() {
    const Spread s = spread();
    return reportOf({spreadFrame(Path::deferred, s.reference, redOf(s.reference)),
                     spreadFrame(Path::forward_plus, s.reference, redOf(s.test))});
}

nlohmann::json roughnessIn(const nlohmann::json& channels) {
    for (const auto& channel : channels)
        if (channel["name"] == "roughness") return channel;
    return {};
}

// Cells of a table's row, keyed by the head's words.
std::map<std::string, std::string> byHead(const std::string& head, const std::string& row) {
    std::istringstream heads(head), cells(row);
    std::map<std::string, std::string> found;
    for (std::string name, cell; heads >> name && cells >> cell;) found[name] = cell;
    return found;
}
std::string lineWith(const std::string& text, const std::string& start) {
    const std::size_t at = text.find("\n  " + start + " ") + 1;
    return text.substr(at, text.find('\n', at) - at);
}
std::string withoutTags(const std::string& html) {
    return std::regex_replace(html, std::regex("<[^>]*>"), " ");
}

const std::size_t worstPixel = spreadPixel(counted - 1);

TEST(PrintedMetrics, ReportJsonHasThemUnderTheirKeys) {
    const auto report = nlohmann::json::parse(reportJson(spreadReport(), nullptr));
    const auto channel = roughnessIn(report["comparisons"][0]["channels"]);
    for (const auto& [name, value] : printedMetrics())
        EXPECT_NEAR(channel[name].get<double>(), value, 1e-12) << name;
    EXPECT_EQ(report["comparisons"][0]["covered_pixels"], counted);
    EXPECT_EQ(channel["worst_pixel"], (nlohmann::json{worstPixel % wide, worstPixel / wide}));
    EXPECT_EQ(channel["worst_values"]["baseline"][0], magnitudeOf(counted - 1));
    EXPECT_EQ(channel["worst_values"]["test"][0], magnitudeOf(counted - 1) + stepOf(counted - 1));
}

TEST(PrintedMetrics, TheTableHasThemUnderTheirHeads) {
    const std::string table = reportTable(spreadReport());
    const auto cells = byHead(lineWith(table, "channel"), lineWith(table, "roughness"));
    const Metrics expected = printedMetrics();
    for (const auto& [head, name] : {std::pair{"max", "max"}, {"mean", "mean"}, {"p99.9", "p999"}})
        EXPECT_EQ(cells.at(head), page::number(expected.at(name))) << table;
    EXPECT_NE(table.find(fmt::format("worst at {},{}", worstPixel % wide, worstPixel / wide)),
              std::string::npos)
        << table;
}

TEST(PrintedMetrics, ThePageHasThemBesideTheirNames) {
    const Report report = spreadReport();
    const std::string page = pageOf(report);
    const Metrics expected = printedMetrics();
    const std::string card = page.substr(page.find("id=\"c0-roughness\""));
    for (const auto& [name, metric] :
         {std::pair{"max", "max"}, {"mean", "mean"}, {"rmse", "rmse"}, {"p99", "p99"}, {"p99.9", "p999"}})
        EXPECT_NE(card.find(fmt::format("<dt>{}</dt><dd>{}</dd>", name, page::number(expected.at(metric)))),
                  std::string::npos)
            << name;
    // The overview's heads and cells have the same order.
    const std::size_t row = page.find("<a href=\"#c0-roughness\">roughness</a><span");
    const std::size_t head = page.rfind("<th>channel</th>", row);
    const auto cells =
        byHead(std::regex_replace(withoutTags(page.substr(head, page.find("</tr>", head) - head)),
                                  std::regex("max of tolerance"), "used"),
               "roughness " + withoutTags(page.substr(page.find("</td>", row),
                                                      page.find("</tr>", row) - page.find("</td>", row))));
    for (const auto& [name, metric] : {std::pair{"max", "max"}, {"mean", "mean"}, {"p99.9", "p999"}})
        EXPECT_EQ(cells.at(name), page::number(expected.at(metric))) << name;
    EXPECT_NE(card.find(fmt::format("<dt>forward_plus at {},{}</dt><dd>{}</dd>", worstPixel % wide,
                                    worstPixel / wide,
                                    static_cast<float>(magnitudeOf(counted - 1) + stepOf(counted - 1)))),
              std::string::npos);
    EXPECT_NE(
        card.find(fmt::format("--u:{:.5f};--v:{:.5f}", (static_cast<double>(worstPixel % wide) + 0.5) / wide,
                              (static_cast<double>(worstPixel / wide) + 0.5) / high)),
        std::string::npos)
        << "the ring is around its centre";
}

TEST(PrintedMetrics, JunitNamesThem) {
    const std::string junit = junitOf(spreadReport());
    const Metrics expected = printedMetrics();
    EXPECT_NE(
        junit.find(fmt::format("max {} mean {} p99.9 {} (absolute), worst at {},{}",
                               page::number(expected.at("max")), page::number(expected.at("mean")),
                               page::number(expected.at("p999")), worstPixel % wide, worstPixel / wide)),
        std::string::npos)
        << junit;
}

// Errors against the reference: deferred has the spread, forward+ three quarters of it. Deferred against
// forward+ is smaller.
TEST(PrintedMetrics, OfBothPathsAgainstTheReferenceStandInTheirColumns) {
    const Spread s = spread();
    Image nearer = s.reference;
    for (std::size_t i = 0; i < nearer.data.size(); ++i)
        nearer.data[i] += 0.75f * (s.test.data[i] - s.reference.data[i]);
    const Image rough = redOf(s.reference);
    std::vector<Frame> frames{spreadFrame(Path::reference, s.reference, rough),
                              spreadFrame(Path::deferred, s.test, rough),
                              spreadFrame(Path::forward_plus, nearer, rough)};
    const Report report = makeReport({{frames, {}, {}, {"a", "b", "c", "d"}}}, {"a CPU", "1.0", "cpu"});
    const std::vector<double> deferred = errorsOf(s).relative;
    std::vector<double> forward, between;
    for (std::size_t i = 0; i < counted; ++i) {
        forward.push_back(0.75 * deferred[i]);
        const double by = magnitudeOf(i) + stepOf(i);
        between.push_back(0.25 * stepOf(i) / by);
    }
    const auto json = nlohmann::json::parse(reportJson(report, nullptr))["truth"][0]["channels"][0];
    const std::string page = pageOf(report);
    const std::string table = page.substr(page.find(">errors</th>"));
    for (const auto& [name, errors] :
         {std::pair{"deferred", deferred}, {"forward_plus", forward}, {"between", between}}) {
        const Metrics expected = ofPixels(errors);
        const auto& found = name == std::string("between") ? json["between"] : json["error"][name];
        for (const auto& [metric, value] : expected)
            EXPECT_NEAR(found[metric].get<double>(), value, 1e-12) << name << " " << metric;
        EXPECT_NEAR(found["relative_rmse"].get<double>(), expected.at("rmse"), 1e-12) << name;
    }
    for (const auto& [name, metric] :
         {std::pair{"mean", "mean"}, {"p99", "p99"}, {"p99.9", "p999"}, {"max", "max"}}) {
        std::string row;
        for (const auto& errors : {deferred, forward, between})
            row += fmt::format(" {}", page::number(ofPixels(errors).at(metric)));
        const std::size_t at = table.find(fmt::format("<td class=\"soft wide\">{}</td>", name));
        std::istringstream cells(withoutTags(table.substr(at, table.find("</tr>", at) - at)));
        std::string found, cell;
        cells >> cell;
        while (cells >> cell) found += " " + cell;
        EXPECT_EQ(found, row) << name;
    }
}

TEST(PrintedMetrics, OfTwoFilesStandUnderTheirKeysAndHeads) {
    const std::filesystem::path here = folder();
    const Spread s = spread();
    Image kept = s.test;  // files have no background: uncounted pixels are equal
    for (std::size_t i = counted; i < everywhere; ++i)
        std::copy_n(s.reference.pixel(spreadPixel(i)), 3, kept.pixel(spreadPixel(i)));
    writeExr(here / "a.exr", {{{"R", "G", "B"}, &s.reference}});
    writeExr(here / "b.exr", {{{"R", "G", "B"}, &kept}});
    ImageDiffOptions options;
    options.metric = "p999";
    options.metric_requested = true;
    const ImageDiff diff = diffImages((here / "a.exr").string(), (here / "b.exr").string(), options);
    const auto json = nlohmann::json::parse(imageDiffJson(diff))["channels"][0];
    std::vector<double> pixels = errorsOf(s).absolute, components = errorsOf(s).components;
    pixels.resize(everywhere);
    components.resize(3 * everywhere);
    // ceil(0.99 x 2501) = 2476, ceil(0.999 x 2501) = 2499.
    const Metrics expected{{"max", errorOfRank(pixels, everywhere)},
                           {"mean", meanOf(components)},
                           {"rmse", rootMeanSquareOf(components)},
                           {"p99", errorOfRank(pixels, 2476)},
                           {"p999", errorOfRank(pixels, 2499)}};
    for (const auto& [name, value] : expected) {
        EXPECT_NEAR(json[name].get<double>(), value, 1e-12) << name;
        EXPECT_NEAR(json["metrics"][name].get<double>(), value, 1e-12) << name;
    }
    EXPECT_EQ(json["worst_pixel"], (nlohmann::json{worstPixel % wide, worstPixel / wide}));
    const std::string table = diffTable({&diff, 1});
    const auto cells = byHead(lineWith(table, "channel"), lineWith(table, "lit"));
    EXPECT_EQ(cells.at("p99.9"), page::number(expected.at("p999")));
    EXPECT_EQ(cells.at("max"), page::number(expected.at("max")));
    EXPECT_EQ(cells.at("rmse"), page::number(expected.at("rmse")));
}

}  // namespace
}  // namespace diptych
