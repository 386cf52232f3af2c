// SPDX-License-Identifier: MIT
// Many comparisons in four shards: the cost of merging them, and their page in a browser. A full run has two
// thousand.
#include "compare/report/folders.h"
#include "compare/report/whole_report.h"
#include "compare/shards/manifest.h"
#include "tests/support/campaign.h"
#include "tests/tool/page_builder.h"

#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <chrono>

namespace diptych {
namespace {

const std::size_t manyCount = isCampaign() ? 2000 : 500;
constexpr std::size_t manyShards = 4;

// Every tenth comparison fails, in roughness, by an amount that grows with its index; lit differs in all.
std::vector<Frame> numberedPair(std::size_t i, const std::string& scene) {
    std::vector<Frame> pair = bothFrames(scene);
    for (Frame& frame : pair) {
        frame.settings.camera = i % 2 == 0 ? "" : "1";
        // Few channels: making these reports takes longer than the test itself.
        frame.requested = {Channel::lit, Channel::normals, Channel::roughness, Channel::depth};
        std::erase_if(frame.channels, [&](const auto& channel) {
            return !frame.isRequested(channel.first) && channel.first != Channel::material_id;
        });
    }
    if (i % 10 == 7) pair[1].channels.at(Channel::roughness).at(1, 2) = 0.51f + 1e-4f * static_cast<float>(i);
    for (Frame& frame : pair)
        if (frame.settings.path == Path::forward_plus)
            frame.channels.at(Channel::lit).at(1, 2, 0) += 1e-5f * static_cast<float>(i % 97);
    pair[1].through_gbuffer = pair[0].channels;
    return pair;
}

// The reports of four shards, as the program writes them.
void makeShards(const Folder& folder) {
    std::vector<std::string> scenes;
    for (std::size_t i = 0; i < manyCount; ++i) scenes.push_back(fmt::format("scenes/{}/{}.glb", i / 100, i));
    const std::vector<std::string> folders = sceneFolders(scenes);
    shards::Manifest manifest{shards::buildName(), "compare", {{"asked", {{"keep", 1}}}}, {}, {}, {}};
    for (std::size_t i = 0; i < manyCount; ++i)
        manifest.items.push_back({scenes[i], folders[i], static_cast<int>(i % manyShards) + 1});
    for (std::size_t shard = 0; shard < manyShards; ++shard) {
        const fs::path root = folder / fmt::format("parts-{}", shard);
        ReportOptions options;
        options.keep = Keep::failing;
        WholeReport whole;
        for (std::size_t i = shard; i < manyCount; i += manyShards) {
            options.scene_folder = folders[i];
            whole.parts.push_back({writePart(reportOf(numberedPair(i, scenes[i])), root, options), root});
        }
        options.scene_folder.reset();
        manifest.shard = {static_cast<int>(shard) + 1, static_cast<int>(manyShards)};
        whole.shard = textOf(manifest);
        writeWhole(whole, joinedOf(whole), folder / fmt::format("shard-{}", shard + 1), options);
    }
}

struct UsedByTool {
    int code = -1;
    double seconds = 0, megabytes = 0;
};

// Resources of the tool, run in a process of its own.
UsedByTool runAlone(const Folder& folder, const std::string& arguments) {
    const auto start = std::chrono::steady_clock::now();
    const pid_t process = ::fork();
    if (process == 0) {
        ::execl("/bin/sh", "sh", "-c",
                ("cd '" + folder.path().string() + "' && exec '" DIPTYCH_PROGRAM "' " + arguments).c_str(),
                nullptr);
        ::_exit(127);
    }
    int status = 0;
    struct rusage usage {};
    ::wait4(process, &status, 0, &usage);
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1,
            std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(),
            static_cast<double>(usage.ru_maxrss) / 1024};
}

const char* const lookAtMany = R"(
  await until(() => document.readyState === 'complete');
  const lines = $$('.index tbody tr'), visible = () => lines.filter(line => !line.hidden);
  const told = { ms: performance.getEntriesByType('navigation')[0].domComplete, lines: lines.length };
  told.loaded = $$('img').filter(image => image.complete && image.naturalWidth).length;
  told.images = $$('img').length;
  const set = (by, value) => {
    const s = $(`.index select[data-by="${by}"]`);
    s.value = value;
    s.dispatchEvent(new Event('change'));
  };
  set('verdict', 'fail'); told.failing = visible().length;
  set('camera', '1'); told.ofCamera = visible().length;
  set('camera', 'default view'); told.ofOther = visible().length; set('camera', '');
  set('channel', 'lit'); told.litFails = visible().length;
  set('channel', 'roughness'); told.roughnessFails = visible().length;
  set('figure', 'mean');
  told.head = [...$$('.index th')].map(h => h.textContent).find(t => t.includes('mean'));
  const head = [...$$('.index th')].find(h => h.textContent.includes('mean'));
  head.click(); told.first = $$('.index tbody tr')[0].cells[1].textContent;
  head.click(); set('verdict', ''); set('channel', '');
  const filter = $('.index [type=search]');
  filter.value = LAST;
  filter.dispatchEvent(new Event('input', { bubbles: true }));
  told.found = visible().length;
  location.hash = '#s100';
  told.arrived = await until(() => $('#s100')) && $('#s100 h2').textContent;
  location.hash = '#c101-lit';
  told.card = await until(() => $('#c101-lit')) && $('#c101-lit').closest('.comparison').id;
  await wait(300); told.address = location.search;
  tell(told);)";

