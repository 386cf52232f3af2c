// SPDX-License-Identifier: MIT
// A measure's line in the table brings its column in rows.csv, and its key in JSON.
#include "compare/experiment/row.h"

#include "compare/output/writers.h"
#include "shared/text/json.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <set>

namespace diptych::experiment {
namespace {

using Json = nlohmann::ordered_json;

Row measuredRow() {
    Row row{.scene = "a, \"b\".glb", .camera = "c", .ms = {2, 1}, .warnings = {"one", "two"}};
    for (std::size_t i = 0; i < measures.size(); ++i)
        row.measured[static_cast<Measure>(i)] = 100 + static_cast<double>(i);
    row.passes = {{"shade", 0.5}};
    row.blocks = {{1.5, 1, 2, 2}};
    return row;
}

std::vector<std::string> headsOf(const std::string& csv) {
    std::vector<std::string> heads(1);
    for (const char c : csv.substr(0, csv.find("\r\n")))
        if (c == ',')
            heads.emplace_back();
        else
            heads.back() += c;
    return heads;
}

TEST(Rows, EveryMeasureIsAColumnAndAKey) {
    const std::vector<Row> rows{measuredRow(), Row{.scene = "empty"}};
    const std::string csv = inCsv(rowsTable(pointersTo(rows)));
    const std::vector<std::string> heads = headsOf(csv);
    const Json json = jsonOf(rows[0]), empty = jsonOf(rows[1]);
    std::set<std::pair<std::string_view, std::string_view>> keys;
    for (std::size_t i = 0; i < measures.size(); ++i) {
        const NamedMeasure& of = measures[i];
        const std::string head =
            fmt::format("{}.{}{}", of.group, of.name, of.unit.empty() ? "" : fmt::format(" [{}]", of.unit));
        EXPECT_EQ(std::ranges::count(heads, head), 1) << head;
        EXPECT_NE(csv.find(fmt::format(",{},", 100 + i)), csv.npos) << head;
        EXPECT_EQ(json.at(std::string(of.group)).at(std::string(of.name)), 100 + i) << head;
        EXPECT_TRUE(empty.at(std::string(of.group)).is_null()) << head << ": was not measured";
        EXPECT_TRUE(keys.insert({of.group, of.name}).second) << head << ": has another's key";
    }
    EXPECT_NE(csv.find("pass shade [ms]"), csv.npos);
    EXPECT_NE(csv.find("\"a, \"\"b\"\".glb\""), csv.npos);
    EXPECT_NE(csv.find("one; two"), csv.npos);
    // What no row has is no column; an option is one where rows differ.
    std::vector<Row> few(2);
    few[1].settings.gbuffer = GBufferEncoding::full;
    few[1].measured[Measure::flip] = 0.5;
    few[1].varied = "lights";
    few[1].judgement = "raced";
    few[0].failed = "lost";
    few[0].warnings = {"one", "two"};
    EXPECT_EQ(inCsv(rowsTable(pointersTo(few))),
              "row,scene,varied,camera,path,gbuffer,errors.flip,judgement,failed,warnings\r\n"
              "1,,,,forward_plus,standard,,,lost,one; two\r\n2,,lights,,forward_plus,full,0.5,raced,,\r\n");
    EXPECT_EQ(inCsv(rowsTable(pointersTo(std::vector{rows[1]}))),
              "row,scene,camera,path,judgement,failed,warnings\r\n1,empty,,forward_plus,,,\r\n");
}

TEST(Rows, TheirSchemaHasEveryMeasureWithItsUnit) {
    const std::filesystem::path room = std::filesystem::path(DIPTYCH_SOURCE_DIR) / "compare/experiment";
    const Json groups = orderedJsonIn(room / "rows.schema.json")["$defs"]["measured"]["properties"];
    std::vector<std::string> found, expected;
    const auto line = [](std::string_view group, std::string_view name, std::string_view unit,
                         std::string_view means, bool whole) {
        return fmt::format("{}.{} [{}] {}: {}", group, name, unit, whole ? "integer" : "number", means);
    };
    for (const auto& [group, of] : groups.items()) {
        const Json properties = of.value("properties", Json::object());
        for (const auto& [name, measure] : properties.items())
            if (measure["type"].is_array())
                found.push_back(line(group, name, measure.value("unit", ""),
                                     measure["description"].get<std::string>(),
                                     measure["type"] == Json{"integer", "null"}));
    }
    for (const NamedMeasure& of : measures)
        expected.push_back(line(of.group, of.name, of.unit, of.means, of.isWhole()));
    EXPECT_EQ(found, expected) << "rows.schema.json against measures.h";
}

TEST(Rows, AreReadBack) {
    Row row = measuredRow();
    row.measured[Measure::flip] = std::numeric_limits<double>::infinity();
    row.measured[Measure::leak] = 1.0 / 3;
    row.measured[Measure::shaded] = std::numeric_limits<double>::quiet_NaN();
    row.cameras = {row};
    const Json json = Json::parse(jsonOf(row).dump());
    const Row back = rowFrom(JsonAt<Json>(json));
    EXPECT_EQ(back[Measure::leak], 1.0 / 3);
    EXPECT_EQ(back.scene, row.scene);
    EXPECT_NE(row.scene, "");
    EXPECT_EQ(back.varied, row.varied);
    EXPECT_EQ(back.failed, row.failed);
    EXPECT_EQ(back.settings, row.settings);
    EXPECT_EQ(back[Measure::flip], std::numeric_limits<double>::infinity());
    EXPECT_FALSE(back.measured.has(Measure::shaded));
    EXPECT_EQ(back.cameras.at(0).camera, "c");
    EXPECT_EQ(jsonOf(back.cameras[0])["ms"], jsonOf(row.cameras[0])["ms"]);
    Json wrong = json;
    wrong["bytes"]["total"] = -1;
    EXPECT_THROW(rowFrom(JsonAt<Json>(wrong)), std::runtime_error);
}

TEST(Rows, OverCamerasFollowTheirRule) {
    Row row;
    row.cameras = {measuredRow(), measuredRow()};
    for (std::size_t i = 0; i < measures.size(); ++i) row.cameras[1].measured[static_cast<Measure>(i)] = 300;
    row.cameras[1].measured[Measure::gap] = std::numeric_limits<double>::quiet_NaN();
    joinCameras(row);
    EXPECT_EQ(row[Measure::ms], (row.cameras[0][Measure::ms] + 300) / 2);
    EXPECT_EQ(row[Measure::memory], 300);
    EXPECT_EQ(row[Measure::frames], row.cameras[0][Measure::frames] + 300);
    EXPECT_FALSE(row.measured.has(Measure::flip)) << "not a mean of cameras";
    EXPECT_FALSE(row.measured.has(Measure::gap)) << "one camera has none";
    EXPECT_DOUBLE_EQ(row.passes.at(0).ms, 0.5);
    const CameraRange range = cameraRangeOf(row, Measure::memory);
    EXPECT_EQ(range.low, row.cameras[0][Measure::memory]);
    EXPECT_EQ(range.high, 300);
}

}  // namespace
}  // namespace diptych::experiment
