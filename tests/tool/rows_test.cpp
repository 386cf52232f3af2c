// SPDX-License-Identifier: MIT
// Rows of tradeoff, choose, bench and audit follow one schema, and rows.csv has the same values.
#include "tests/tool/schema.h"
#include "tests/tool/sweep.h"

namespace diptych {
namespace {

const fs::path row_schema = fs::path(DIPTYCH_SOURCE_DIR) / "compare/experiment/rows.schema.json";

// Columns are keys of the schema, options, or passes; measures have their units and JSON's values.
constexpr const char* checkRows = R"py(
rows = data["rows"] or sys.exit("no rows")
for row in rows:
    validator.validate(row)
measured = schema["$defs"]["measured"]["properties"]
units = {group + "." + name: of.get("unit") for group in measured
         for name, of in measured[group].get("properties", {}).items()}
table = list(csv.reader(open("out/rows.csv", newline=""), strict=True))
heads, lines = table[0], table[1:]
assert len(set(heads)) == len(heads) and all(len(line) == len(heads) for line in lines)
skips = data["skipped"] if "conclusions" in data else []  # of bench, which are lines too
assert len(lines) == len(rows) + len(skips)
for column, head in enumerate(heads):
    name, _, unit = head.partition(" [")
    unit = unit.rstrip("]") or None
    if name.startswith("pass "):
        assert unit == schema["$defs"]["pass"]["properties"]["ms"]["unit"], head
    elif name in units:
        assert unit == units[name], head
        group, key = name.split(".")
        for line, row in zip(lines, rows):
            value = row[group].get(key, "") if isinstance(row[group], dict) else ""
            value = math.inf if value is None else value
            assert value == (line[column] and float(line[column])), (head, line[column], value)
    elif name in {**schema["properties"], **measured}:
        assert unit is None, head
    else:
        settings = {**data.get("settings", {}), **rows[0]["settings"]}
        assert unit is None and name.replace("-", "_") in settings, head
for name in units:
    group, key = name.split(".")
    has = any(isinstance(row[group], dict) and key in row[group] for row in rows)
    assert key == "all" or has == any(head.split(" [")[0] == name for head in heads), name
)py";

TEST(RowsOfCommands, AreAsTheSchemaSaysAndSoIsRowsCsv) {
    if (!hasValidator()) GTEST_SKIP() << "NO python3-jsonschema: rows are not held to the schema";
    const Folder folder;
    const std::string grid =
        R"(--grid '{"settings": {"path": ["deferred", "forward_plus"], "gbuffer": ["compact", "full"]}}')";
    const std::pair<const char*, std::string> commands[] = {
        {"tradeoff", "builtin:suns --size 32x18 --shadows pcf --runs 1 " + grid},
        {"choose", "builtin:spots --size 32x18 --max-error 1 " + grid},
        {"bench", "builtin:triangle --size 32x18 --runs 1 --assign every,per_object --light-counts 1,4"},
        {"audit", "builtin:triangle --size 16x9 --quantity offset,environment"}};
    for (const auto& [command, words] : commands) {
        const Ran ran = runTool(folder, std::string(command) + " " + words + " --force -q --json -o out");
        ASSERT_EQ(ran.code, 0) << command << ran.err;
        folder.write("out.json", ran.out);
        const Ran held = validate(folder, row_schema, folder / "out.json", checkRows);
        EXPECT_EQ(held.code, 0) << command << held.err;
    }
    // Negative controls, of the last command.
    const Json good = readJson(folder / "out.json");
    const auto refuses = [&](const auto& change) {
        Json bad = good;
        change(bad["rows"][0]);
        folder.write("out.json", bad.dump());
        return validate(folder, row_schema, folder / "out.json", checkRows).code != 0;
    };
    EXPECT_TRUE(refuses([](Json& row) { row["speed"] = 1; })) << "an unknown key";
    EXPECT_TRUE(refuses([](Json& row) { row["errors"]["speed"] = 1; })) << "an unknown measure";
    EXPECT_TRUE(refuses([](Json& row) { row.erase("camera"); })) << "a missing key";
    EXPECT_TRUE(refuses([](Json& row) { row["errors"]["light_p99"] = 0.125; }))
        << "rows.csv has another value";
    folder.write("out.json", good.dump());
    std::string csv = contentsOf(folder / "out/rows.csv");
    csv.replace(csv.find("[count]"), 7, "[s]");
    folder.write("out/rows.csv", csv);
    EXPECT_NE(validate(folder, row_schema, folder / "out.json", checkRows).code, 0) << "another unit";
}

}  // namespace
}  // namespace diptych
