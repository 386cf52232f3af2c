// SPDX-License-Identifier: MIT
// Printed commands keep their meaning when they are parsed again.
#include "compare/run/command_text.h"
#include "tests/support/command_lines.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <string>
#include <vector>

namespace diptych {

using namespace cli;

namespace {

// Splits a line into words as a shell does.
std::vector<std::string> wordsOfShell(const std::string& line) {
    const std::string script = "set -- " + line + "\nfor word; do printf '%s\\0' \"$word\"; done";
    std::string quoted = "'";
    for (const char c : script) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
    std::FILE* pipe = popen(("sh -c " + quoted + "'").c_str(), "r");
    std::vector<std::string> words(1);
    for (int c = std::fgetc(pipe); c != EOF; c = std::fgetc(pipe))
        if (c == 0)
            words.emplace_back();
        else
            words.back() += static_cast<char>(c);
    pclose(pipe);
    words.pop_back();
    return words;
}

SceneGroup parsedAgain(const std::string& line) {
    std::vector<std::string> words = wordsOfShell(line);
    EXPECT_EQ(words.front(), "diptych");
    words.erase(words.begin());
    return parsedAs<SceneGroup>(words);
}

// Settings with one changed value each, and with all changed; values that a shell or an option parser
// could misread.
std::vector<Settings> severalSettings() {
    std::vector<Settings> all(1);
    const auto add = [&](auto change) {
        Settings one;
        change(one);
        change(all[0]);
        all.push_back(one);
    };
    add([](Settings& s) { s.path = Path::deferred; });
    add([](Settings& s) { s.prepass = Switch::off; });
    add([](Settings& s) { s.gbuffer = GBufferEncoding::full; });
    add([](Settings& s) { s.size = {1920, 17}; });
    add([](Settings& s) { s.camera = "it's \"$HOME\" `x` *\\"; });
    add([](Settings& s) { s.time = -1.0 / 3.0; });
    add([](Settings& s) { s.animation = "-run `it's` $1"; });
    add([](Settings& s) { s.variant = "-red 'n' $blue"; });
    add([](Settings& s) { s.skinning = Skinning::vertex; });
    add([](Settings& s) { s.skin_normals = SkinNormals::blended; });
    add([](Settings& s) { s.env = "-sky.exr"; });
    add([](Settings& s) { s.env = ""; });
    add([](Settings& s) { s.ibl_intensity = 0.1f; });
    add([](Settings& s) { s.ambient = {-1e-30f, 0.3f, 16777217.0f}; });
    add([](Settings& s) { s.lights = "point:64,spot:16"; });
    add([](Settings& s) { s.seed = 4294967295u; });
    add([](Settings& s) { s.shadows = Shadows::clipmap; });
    add([](Settings& s) { s.transparency = Transparency::unsorted; });
    add([](Settings& s) { s.transparency = Transparency::triangles; });
    add([](Settings& s) { s.msaa = 4, s.msaa_shading = MsaaShading::sample; });
    add([](Settings& s) { s.msaa = 4, s.msaa_edges = MsaaEdges::coverage; });
    add([](Settings& s) { s.msaa = 4, s.resolve = Resolve::tonemapped; });
    add([](Settings& s) { s.haze = true; });
    add([](Settings& s) { s.reference_mode = ReferenceMode::scene; });
    all.emplace_back();
    return all;
}

TEST(CommandArguments, TheCommandOfSettingsMeansTheSameSettings) {
    const std::vector<std::string> scenes{"builtin:gallery", "my scenes/a b.glb?scene=2", "-odd.glb"};
    std::size_t index = 0;
    for (const Settings& settings : severalSettings()) {
        const std::string& scene = scenes[++index % scenes.size()];
        const std::string line = commandOf("render", scene, settings);
        EXPECT_TRUE(line.starts_with("diptych render ")) << line;
        const SceneGroup again = parsedAgain(line);
        EXPECT_EQ(again.settings, settings) << line;
        EXPECT_EQ(again.cameras, std::vector<std::string>{settings.camera}) << line;
        EXPECT_EQ(again.scenes, std::vector<std::string>{scene}) << line;
    }
}

TEST(CommandArguments, OnlyWhatIsNotTheDefaultIsSaid) {
    EXPECT_EQ(commandOf("compare", "builtin:gallery", {}), "diptych compare builtin:gallery");
    Settings settings;
    settings.path = Path::deferred;
    settings.gbuffer = GBufferEncoding::compact;
    EXPECT_EQ(commandOf("compare", "a b.glb", settings), "diptych compare --gbuffer compact 'a b.glb'")
        << "compare draws both paths";
    EXPECT_EQ(commandOf("render", "a.glb", settings),
              "diptych render --path deferred --gbuffer compact a.glb");
}

TEST(CommandArguments, WordsAreQuotedWhereAShellWouldReadThem) {
    const std::string plain = "azAZ09_-+=:,./@%";
    EXPECT_EQ(shellWord(plain), plain);
    EXPECT_EQ(shellWord(""), "''");
    EXPECT_EQ(shellWord("it's"), "'it'\\''s'");
    for (const char c : std::string(" !\"#$&()*;<>?[\\]^`{|}~\t\n\xc3"))
        EXPECT_EQ(shellWord(std::string("a") + c), std::string("'a") + c + "'");
    EXPECT_EQ(shellLine({"render", "a b"}), "diptych render 'a b'");
}

TEST(CommandArguments, AnOptionCanBeAddedWhateverTheSceneIsCalled) {
    EXPECT_EQ(withArguments({"view", "--", "-a.glb"}, {"--pixel", "3,4", "-v"}),
              (std::vector<std::string>{"view", "--pixel", "3,4", "-v", "--", "-a.glb"}));
    for (const std::string scene : {"a.glb", "--help"}) {
        const SceneGroup again = parsedAgain(
            shellLine(withOption(commandArguments("compare", scene, {}), "--channels", "normals")));
        EXPECT_EQ(again.channels, std::vector{Channel::normals});
        EXPECT_EQ(again.scenes, std::vector<std::string>{scene});
    }
}

}  // namespace
}  // namespace diptych
