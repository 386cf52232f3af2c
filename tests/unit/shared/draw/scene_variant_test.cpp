// SPDX-License-Identifier: MIT
// Settings that compile pipelines anew.
#include "shared/contract/features.h"
#include "shared/draw/frame_inputs.h"

#include <gtest/gtest.h>

namespace diptych {
namespace {

Variant variantOf(const Settings& settings) {
    return sceneVariant(Requirements{}, GpuLights{}, View{}, GBufferLayout{}, settings);
}

TEST(SceneVariant, TheLargestWideningIsNoPartOfAPipeline) {
    Settings settings;
    settings.spec_aa = true;
    const Variant plain = variantOf(settings);
    settings.spec_aa_limit = 0.05f;
    EXPECT_EQ(variantOf(settings).values(), plain.values()) << "a uniform of the view";
    settings.spec_aa_variance = 0.5f;
    EXPECT_NE(variantOf(settings).values(), plain.values()) << "a constant of the shader";
}

}  // namespace
}  // namespace diptych
