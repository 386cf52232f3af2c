// SPDX-License-Identifier: MIT
// Memory that names of scenes and of rigs ask for is estimated before it is taken.
#include "compare/render/shown_scene.h"
#include "shared/scene/load.h"
#include "tests/support/errors.h"

#include <gtest/gtest.h>

namespace diptych {
namespace {

TEST(ShownScene, ABuiltinSceneBeyondAnyMemoryIsRefusedBeforeItIsBuilt) {
    for (const char* name : {"builtin:spheres?lights=2147483647", "builtin:covered?lights=2147483647",
                             "builtin:array?meshes=10000000&objects=10000000&triangles=1000000000&"
                             "texture_mib=65536&materials=10000000"})
        EXPECT_NE(faultOf([&] { loadScene(name); }).find(std::string(name) + ": needs about"),
                  std::string::npos)
            << name;
    EXPECT_EQ(askedBytes("builtin:gallery"), 0u);
    EXPECT_EQ(askedBytes("a.gltf"), 0u);
    EXPECT_LT(askedBytes("builtin:array"), 100'000'000u);
    EXPECT_LT(askedBytes("builtin:spheres"), 1'000'000u);
}

TEST(ShownScene, AFileMayAskForOneGibibyte) {
    const auto fault = [](const char* where, const char* lights) {
        return faultOf([&] { checkAsked("a.exr", where, lights); });
    };
    EXPECT_EQ(fault("", ""), "");
    EXPECT_EQ(fault("a.gltf", "point:100"), "");
    EXPECT_EQ(fault("builtin:array?objects=10000", ""), "");
    EXPECT_TRUE(fault("builtin:array?objects=10000000", "")
                    .starts_with("a.exr: asks for builtin:array?objects=10000000, about "));
    EXPECT_TRUE(fault("", "point:10000000").starts_with("a.exr: asks for --lights point:10000000, about "));
}

}  // namespace
}  // namespace diptych
