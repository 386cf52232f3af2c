// SPDX-License-Identifier: MIT
#include "compare/tradeoff/all_scenes.h"

#include "compare/files/listed_folder.h"
#include "compare/files/our_files.h"
#include "compare/page/page.h"
#include "compare/page/text.h"
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
using page::markup;

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
    std::vector<std::string> scenes;
    for (const Swept& one : all) scenes.push_back(one.scene);
    const std::string common = page::commonFolder(scenes);
    std::string rows, failed;
    for (const Swept& one : all)
        rows += fmt::format(
            "<tr><td class=\"wide\"><a href=\"{}index.html\" title=\"{}\">{}</a></td><td "
            "class=\"n\">{}</td><td "
            "class=\"n\">{}</td><td class=\"n\">{}</td><td class=\"n\">{}</td><td class=\"n\">{}</td><td "
            "class=\"n\">{}</td><td class=\"wide soft\">{}</td></tr>\n",
            markup(one.folder), markup(one.scene), markup(page::inFolder(one.scene, common)), one.rows,
            one.front, page::number(one.fastest_ms), page::number(one.fastest_flip),
            page::number(one.best_ms), page::number(one.best_flip), markup(one.device));
    for (const std::string& failure : failures) failed += fmt::format("<li>{}</li>", markup(failure));
    if (!failed.empty())
        failed = "<section class=\"box failures\"><h4>Failures</h4><ul>" + failed + "</ul></section>\n";
    return fmt::format(
        "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
        "content=\"width=device-width, initial-scale=1\"><title>Diptych: time against error of "
        "{0}</title>\n<style>{1}</style></head>\n<body><header><p class=\"brand\">Diptych</p><h1>Time "
        "against error of {0}</h1></header>\n{2}<section class=\"index\"><div class=\"box "
        "scroll\"><table><thead><tr>{3}</tr></thead><tbody>{4}</tbody></table></div></section>\n<p "
        "class=\"soft small\">Times were measured on the device in the row; times of different devices do "
        "not compare.</p>\n<script>{5}sortable(document.querySelector('.index table'), "
        "true);</script>\n</body></html>\n",
        counted(all.size(), "scene"), page::style, failed,
        [] {
            std::string heads;
            for (const auto& [name, number] : {std::pair{"scene", false},
                                               {"rows", true},
                                               {"on the front", true},
                                               {"fastest, ms", true},
                                               {"its FLIP", true},
                                               {"most accurate, ms", true},
                                               {"FLIP", true},
                                               {"device", false}})
                heads += fmt::format("<th{}><button type=\"button\">{}</button></th>",
                                     number ? " class=\"n\"" : "", name);
            return heads;
        }(),
        rows, page::tables);
}

}  // namespace

void checkSwept(const fs::path& root, const SweptScene& scene) {
    sweptIn(root, scene);
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
