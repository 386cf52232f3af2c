// SPDX-License-Identifier: MIT
#include "compare/cli/tradeoff_many.h"

#include "compare/cli/commands.h"
#include "compare/cli/scene_items.h"
#include "compare/files/checkpoint_folder.h"
#include "compare/files/listed_folder.h"
#include "compare/files/our_files.h"
#include "compare/files/output_folder.h"
#include "compare/output/writers.h"
#include "compare/page/text.h"
#include "compare/report/folders.h"
#include "compare/report/titles.h"
#include "compare/run/print.h"
#include "compare/shards/merge.h"
#include "compare/tradeoff/tradeoff.h"
#include "shared/text/counted.h"
#include "shared/text/fail.h"
#include "shared/text/input_file.h"
#include "shared/text/json.h"
#include "shared/text/json_at.h"
#include "shared/text/named.h"
#include "shared/text/one_line.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <system_error>
#include <tuple>
#include <utility>

namespace diptych::cli {
namespace {

namespace fs = std::filesystem;

// One scene's row on the page of all scenes.
struct Swept {
    std::string scene, folder, device;
    std::size_t rows = 0, front = 0;
    double fastest_ms = 0, fastest_flip = 0, best_ms = 0, best_flip = 0;
};

using Place = JsonAt<nlohmann::json>;

Swept sweptOf(const shards::Item& item, const Place& json) {
    Swept swept{item.scene, item.folder, json.at("device").textOr("name", "")};
    const std::vector<Place> rows = json.at("rows").each();
    swept.rows = rows.size();
    for (const Place& front : json.at("fronts").each())
        if (front.at("error").text() == "flip" && front.at("path").json().is_null())
            swept.front = front.at("rows").size();
    bool first = true;
    for (const Place& row : rows) {
        const double ms = row.at("ms").at("median").number();
        const Place error = row.at("errors").at("flip");
        const double flip = error.json().is_number() ? error.number() : 1e300;
        if (first || ms < swept.fastest_ms)
            std::tie(swept.fastest_ms, swept.fastest_flip) = std::pair(ms, flip);
        if (first || flip < swept.best_flip) std::tie(swept.best_ms, swept.best_flip) = std::pair(ms, flip);
        first = false;
    }
    return swept;
}

// Reads a scene's tradeoff below `root`; throws if the file is not a tradeoff.
Swept sweptIn(const fs::path& root, const shards::Item& item) {
    const std::string name = item.folder + tradeoff::tradeoffManifest;
    return named((root / name).string(), [&] {
        const nlohmann::json json = parseJson(textBelow(root, name, json_bytes));
        const Place top(json);
        if (top.textOr("software", "") != softwareName) fail("is not a report of tradeoff");
        return sweptOf(item, top);
    });
}

std::string pageOf(const std::vector<Swept>& all, const std::vector<SceneError>& errors) {
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
    for (const SceneError& error : errors) failed.items.emplace_back(errorText(error));
    if (!errors.empty())
        page.blocks.emplace_back(output::Box{"box failures", {output::Heading{4, "Failures"}, failed}});
    page.blocks.emplace_back(output::Box{"index", {table}});
    return inHtml(page);
}

// Writes the page and the manifest, and returns the manifest. Called first without scenes, which marks the
// folder as ours, and again with all scenes.
std::string writePage(const Options& options, const fs::path& folder, const shards::Manifest& manifest,
                      const std::vector<const shards::Item*>& done) {
    std::vector<Swept> swept;
    for (const shards::Item* item : done) swept.push_back(sweptIn(folder, *item));
    ListedFolder out(folder, tradeoffsManifest, options.force);
    out.put("index.html", pageOf(swept, manifest.errors));
    nlohmann::ordered_json json = parseOrderedJson(textOf(manifest));
    json["scenes"] = nlohmann::ordered_json::array();
    for (const Swept& one : swept)
        json["scenes"].push_back({{"scene", one.scene},
                                  {"folder", one.folder},
                                  {"device", one.device},
                                  {"rows", one.rows},
                                  {"front", one.front},
                                  {"fastest", {{"ms", one.fastest_ms}, {"flip", one.fastest_flip}}},
                                  {"most_accurate", {{"ms", one.best_ms}, {"flip", one.best_flip}}}});
    return out.finish(std::move(json));
}

void showMany(const Options& options, const fs::path& folder, const shards::Manifest& manifest,
              const std::vector<const shards::Item*>& done) {
    const std::string text = writePage(options, folder, manifest, done);
    if (options.json)
        printText(text);
    else if (!options.quiet)
        printOut("{}: {}\n", counted(done.size(), "scene"), (folder / "index.html").string());
}

int finish(const Options& options, const fs::path& folder, const shards::Manifest& manifest,
           const std::vector<const shards::Item*>& done) {
    showMany(options, folder, manifest, done);
    sayErrors(manifest.errors);
    return manifest.errors.empty() ? 0 : 2;
}

}  // namespace

int tradeoffMany(const Options& options, const fs::path& folder,
                 const std::function<void(const Options&)>& sweep) {
    const SceneItems items = itemsOf(options, {options.settings});
    CheckpointFolder kept(folder, "scenes", resumeKey(options, {options.settings}));
    shards::Manifest manifest{shards::buildName(), "tradeoff", items.plan, items.shard, items.all, {}};
    std::vector<const shards::Item*> done;
    if (!isOurManifest(folder / tradeoffsManifest)) writePage(options, folder, manifest, {});
    for (const shards::Item* item : items.mine) {
        const std::string folder_name =
            item->folder.empty() ? sceneFolders({item->scene}).front() : item->folder;
        const std::string name = folder_name.substr(0, folder_name.size() - 1) + "-scene";
        if (kept.find(name) == stampOf(item->scene) &&
            isOurManifest(folder / item->folder / tradeoff::tradeoffManifest)) {
            done.push_back(item);
            continue;
        }
        Options one = options;
        one.scenes = {item->scene};
        one.out = folder / (item->folder.empty() ? "." : item->folder);
        one.json = false;
        one.quiet = options.quiet || options.json;
        try {
            sweep(one);
            kept.keep(name, stampOf(item->scene));
            done.push_back(item);
        } catch (const std::system_error&) {
            throw;  // errors of this machine, such as a full disk, end the command
        } catch (const std::runtime_error& error) {
            manifest.errors.push_back({item->scene, error.what()});
            say(options, fmt::format("{}; continuing with the other scenes", error.what()));
        }
    }
    if (done.empty() && !manifest.errors.empty() && options.shard.empty())
        throw std::runtime_error(fmt::format("none of {} can be rendered; the first: {}",
                                             counted(items.all.size(), "scene"),
                                             manifest.errors.front().message));
    const int code = finish(options, folder, manifest, done);
    kept.remove();
    return code;
}

int mergeTradeoffs(const Options& options) {
    const fs::path folder = outputFolder(options, "diptych-tradeoff", "tradeoff", tradeoffsManifest);
    shards::Chosen chosen = shards::choose({options.scenes.begin(), options.scenes.end()}, tradeoffsManifest);
    std::vector<const shards::Item*> done;
    writePage(options, folder, chosen.manifest, {});
    for (const shards::Item& item : chosen.manifest.items) {
        if (const std::optional<SceneError> error = chosen.errorOf(item)) {
            chosen.manifest.errors.push_back(*error);
            continue;
        }
        const fs::path& from = chosen.folders.at(item.shard);
        const std::string manifest = item.folder + tradeoff::tradeoffManifest;
        std::vector<std::string> names = listedIn(from / manifest);
        std::erase(names, tradeoff::tradeoffManifest);
        try {
            sweptIn(from, item);
            for (const std::string& name : names)
                named((from / item.folder / name).string(), [&] { InputFile(from, item.folder + name); });
        } catch (const std::runtime_error& problem) {
            chosen.problems.push_back(
                fmt::format("{}: the tradeoff is incomplete: {}", from.string(), problem.what()));
            chosen.manifest.errors.push_back({item.scene, problem.what()});
            continue;
        }
        ListedFolder out(folder / item.folder, tradeoff::tradeoffManifest, options.force);
        for (const std::string& name : names) {
            copyBelow(from, item.folder + name, out / name);
            out.list(name);
        }
        out.finish(shownText(textBelow(from, manifest, json_bytes)));
        done.push_back(&item);
    }
    const shards::Manifest manifest = chosen.manifest;
    if (chosen.problems.empty()) return finish(options, folder, manifest, done);
    showMany(options, folder, manifest, done);
    sayProblems(options, chosen.problems, folder / "index.html");
    return 2;
}

}  // namespace diptych::cli
