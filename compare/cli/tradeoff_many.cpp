// SPDX-License-Identifier: MIT
#include "compare/cli/tradeoff_many.h"

#include "compare/cli/commands.h"
#include "compare/cli/scene_items.h"
#include "compare/files/checkpoint_folder.h"
#include "compare/files/listed_folder.h"
#include "compare/files/our_files.h"
#include "compare/files/output_folder.h"
#include "compare/report/titles.h"
#include "compare/run/print.h"
#include "compare/shards/merge.h"
#include "compare/tradeoff/all_scenes.h"
#include "compare/tradeoff/tradeoff.h"
#include "shared/text/counted.h"
#include "shared/text/input_file.h"
#include "shared/text/json.h"
#include "shared/text/one_line.h"
#include "shared/text/open_folder.h"

#include <fmt/format.h>

#include <cerrno>
#include <optional>
#include <stdexcept>
#include <utility>

namespace diptych::cli {
namespace {

namespace fs = std::filesystem;

// Writes the page and the manifest, and returns the manifest. Called first without scenes, which marks the
// folder as ours, and again with all scenes.
std::string writePage(const Options& options, const fs::path& folder, const shards::Manifest& manifest,
                      const std::vector<const shards::Item*>& done) {
    std::vector<tradeoff::SweptScene> scenes;
    for (const shards::Item* item : done) scenes.push_back({item->scene, item->folder});
    std::vector<std::string> failures;
    for (const SceneError& error : manifest.errors) failures.push_back(errorText(error));
    return tradeoff::writeAllScenes(folder, parseOrderedJson(textOf(manifest)), scenes, failures,
                                    options.force);
}

void showMany(const Options& options, const fs::path& folder, const shards::Manifest& manifest,
              const std::vector<const shards::Item*>& done) {
    const std::string text = writePage(options, folder, manifest, done);
    if (options.json)
        printText(text);
    else if (!options.quiet)
        printOut("{}: {}\n", counted(done.size(), "scene"), (folder / "index.html").string());
}

// Scenes' outputs are written below it without following links.
OpenFolder heldOutput(const fs::path& folder) {
    OpenFolder open = OpenFolder::at(folder);
    if (!open.isOpen()) throw std::runtime_error(writingFailed(folder, errno));
    open.hold();
    return open;
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
    const shards::SceneItems items = itemsOf(options, {options.settings});
    CheckpointFolder kept(folder, "scenes", resumeKey(options, {options.settings}));
    shards::Manifest manifest{shards::buildName(), "tradeoff", items.plan, items.shard, items.all, {}};
    std::vector<const shards::Item*> done;
    if (!isOurManifest(folder / tradeoff::tradeoffsManifest)) writePage(options, folder, manifest, {});
    const OpenFolder scenes = heldOutput(folder);
    for (const shards::Item* item : items.mine) {
        const std::string name = shards::partOf(*item);
        if (kept.find(name) == shards::stampOf(item->scene) &&
            isOurManifest(folder / item->folder / tradeoff::tradeoffManifest)) {
            done.push_back(item);
            continue;
        }
        Options one = options;
        one.scenes = {item->scene};
        one.out = folder / (item->folder.empty() ? "." : item->folder);
        one.json = false;
        one.quiet = options.quiet || options.json;
        const auto error = shards::attempt(item->scene, [&] {
            sweep(one);
            kept.keep(name, shards::stampOf(item->scene));
            done.push_back(item);
        });
        if (!error) continue;
        manifest.errors.push_back(*error);
        say(options, fmt::format("{}; continuing with the other scenes", error->message));
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
    const fs::path folder =
        outputFolder(options, "diptych-tradeoff", "tradeoff", tradeoff::tradeoffsManifest);
    shards::Chosen chosen =
        shards::choose({options.scenes.begin(), options.scenes.end()}, tradeoff::tradeoffsManifest);
    std::vector<const shards::Item*> done;
    writePage(options, folder, chosen.manifest, {});
    const OpenFolder scenes = heldOutput(folder);
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
            tradeoff::checkSwept(from, {item.scene, item.folder}, names);
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
