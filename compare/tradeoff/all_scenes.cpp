// SPDX-License-Identifier: MIT
#include "compare/tradeoff/all_scenes.h"

#include "compare/files/diptych_files.h"
#include "compare/files/listed_folder.h"
#include "compare/output/writers.h"
#include "compare/page/text.h"
#include "compare/plot/plot.h"
#include "compare/tradeoff/tradeoff.h"
#include "shared/text/counted.h"
#include "shared/text/fail.h"
#include "shared/text/input_file.h"
#include "shared/text/json.h"
#include "shared/text/json_at.h"
#include "shared/text/named.h"

#include <fmt/format.h>

#include <cstddef>
#include <tuple>
#include <utility>

namespace diptych::tradeoff {
namespace {

namespace fs = std::filesystem;

// One scene's row on the page of all scenes.
struct Swept {
    std::string scene, folder, device;
    std::size_t rows = 0, front = 0;
    double fastest_ms = 0, fastest_flip = 0, best_ms = 0, best_flip = 0;
};

using ReportAt = JsonAt<nlohmann::json>;

Swept sweptOf(const SweptScene& scene, const ReportAt& json) {
    Swept swept{scene.scene, scene.folder, json.at("device").textOr("name", "")};
    const std::vector<ReportAt> rows = json.at("rows").each();
    swept.rows = rows.size();
    for (const ReportAt& front : json.at("fronts").each())
        if (front.at("error").text() == "flip" && front.at("path").json().is_null())
            swept.front = front.at("rows").size();
    bool first = true;
    for (const ReportAt& row : rows) {
        const double ms = row.at("ms").at("median").number();
        const ReportAt error = row.at("errors").at("flip");
        const double flip = error.json().is_number() ? error.number() : 1e300;
        if (first || ms < swept.fastest_ms)
            std::tie(swept.fastest_ms, swept.fastest_flip) = std::pair(ms, flip);
        if (first || flip < swept.best_flip) std::tie(swept.best_ms, swept.best_flip) = std::pair(ms, flip);
        first = false;
    }
    return swept;
}

// Reads a scene's tradeoff below `root`; throws if the file is not a tradeoff.
Swept sweptIn(const fs::path& root, const SweptScene& scene) {
    const std::string name = scene.folder + tradeoffManifest;
    return named((root / name).string(), [&] {
        const nlohmann::json json = parseJson(textBelow(root, name, json_bytes));
        const ReportAt top(json);
        if (top.textOr("software", "") != softwareName) fail("is not a report of tradeoff");
        return sweptOf(scene, top);
    });
}

std::string pageOf(const std::vector<Swept>& all, const std::vector<std::string>& failures) {
    using output::Column;
    using output::numberCell;
    std::vector<std::string> scenes;
    for (const Swept& one : all) scenes.push_back(one.scene);
    const std::string common = page::commonFolder(scenes);
    output::Table table{.columns = {}, .sortable = true, .style = "", .box = "box scroll"};
    const auto add = [&](Column column, const auto& cellOf) { addColumn(table, column, all, cellOf); };
    const auto addNumber = [&](const char* title, const auto& of) {
        add({title, Column::number}, [&](const Swept& one) { return numberCell(one.*of); });
    };
    const auto addCount = [&](const char* title, std::size_t Swept::*of) {
        add({title, Column::number}, [&](const Swept& one) { return fmt::format("{}", one.*of); });
    };
    add({.title = "scene", .style = "wide"}, [&](const Swept& one) {
        const output::Span link(page::inFolder(one.scene, common), output::Span::link,
                                one.folder + "index.html");
        return output::styled(link, "", one.scene);
    });
    addCount("rows", &Swept::rows);
    addCount("on the front", &Swept::front);
    addNumber("fastest, ms", &Swept::fastest_ms);
    addNumber("its FLIP", &Swept::fastest_flip);
    addNumber("most accurate, ms", &Swept::best_ms);
    addNumber("FLIP", &Swept::best_flip);
    add({.title = "device", .style = "wide soft"}, [](const Swept& one) { return one.device; });
    const std::string of = counted(all.size(), "scene");
    output::Document page{.title = "time against error of " + of,
                          .heading = "Time against error of " + of,
                          .about =
                              "Times were measured on the device in the row; times of different devices "
                              "do not compare.",
                          .blocks = {}};
    output::List failed;
    for (const std::string& failure : failures) failed.items.emplace_back(failure);
    if (!failures.empty())
        page.blocks.emplace_back(output::Box{"box failures", {output::Heading{4, "Failures"}, failed}});
    page.blocks.emplace_back(output::Box{"index", {table}});
    return inHtml(page);
}

}  // namespace

void checkSwept(const fs::path& root, const SweptScene& scene, const std::vector<std::string>& files) {
    sweptIn(root, scene);
    for (const std::string& name : files)
        named((root / scene.folder / name).string(), [&] {
            const std::string file = scene.folder + name;
            if (name == "index.html")
                checkTradeoffHtml(textBelow(root, file, json_bytes));
            else if (name.ends_with(".svg"))
                checkPlot(textBelow(root, file, json_bytes));
            else if (name.ends_with(".png") || name.ends_with(".csv"))
                InputFile(root, file);
            else
                fail("is of a kind that tradeoff does not write");
        });
}

std::string writeAllScenes(const fs::path& folder, nlohmann::ordered_json manifest,
                           const std::vector<SweptScene>& scenes, const std::vector<std::string>& failures,
                           bool force) {
    std::vector<Swept> swept;
    for (const SweptScene& scene : scenes) swept.push_back(sweptIn(folder, scene));
    ListedFolder out(folder, tradeoffsManifest, force);
    out.put("index.html", pageOf(swept, failures));
    manifest["scenes"] = nlohmann::ordered_json::array();
    for (const Swept& one : swept)
        manifest["scenes"].push_back({{"scene", one.scene},
                                      {"folder", one.folder},
                                      {"device", one.device},
                                      {"rows", one.rows},
                                      {"front", one.front},
                                      {"fastest", {{"ms", one.fastest_ms}, {"flip", one.fastest_flip}}},
                                      {"most_accurate", {{"ms", one.best_ms}, {"flip", one.best_flip}}}});
    return out.finish(std::move(manifest));
}

}  // namespace diptych::tradeoff
