// SPDX-License-Identifier: MIT
// A Setting that a path is documented to ignore changes no bit of its image, so a sweep may skip it.
#include "shared/contract/debug_mode.h"
#include "shared/scene/load.h"
#include "tests/image/scenes.h"

namespace diptych::tests {
namespace {

Image litOf(Renderer& renderer, const Settings& settings) {
    return renderer.draw(settings, untimed({Channel::lit})).channels.at(Channel::lit);
}

TEST(IgnoredSettings, ChangeNoBit) {
    const Scene scene = loadScene("builtin:gallery");
    Renderer renderer(device(), scene, pipelines());
    std::size_t compared = 0, changed = 0;
    for (const Path path : {Path::deferred, Path::forward_plus}) {
        Settings defaults = unshadowed();
        defaults.path = path;
        defaults.size = {96, 54};
        const Image before = litOf(renderer, defaults);
        for (const Field& field : settingFields()) {
            if (field.option == "path" || field.option == "size") continue;
            const bool ignored = !ignoredBecause(defaults, field.option).empty();
            if (!ignored && field.option != "gbuffer") continue;  // one that is read suffices as a control
            for (const std::string& value : sweptValues(defaults, field.option)) {
                Settings other = defaults;
                other.set(field.option, value);
                if (other == defaults || (other.problem() && !ignored)) continue;
                const std::uint64_t pixels = unequalPixels(before, litOf(renderer, other), 0);
                compared += ignored;
                changed += !ignored && pixels > 0;
                EXPECT_FALSE(ignored && pixels > 0) << nameOf(path) << " " << field.option << " " << value;
            }
        }
    }
    EXPECT_GE(compared, 4u) << "gbuffer of forward+, prepass of deferred";
    EXPECT_GE(changed, 2u) << "what is read is told from it: the G-buffer of deferred";
}

// Shadow bias depends on the triangle's normal, which forward+ quantizes like the G-buffer.
TEST(IgnoredSettings, ForwardPlusReadsTheGBuffersEncodingWithShadowsAlone) {
    const Scene scene = loadScene("builtin:gallery");
    Renderer renderer(device(), scene, pipelines());
    Settings full, compact;
    full.path = compact.path = Path::forward_plus;
    full.size = compact.size = {96, 54};
    full.gbuffer = GBufferEncoding::full;
    compact.gbuffer = GBufferEncoding::compact;
    EXPECT_EQ(ignoredBecause(full, "gbuffer"), "");
    EXPECT_GT(unequalPixels(litOf(renderer, full), litOf(renderer, compact), 0), 0u);
    full.shadows = Shadows::off;
    EXPECT_NE(ignoredBecause(full, "gbuffer"), "");
}

}  // namespace
}  // namespace diptych::tests
