// SPDX-License-Identifier: MIT
// Untrusted text that could control a terminal or a page, and standard descriptors that are closed at
// start.
#include "shared/image/exr.h"
#include "shared/text/one_line.h"
#include "tests/tool/browser.h"
#include "tests/tool/fake_renderer.h"

#include <algorithm>
#include <sstream>
#include <string_view>
#include <vector>

namespace diptych {
namespace {

using Json = nlohmann::json;

// ESC, C1's CSI, and bidirectional controls, as a file name may contain them.
const std::string evil = "e\x1b]0;owned\x07\u009b31m\u202egpj\u2066\u200f\x7f";
const std::string howSmall = " --size 16x9 --runs 0 --channels lit ";

// Whether the text has only printable characters and newlines; otherwise, the position of the first other.
testing::AssertionResult isPlain(const std::string& text) {
    for (std::string_view rest = text; !rest.empty();) {
        const auto [code, size] = characterAt(rest);
        const auto in = [code = code](char32_t first, char32_t last) {
            return first <= code && code <= last;
        };
        if (size == 0 || in(0, 0x09) || in(0x0b, 0x1f) || in(0x7f, 0x9f) || in(0x061c, 0x061c) ||
            in(0x200e, 0x200f) || in(0x2028, 0x202e) || in(0x2066, 0x2069))
            return testing::AssertionFailure() << "a control in: " << ::testing::PrintToString(text);
        rest.remove_prefix(size);
    }
    return testing::AssertionSuccess();
}

testing::AssertionResult isPlain(const Ran& ran) {
    const testing::AssertionResult out = isPlain(ran.out);
    return out ? isPlain(ran.err) : out;
}

const std::string triangle = R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0,1]}],
"nodes":[{"mesh":0,"name":"NAME"},{"camera":0,"translation":[0,0,3],"name":"NAME"}],
"cameras":[{"type":"perspective","perspective":{"yfov":1,"znear":0.1,"zfar":10},"name":"NAME"}],
"materials":[{"name":"NAME","extensions":{"NAME":{}}}],"extensionsUsed":["NAME"],
"meshes":[{"primitives":[{"attributes":{"POSITION":0},"material":0}]}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]}],
"bufferViews":[{"buffer":0,"byteLength":36}],
"buffers":[{"byteLength":36,
"uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})";

std::string evilTriangle() {
    const std::string name = R"(n\u001b]0;owned\u0007\u009b31m\u202egpj\u2066\nFAIL all)";
    std::string text = triangle;
    for (std::size_t at = text.find("NAME"); at != text.npos; at = text.find("NAME", at + name.size()))
        text.replace(at, 4, name);
    return text;
}

TEST(Terminal, NamesInAFolderOfScenesPassAFilter) {
    const Folder folder;
    folder.write("scenes/" + evil + ".gltf", evilTriangle());
    folder.write("scenes/broken" + evil + ".gltf", "{\"a" + evil + "\": ");
    const Ran ran = runTool(folder, "compare scenes" + howSmall + "-v -o report");
    EXPECT_EQ(ran.code, 2) << ran.err;
    EXPECT_NE(ran.out.find("e\\u001b]0;owned\\u0007\\u009b31m\\u202egpj\\u2066\\u200f\\u007f.gltf"),
              std::string::npos)
        << ran.out;
    EXPECT_TRUE(isPlain(ran));
    for (const char* file : {"report/index.html", "report/junit.xml"})
        EXPECT_TRUE(isPlain(contentsOf(folder / file))) << file;
    EXPECT_NE(contentsOf(folder / "report/index.html").find("<bdi>"), std::string::npos);
    const Ran json = runTool(folder, "compare scenes" + howSmall + "--json -o report");
    EXPECT_TRUE(isPlain(json));
    const Json report = Json::parse(json.out, nullptr, false);
    ASSERT_TRUE(report.is_object()) << "still JSON";
    EXPECT_EQ(report["frames"][0]["scene"], "scenes/" + evil + ".gltf") << "and the very name";
    for (const char* command : {"render", "plan", "explain"})
        EXPECT_TRUE(isPlain(runTool(folder, command + (" 'scenes/" + evil + ".gltf'" +
                                                       (command == std::string("plan") ? "" : howSmall)))))
            << command;
}

TEST(Terminal, ALineBreakInANameIsRefused) {
    const Folder folder;
    folder.write("scenes/a.glb\npass: all.gltf", "{}");
    const Ran ran = runTool(folder, "compare scenes -o report");
    EXPECT_TRUE(ran.failedOver("scenes/a.glb?pass: all.gltf: has a line break in its name; rename it"));
    EXPECT_TRUE(runTool(folder, "plan 'scenes/a.glb\npass: all.gltf'").failedOver("a line break"));
    folder.write("left/a\nb.png", "");
    EXPECT_TRUE(runTool(folder, "diff left left").failedOver("a?b.png: has a line break"));
}

TEST(Terminal, ArgumentsInErrorsPassAFilterAndAreCut) {
    const Folder folder;
    for (const std::string& sentence : std::vector<std::string>{
             "compare '" + evil + ".gltf'", "compare --" + std::string("size '") + evil + "'",
             "'" + evil + "'", "compare '--" + evil + "'", "compare --device '" + evil + "'",
             "diff '" + evil + ".exr' b.exr", "merge '" + evil + "'", "compare --settings '" + evil + "'",
             "compare '@" + evil + "'", "diff '\xff\xfe.exr' b.exr"}) {
        const Ran ran = runTool(folder, sentence);
        EXPECT_EQ(ran.code, 2) << sentence;
        EXPECT_TRUE(isPlain(ran)) << sentence;
    }
    const Ran json = runTool(folder, "compare --json '" + evil + ".gltf'");
    EXPECT_TRUE(isPlain(json));
    EXPECT_TRUE(Json::accept(json.out));
    folder.write("long.json", "{\"" + std::string(5'000'000, 'x') + "\": 1}");
    for (const std::string& sentence :
         std::vector<std::string>{"diff a b --tolerances long.json", "compare --settings long.json",
                                  "compare '" + std::string(100'000, 'x') + "'"}) {
        const Ran ran = runTool(folder, sentence);
        EXPECT_EQ(ran.code, 2);
        EXPECT_LT(ran.err.size(), 2000u) << sentence.substr(0, 40);
    }
}

TEST(Terminal, NamesOfLayersPassAFilter) {
    const Folder folder;
    Image rgb(4, 3, 3), other(4, 3, 3);
    std::ranges::fill(other.data, 0.5f);
    const std::string& layer = evil;
    writeExr(folder / "a.exr", {{{"R", "G", "B"}, &rgb}, {{layer + ".R", layer + ".G", layer + ".B"}, &rgb}});
    writeExr(folder / "b.exr",
             {{{"R", "G", "B"}, &other}, {{layer + ".R", layer + ".G", layer + ".B"}, &other}});
    const Ran ran = runTool(folder, "diff a.exr b.exr --metric rmse --tolerance 0.1 -o report");
    EXPECT_EQ(ran.code, 1) << ran.err;
    EXPECT_NE(ran.out.find("owned"), std::string::npos) << ran.out;
    EXPECT_TRUE(isPlain(ran));
    EXPECT_EQ(ran.out.find("\nFAIL\n"), std::string::npos);
    for (const char* file : {"report/index.html", "report/junit.xml"})
        EXPECT_TRUE(isPlain(contentsOf(folder / file))) << file;
    const Ran json = runTool(folder, "diff a.exr b.exr --json");
    EXPECT_TRUE(isPlain(json));
    EXPECT_TRUE(Json::accept(json.out));
}

TEST(Terminal, WhatAnotherRendererSaysPassesAFilter) {
    const Folder folder;
    const std::string says = "printf '\\n%s\\n' '" + evil + "' >&2; ";
    folder.write("evil.sh", says + "head -c 5000000 /dev/zero | tr '\\0' x >&2; " + says + "exit 3\n");
    folder.write("evil.json", Json{{"command", {"sh", (folder / "evil.sh").string()}}}.dump());
    const Ran ran =
        runTool(folder, "compare builtin:triangle" + howSmall + "--renderer evil=evil.json -o report");
    EXPECT_EQ(ran.code, 2);
    EXPECT_NE(ran.err.find("owned"), std::string::npos) << ran.err;
    EXPECT_TRUE(isPlain(ran));
    EXPECT_LT(ran.err.size(), 2000u);
    for (const char* file : {"report/index.html", "report/junit.xml"})
        EXPECT_TRUE(isPlain(contentsOf(folder / file))) << file;
}

TEST(Terminal, WhatSbatchSaysPassesAFilter) {
    const Folder folder;
    folder.write("bin/sbatch", "#!/bin/sh\nprintf '%s\\n' '" + evil + "' >&2\nexit 1\n", true);
    const Ran ran =
        runShell(folder,
                 "PATH='" + (folder / "bin").string() +
                     "':\"$PATH\" '" DIPTYCH_PROGRAM "' submit slurm -- compare builtin:triangle -o report",
                 folder.path());
    EXPECT_TRUE(ran.failedOver("sbatch: e?]0;owned??31m?gpj???"));
    EXPECT_TRUE(isPlain(ran));
    for (const std::string out : {"a\x1b[1m", "a\u009b", "a\u202e", "a\nb", "a\"b", "a\xff"})
        EXPECT_TRUE(runTool(folder, "submit slurm --dry-run -- compare builtin:triangle -o '" + out + "'")
                        .failedOver("line breaks and control characters"));
}

// The first file opened would get the number of a closed descriptor, and with it the messages. sbatch
// looks at the descriptors of its parent process.
TEST(ClosedDescriptors, NoFileGetsTheMessages) {
    const Folder folder;
    folder.write("bin/sbatch",
                 "#!/bin/sh\nfor i in 0 1 2; do readlink /proc/$PPID/fd/$i; done >held\necho 7\n", true);
    for (const auto& [closed, held] :
         {std::pair{"<&-", "100"}, {">&-", "010"}, {"2>&-", "001"}, {"<&- >&- 2>&-", "111"}}) {
        const Ran ran = runShell(folder,
                                 "( PATH='" + (folder / "bin").string() +
                                     "':\"$PATH\" '" DIPTYCH_PROGRAM
                                     "' submit slurm -- compare builtin:triangle -o report </dev/zero " +
                                     closed + " )",
                                 folder.path());
        EXPECT_EQ(ran.code, held[1] == '1' ? 2 : 0) << closed << ran.err;
        std::istringstream links(contentsOf(folder / "held"));
        for (int i = 0; i < 3; ++i) {
            std::string link;
            std::getline(links, link);
            EXPECT_EQ(link == "/dev/null", held[i] == '1') << closed << ": " << i << " is " << link;
        }
    }
}

TEST(ShardScripts, OnlyDataIsJoined) {
    const Folder folder;
    ASSERT_EQ(runTool(folder, "compare builtin:triangle" + howSmall + "--shard 1/1 -o shard").code, 0);
    fs::path section, values;
    for (const auto& entry : fs::recursive_directory_iterator(folder / "shard")) {
        if (entry.path().string().ends_with(".section.js")) section = entry.path();
        if (entry.path().string().ends_with(".values.js")) values = entry.path();
    }
    for (const fs::path& script : {section, values}) {
        const std::string text = contentsOf(script);
        ASSERT_FALSE(text.empty()) << script;
        std::ofstream(script, std::ios::binary) << text << "window.owned = true;\n";
        const Ran ran = runTool(folder, "merge shard -o joined");
        EXPECT_EQ(ran.code, 2);
        EXPECT_NE(ran.err.find("is a script that contains more than data"), std::string::npos) << ran.err;
        EXPECT_FALSE(fs::exists(folder / "joined" / script.lexically_relative(folder / "shard")));
        std::ofstream(script, std::ios::binary) << text;
    }
    EXPECT_EQ(runTool(folder, "merge shard -o joined --force").code, 0);
}

// merge leaves the section out; if it did not, the page's policy would still run nothing.
TEST(ShardScripts, NoneInASectionRunsOnTheJoinedPage) {
    const Folder folder;
    ASSERT_EQ(runTool(folder, "compare builtin:triangle" + howSmall + "--shard 1/1 -o shard").code, 0);
    const std::string planted =
        "<script>window.owned = 1</script><img src='none.png' onerror='window.owned = 2'>"
        "<script src='../evil.js'></script><b id='planted'>planted</b>";
    for (const auto& entry : fs::recursive_directory_iterator(folder / "shard"))
        if (entry.path().string().ends_with(".section.js")) {
            const std::string sound = contentsOf(entry.path()), end = "\");\n";
            ASSERT_TRUE(sound.ends_with(end));
            std::ofstream(entry.path(), std::ios::binary)
                << sound.substr(0, sound.size() - end.size()) << planted << end;
            const Ran ran = runTool(folder, "merge shard -o refused");
            EXPECT_EQ(ran.code, 2);
            EXPECT_NE(ran.err.find("<script> is not an element that Diptych writes"), std::string::npos)
                << ran.err;
            std::ofstream(entry.path(), std::ios::binary) << sound;
        }
    if (browser().empty()) GTEST_SKIP() << "no Chromium here";
    ASSERT_EQ(runTool(folder, "merge shard -o joined").code, 0);
    std::string page = contentsOf(folder / "joined/index.html");
    const std::string sections = "<div id=\"sections\">";
    ASSERT_NE(page.find(sections), std::string::npos);
    page.insert(page.find(sections) + sections.size(), planted);
    std::ofstream(folder / "joined/index.html", std::ios::binary) << page;
    folder.write("evil.js", "window.owned = 3;\n");
    const Visit seen = visit(folder, folder / "joined/index.html", R"(
      await wait(300);
      const told = { planted: $('#planted')?.textContent, owned: window.owned };
      $('#sections').insertAdjacentHTML('beforeend', '<img src="none.png" onerror="window.owned = 4">');
      let refused = 0;
      for (const name of ['../evil.js', 'file:///evil.js', 'https://example.org/evil.js', 'lit.png'])
        addScript(name, () => ++refused);
      await wait(300);
      tell({ ...told, refused, then: window.owned });)");
    ASSERT_TRUE(seen.told.is_object()) << seen.console << seen.dom.substr(0, 400);
    EXPECT_EQ(seen.told, (Json{{"planted", "planted"}, {"refused", 4}})) << "owned is undefined";
    EXPECT_NE(seen.console.find("Content Security Policy"), std::string::npos) << seen.console;
}

}  // namespace
}  // namespace diptych
