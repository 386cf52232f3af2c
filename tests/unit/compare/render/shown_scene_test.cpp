// SPDX-License-Identifier: MIT
// Memory that names of scenes and of rigs ask for is estimated before it is taken.
#include "compare/render/load_scene.h"
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
        Settings settings;
        settings.lights = lights;
        return faultOf([&] { checkAsked("a.exr", where, settings); });
    };
    EXPECT_EQ(fault("", ""), "");
    EXPECT_EQ(fault("a.gltf", "point:100"), "");
    EXPECT_EQ(fault("builtin:array?objects=10000", ""), "");
    EXPECT_TRUE(fault("builtin:array?objects=10000000", "")
                    .starts_with("a.exr: asks for builtin:array?objects=10000000, about "));
    EXPECT_TRUE(fault("", "point:10000000").starts_with("a.exr: asks for --lights point:10000000, about "));
    Settings shadowed;
    shadowed.shadow_size = 16384;
    EXPECT_TRUE(faultOf([&] {
                    checkAsked("a.exr", "", shadowed);
                }).starts_with("a.exr: asks for --shadow-size 16384, about "));
    shadowed.shadows = Shadows::off;
    EXPECT_EQ(faultOf([&] { checkAsked("a.exr", "", shadowed); }), "");
}

}  // namespace
}  // namespace diptych
