// SPDX-License-Identifier: MIT
// Scenes selected on the command line: folders, patterns, lists.
#include "compare/files/scene_folders.h"
#include "tests/support/errors.h"
#include "tests/support/files.h"

#include <gtest/gtest.h>

namespace diptych {
namespace {

namespace fs = std::filesystem;
using Names = std::vector<std::string>;

// A folder of files; their contents do not matter.
fs::path tree() {
    const fs::path root = folder();
    for (const char* name : {"b/two.gltf", "a.GLB", "b/.hidden/three.glb", "notes.txt", ".four.gltf",
                             "b/c/five.glb", "x[1].glb"}) {
        fs::create_directories((root / name).parent_path());
        std::ofstream(root / name) << "x";
    }
    fs::create_directories(root / "empty");
    return root;
}

Names below(const fs::path& root, const Names& words) {
    Names names, found;
    for (const std::string& word : words)
        names.push_back(word.starts_with("builtin:") ? word : (root / word).generic_string());
    for (const std::string& scene : scenesOf(names))
        found.push_back(scene.starts_with("builtin:")
                            ? scene
                            : fs::path(scene).lexically_normal().lexically_relative(root).string());
    return found;
}

void expectFault(const std::string& word, const std::string& fault) {
    const std::string refusal = faultOf([&] { scenesOf({word}); });
    EXPECT_EQ(refusal, fault);
}

TEST(SceneFolders, AFolderStandsForItsSceneFilesSorted) {
    const fs::path root = tree();
    EXPECT_EQ(below(root, {"builtin:spots", ".", "missing.glb"}),
              (Names{"builtin:spots", "a.GLB", "b/c/five.glb", "b/two.gltf", "x[1].glb", "missing.glb"}));
    expectFault(
        (root / "empty").string(),
        (root / "empty").string() + ": contains no .gltf or .glb file; give a folder that does, or a scene");
}

TEST(SceneFolders, EachSceneStandsOnce) {
    const fs::path root = tree();
    EXPECT_EQ(below(root, {"b/two.gltf", "b", "b/two.gltf", "builtin:spots", "builtin:spots"}),
              (Names{"b/two.gltf", "b/c/five.glb", "builtin:spots"}));
}

TEST(SceneFolders, PatternsAreExpanded) {
    const fs::path root = tree();
    EXPECT_EQ(below(root, {"b/*.gltf"}), Names{"b/two.gltf"});
    EXPECT_EQ(below(root, {"**/*.gl?"}), (Names{"b/c/five.glb", "x[1].glb"})) << "as the case is";
    EXPECT_EQ(below(root, {"b/**"}), (Names{"b/c/five.glb", "b/two.gltf"}))
        << "each once, whatever leads to it";
    EXPECT_EQ(below(root, {"[b]"}), (Names{"b/c/five.glb", "b/two.gltf"})) << "a folder that matches";
    EXPECT_EQ(below(root, {"*/../a.GLB"}).size(), 2u) << "one by either folder";
    EXPECT_EQ(below(root, {"x[1].glb"}), Names{"x[1].glb"}) << "is there under its very name";
    EXPECT_EQ(below(root, {"a.GLB?scene=2"}), Names{"a.GLB?scene=2"}) << "one scene of a file, no pattern";
    expectFault((root / "*.obj").string(), (root / "*.obj").string() + ": matches no .gltf or .glb file");
    expectFault((root / "*.txt").string(), (root / "*.txt").string() + ": matches no .gltf or .glb file");
}

TEST(SceneFolders, AListIsRelativeToItsFolder) {
    const fs::path root = tree();
    std::ofstream(root / "b/scenes.txt")
        << "# those that matter\n\n  two.gltf  # the second\r\n"
           "../a.GLB\nbuiltin:spots\nc\n@more.txt\n#two.gltf\nno#comment.glb\n";
    std::ofstream(root / "b/more.txt") << "../x[[]*.glb\nmissing.glb";
    EXPECT_EQ(scenesOf({"@" + (root / "b/scenes.txt").string()}),
              (Names{(root / "b/two.gltf").string(), (root / "a.GLB").string(), "builtin:spots",
                     (root / "b/c/five.glb").string(), (root / "x[1].glb").string(),
                     (root / "b/missing.glb").string(), (root / "b/no#comment.glb").string()}));
    std::ofstream(root / "none.txt") << "# nothing\n";
    expectFault("@" + (root / "none.txt").string(),
                "@" + (root / "none.txt").string() + ": lists no scene; give one per line");
    expectFault("@" + (root / "gone.txt").string(), "@" + (root / "gone.txt").string() + ": no such file");
    std::ofstream(root / "b/more.txt") << "@scenes.txt\n";
    expectFault("@" + (root / "b/scenes.txt").string(),
                "@" + (root / "b/scenes.txt").string() + ": is a list that contains itself");
}

}  // namespace
}  // namespace diptych
