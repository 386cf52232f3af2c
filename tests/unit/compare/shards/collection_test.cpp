// SPDX-License-Identifier: MIT
// The parts that an interrupted run of many scenes left.
#include "compare/shards/collection.h"
#include "tests/support/shards_builder.h"

#include <gtest/gtest.h>

namespace diptych {
namespace {

using namespace shards;
namespace fs = std::filesystem;

// Whole parts of unchanged scenes are used, damaged ones are named, and without a part nothing is said.
TEST(Collection, PartsOfAnInterruptedRunAreKeptOrNamed) {
    const fs::path root = folder();
    const CheckpointFolder checkpoints(root / "out", "scenes", "key");
    SceneItems items;
    for (const char* name : {"whole", "damaged", "changed", "unfinished", "missing"}) {
        const std::string scene = (root / name).string() + ".gltf";
        std::ofstream(scene) << "{}";
        items.all.push_back({scene, name + std::string("/")});
    }
    for (const Item& item : items.all) items.mine.push_back(&item);
    std::vector<std::string> notes;
    const auto kept = [&] {
        notes.clear();
        return keptParts(checkpoints, items, [&](const std::string& line) { notes.push_back(line); });
    };
    EXPECT_TRUE(kept().empty());
    EXPECT_TRUE(notes.empty());
    for (const Item& item : std::span(items.all).first(4)) {
        ReportOptions options;
        options.scene_folder = item.folder;
        writePart(smallReport(item.scene), checkpoints.path(), options);
        if (item.folder != "unfinished/") checkpoints.keep(partOf(item), stampOf(item.scene));
    }
    std::ofstream(items.all[2].scene) << "{\"asset\": {}}";
    const std::string three = "3 of 5 scenes are kept from an interrupted run",
                      two = "2 of 5 scenes are kept from an interrupted run";
    EXPECT_EQ(kept().size(), 2u);
    EXPECT_EQ(notes, std::vector{two}) << "one changed, one without a stamp, one without a part";
    checkpoints.keep(partOf(items.all[3]), stampOf(items.all[3].scene));
    EXPECT_EQ(kept().size(), 3u);
    EXPECT_EQ(notes, std::vector{three});
    fs::remove(checkpoints.path() / "unfinished/part.json");
    const fs::path image = checkpoints.path() / "damaged/lit.png";
    ASSERT_TRUE(fs::remove(image));
    const std::map<const Item*, ReportPart> parts = kept();
    ASSERT_EQ(parts.size(), 1u);
    EXPECT_EQ(parts.begin()->first, &items.all[0]);
    EXPECT_EQ(parts.begin()->second.scene_folder, "whole/");
    EXPECT_EQ(notes, (std::vector<std::string>{image.string() + ": no such file; comparing the scene again",
                                               "1 of 5 scenes are kept from an interrupted run"}));
    fs::remove_all(checkpoints.path() / "whole");
    EXPECT_TRUE(kept().empty());
    EXPECT_EQ(notes.size(), 1u) << "of the damaged one";
}

}  // namespace
}  // namespace diptych