TEST(MergeMany, TakesLittleMemoryAndThePageIsWhole) {
    const Folder folder;
    makeShards(folder);
    const UsedByTool used = runAlone(folder, "merge -q shard-3 shard-1 shard-4 shard-2 -o all");
    EXPECT_EQ(used.code, 1) << "a tenth fails";
    std::cout << fmt::format("merge of {}: {:.2f} s, {:.0f} MB\n", manyCount, used.seconds, used.megabytes);
    // The duration is printed but not asserted: machines are shared.
#if !defined(__SANITIZE_ADDRESS__)
    // It takes 18 MB for one comparison, and 64 for two thousand.
    EXPECT_LT(used.megabytes, 40 + 0.05 * static_cast<double>(manyCount));
#endif
    const UsedByTool trends =
        runAlone(folder, "merge -q shard-1 shard-2 shard-3 shard-4 -o again --since all");
    std::cout << fmt::format("with --since: {:.2f} s, {:.0f} MB\n", trends.seconds, trends.megabytes);
    EXPECT_EQ(trends.code, 1);
    const auto json = nlohmann::json::parse(contentsOf(folder / "again/report.json"));
    EXPECT_EQ(json["comparisons"].size(), manyCount);
    EXPECT_TRUE(json["since"]["comparisons"].empty()) << json["since"].dump(1).substr(0, 500);
    SKIP_WITHOUT_BROWSER();
    const std::size_t last = manyCount - 3;  // the last comparison that fails
    const Visit seen =
        visit(folder, folder / "all/index.html", fmt::format("const LAST = '{}.glb';", last) + lookAtMany);
    EXPECT_EQ(seen.console, "");
    const nlohmann::json& told = seen.told;
    ASSERT_TRUE(told.is_object()) << told;
    std::cout << fmt::format("the page opens in {:.0f} ms\n", told["ms"].get<double>());
    EXPECT_EQ(told["lines"], manyCount);
    EXPECT_LT(told["images"], 1000) << "of four comparisons";
    EXPECT_LE(told["loaded"], told["images"]);
    EXPECT_EQ(told["failing"], manyCount / 10);
    EXPECT_EQ(told["ofCamera"], manyCount / 10) << "7, 17, ... are odd";
    EXPECT_EQ(told["ofOther"], 0);
    EXPECT_EQ(told["litFails"], 0);
    EXPECT_EQ(told["roughnessFails"], manyCount / 10);
    EXPECT_EQ(told["head"], "roughness mean");
    EXPECT_EQ(told["first"], fmt::format("{}/{}.glb", last / 100, last)) << "the largest first";
    EXPECT_EQ(told["found"], 1);
    EXPECT_EQ(told["arrived"], "1/100.glb \u00b7 default view") << "a section that knew neither";
    EXPECT_EQ(told["card"], "s101");
}

}  // namespace
}  // namespace diptych
