// SPDX-License-Identifier: MIT
// Checkpointed rows of a sweep, and the rows that a resumed program accepts.
#include "compare/tradeoff/sweep_state.h"

#include "tests/support/files.h"

#include <stdexcept>

namespace diptych::tradeoff {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

const Json key{{"software", "diptych"}, {"schema", 1}, {"scene", "a.glb"}};

Settings settingsOf(std::uint32_t seed) {
    Settings settings;
    settings.seed = seed;
    return settings;
}

// Stores a measured row and returns its name: that of its files without their extensions.
std::string kept(SweepState& state, const Settings& settings) {
    MeasuredRow measured;
    measured.row.settings = settings;
    measured.row.cameras.resize(1);
    measured.row.cameras[0].blocks = {{2, 1, 3, 5}};
    measured.row.drawing_ms = 8;
    measured.image = measured.errors = Image8{1, 1, 3, {1, 2, 3}};
    state.keep(measured);
    return fs::path(measured.row.image).stem();
}

TEST(TradeoffState, ARowIsFoundByItsSettings) {
    const fs::path out = folder() / "out";
    {
        SweepState state(out, key);
        kept(state, settingsOf(1));
        EXPECT_FALSE(state.find(settingsOf(2), 1, 2));
    }
    SweepState state(out, key);
    EXPECT_FALSE(state.isRenewed());
    const auto row = state.find(settingsOf(1), 1, 2);
    ASSERT_TRUE(row);
    EXPECT_EQ(row->settings, settingsOf(1));
    EXPECT_EQ(row->drawing_ms, 8);
    EXPECT_TRUE(fs::exists(state / row->image));
    EXPECT_FALSE(state.find(settingsOf(2), 1, 2));
}

// A row counts if it has these Settings and its own complete images.
TEST(TradeoffState, ARowThatIsNotWholeIsMeasuredAgain) {
    SweepState state(folder() / "out", key);
    const std::string name = kept(state, settingsOf(1)), other = kept(state, settingsOf(2));
    const Json whole = Json::parse(contentsOf(state / (name + ".json")));
    const auto isFound = [&](const std::string& text) {
        std::ofstream(state / (name + ".json")) << text;
        return state.find(settingsOf(1), 1, 2).has_value();
    };
    const auto with = [&](const char* member, const Json& value) {
        Json changed = whole;
        changed.at(member) = value;
        return changed.dump();
    };
    EXPECT_TRUE(isFound(whole.dump()));
    EXPECT_FALSE(
        isFound(with("settings", Json::parse(contentsOf(state / (other + ".json"))).at("settings"))));
    EXPECT_FALSE(isFound(with("picture", other + ".png")));
    EXPECT_FALSE(isFound(with("error_picture", other + ".flip.png")));
    EXPECT_FALSE(isFound(whole.dump().substr(0, 100)));
    EXPECT_FALSE(isFound("{}"));
    const auto visited = [&](int times) {
        Json cameras = whole.at("cameras");
        cameras[0]["visits"] = Json::array();
        for (int i = 0; i < times; ++i) cameras[0]["visits"].push_back(whole.at("cameras")[0]["visits"][0]);
        return cameras;
    };
    EXPECT_FALSE(isFound(with("cameras", visited(0))));
    EXPECT_TRUE(isFound(with("cameras", visited(2))));
    EXPECT_FALSE(isFound(with("cameras", visited(3)))) << "more often than a row is";
    EXPECT_FALSE(isFound(with("cameras", Json::array())));
    EXPECT_FALSE(isFound(with("cameras", {visited(1)[0], visited(1)[0]})))
        << "from another number of cameras";
    for (const char* ending : {".png", ".flip.png"}) {
        fs::rename(state / (name + ending), state / "aside.png");
        EXPECT_FALSE(isFound(whole.dump())) << ending;
        fs::rename(state / "aside.png", state / (name + ending));
    }
    EXPECT_TRUE(isFound(whole.dump()));
}

TEST(TradeoffState, RowsOfAnotherKeyAreRemoved) {
    const fs::path out = folder() / "out";
    {
        SweepState state(out, key);
        kept(state, settingsOf(1));
    }
    Json other = key;
    other["scene"] = "b.glb";
    SweepState state(out, other);
    EXPECT_TRUE(state.isRenewed());
    EXPECT_FALSE(state.find(settingsOf(1), 1, 2));
    EXPECT_EQ(namesIn(SweepState::folderOf(out)), std::vector<std::string>{"key.json"});
    state.remove();
    EXPECT_FALSE(fs::exists(SweepState::folderOf(out)));
}

TEST(TradeoffState, AFolderOfOthersIsLeftAlone) {
    const fs::path out = folder() / "out", place = SweepState::folderOf(out);
    fs::create_directories(place);
    std::ofstream(place / "notes.txt") << "mine";
    EXPECT_THROW(SweepState(out, key), std::runtime_error);
    EXPECT_EQ(contentsOf(place / "notes.txt"), "mine");
}

TEST(TradeoffState, OneProgramAtATimeHoldsIt) {
    const fs::path out = folder() / "out";
    const SweepState state(out, key);
    EXPECT_THROW(SweepState(out, key), std::runtime_error);
}

}  // namespace
}  // namespace diptych::tradeoff
