// SPDX-License-Identifier: MIT
// Alpha exactly at the mask's cutoff is kept (glTF 2.0, 3.9.4).
#include "tests/support/checks_builder.h"

#include <gtest/gtest.h>

#include <string>

namespace diptych {
namespace {

TEST(MaskBounds, AlphaThatEqualsTheCutoffCutsNothingOut) {
    Scene scene = plainScene();
    Material& m = scene.materials[0];
    m.alpha_mode = AlphaMode::mask;
    m.alpha_cutoff = m.base_color.a = 0.5f;
    EXPECT_NE(what(scene, "alpha masks").find("nothing is cut out"), std::string::npos);
    m.alpha_cutoff = 0.50001f;
    EXPECT_EQ(what(scene, "alpha masks").find("nothing is cut out"), std::string::npos);
}

}  // namespace
}  // namespace diptych
