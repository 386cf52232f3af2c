// SPDX-License-Identifier: MIT
// lit before blending in both paths, and the verdict on a difference that arises after it.
#include "compare/verdict/pair_reports.h"
#include "tests/image/scenes.h"

#include <fmt/format.h>

namespace diptych::tests {
namespace {

Settings beforeBlendingImage(GBufferEncoding gbuffer = GBufferEncoding::full) {
    Settings settings = smallImage(gbuffer);
    settings.size = {96, 54};
    return settings;
}

Report afterBlendingReport(std::vector<Frame> frames) {
    const Scene& scene = uploaded("builtin:glass").scene;
    const DeviceInfo& info = device().info();
    return makeReport({{std::move(frames), requirements(scene, poseAt(scene, 0))}},
                      {info.name, info.driver, info.type});
}

std::size_t namedFailures(const Comparison& comparison) {
    return static_cast<std::size_t>(std::ranges::count_if(comparison.failures, [](const std::string& line) {
        return line.starts_with("the transparent draw adds a difference");
    }));
}

// lit before blending equals lit of the scene without blended surfaces.
TEST(AfterBlendingImages, BothPathsBringWhatWasBefore) {
    const Scene& scene = uploaded("builtin:glass").scene;
    Scene opaque = scene;
    for (Mesh& mesh : opaque.meshes)
        std::erase_if(mesh.primitives, [&](const Primitive& p) {
            return opaque.materials[static_cast<std::size_t>(p.material)].alpha_mode == AlphaMode::blend;
        });
    for (const GBufferEncoding gbuffer : {GBufferEncoding::full, GBufferEncoding::standard}) {
        const Settings settings = beforeBlendingImage(gbuffer);
        const std::vector<Frame> all = bothPaths(uploaded("builtin:glass").renderer, settings),
                                 rest = bothPaths(opaque, settings);
        for (const std::size_t i : {0u, 1u}) {
            EXPECT_TRUE(rest[i].unblended.empty()) << "nothing blends";
            ASSERT_FALSE(all[i].unblended.empty());
            const DebugMode& mode = debugMode(Channel::lit);
            // F0 is then read, not a constant: the blended materials include unlit ones.
            EXPECT_LT(channelStats(mode.error_kind, mode.kind, rest[i].channels.at(Channel::lit),
                                   all[i].unblended, everyPixel(all[i].unblended.pixels()))
                          .max,
                      1e-5)
                << all[i].name;
            EXPECT_GT(differingPixels(all[i].unblended, all[i].channels.at(Channel::lit)), 400u);
        }
        EXPECT_EQ(all[1].unblended_through_gbuffer.empty(), false);
        EXPECT_EQ(differingPixels(all[0].unblended, all[1].unblended_through_gbuffer), 0u);
        const Report report = afterBlendingReport(all);
        ASSERT_TRUE(report.comparisons[0].after_blending);
        EXPECT_TRUE(report.passed()) << nameOf(gbuffer);
    }
}

// Control: a fault after blending alone, and one already there before it.
TEST(AfterBlendingImages, AFaultAfterBlendingFailsByName) {
    for (const GBufferEncoding gbuffer : {GBufferEncoding::full, GBufferEncoding::standard}) {
        const std::vector<Frame> frames =
            bothPaths(uploaded("builtin:glass").renderer, beforeBlendingImage(gbuffer));
        std::vector<Frame> after = frames, both = frames;
        for (std::size_t i = 0; i < 40; ++i) {
            const std::size_t pixel = 96 * 20 + 30 + i;
            after[0].channels.at(Channel::lit).pixel(pixel)[1] += 0.01f;
            both[0].channels.at(Channel::lit).pixel(pixel)[1] += 0.01f;
            both[0].unblended.pixel(pixel)[1] += 0.1f;
        }
        const Report named = afterBlendingReport(after), other = afterBlendingReport(both);
        EXPECT_EQ(namedFailures(named.comparisons[0]), 1u) << nameOf(gbuffer);
        EXPECT_EQ(named.comparisons[0].after_blending->pixels, 40u) << nameOf(gbuffer);
        EXPECT_EQ(namedFailures(other.comparisons[0]), 0u) << nameOf(gbuffer);
        EXPECT_FALSE(other.passed()) << "lit differs";
    }
}

// Few pixels are wrong, so lit as a whole passes.
TEST(AfterBlendingImages, AgainstTheReferenceTooIfLitPassesAsAWhole) {
    Renderer& renderer = uploaded("builtin:glass").renderer;
    Settings settings = beforeBlendingImage();
    settings.size = {160, 90};
    std::vector<Frame> frames{drawnBy(Path::reference, renderer, settings)};
    for (Frame& frame : bothPaths(renderer, settings)) frames.push_back(std::move(frame));
    EXPECT_TRUE(afterBlendingReport(frames).passed());
    // One fault per pane, where the reference's image is uniform around it.
    std::size_t faults = 0;
    for (std::size_t y = 2; y < 88 && faults < 4; ++y)
        for (std::size_t x = 2; x < 158 && faults < 4; ++x) {
            const auto at = [&](std::size_t u, std::size_t v) {
                return frames[0].channels.at(Channel::lit).pixel(v * 160 + u)[1];
            };
            float min = at(x, y), max = min;
            for (std::size_t v = y - 2; v <= y + 2; ++v)
                for (std::size_t u = x - 2; u <= x + 2; ++u) {
                    min = std::min(min, at(u, v));
                    max = std::max(max, at(u, v));
                }
            const std::size_t i = y * 160 + x;
            if (*frames[0].blended.pixel(i) == 0 || max - min > 0.02f * max) continue;
            frames[1].channels.at(Channel::lit).pixel(i)[1] *= 1.1f;
            ++faults;
        }
    ASSERT_EQ(faults, 4u);
    const Report report = afterBlendingReport(frames);
    const Comparison& deferred = report.comparisons[0];
    EXPECT_EQ(deferred.channels.front().mode->channel, Channel::lit);
    EXPECT_EQ(deferred.channels.front().verdict, Verdict::pass);
    EXPECT_EQ(namedFailures(deferred), 1u);
    EXPECT_EQ(namedFailures(report.comparisons[1]), 0u);
}

}  // namespace
}  // namespace diptych::tests
