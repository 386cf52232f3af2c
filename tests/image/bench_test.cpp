// SPDX-License-Identifier: MIT
// Modes that a benchmark times separately use different pipelines; kernels of bench_kernels compute the same
// function.
#include "shared/contract/debug_mode.h"
#include "tests/bench/kernels.h"
#include "tests/image/scenes.h"

#include <functional>
#include <limits>
#include <set>

namespace diptych::tests {

using namespace kernels;

namespace {

Settings mode(Path path, Assignment assign) {
    Settings settings = unshadowed();
    settings.path = path;
    settings.assign = assign;
    settings.size = {64, 48};
    return settings;
}

// The supported modes of both paths.
std::vector<Settings> drawnModes() {
    std::vector<Settings> modes;
    for (const auto& [assign, name] : enumNames<Assignment>())
        for (const Path path : {Path::deferred, Path::forward_plus})
            if (const Settings settings = mode(path, assign); !settings.problem()) modes.push_back(settings);
    return modes;
}

TEST(PreparedFrames, GoingFromOneModeToAnotherMakesNoPipelineAndChangesNoBit) {
    const Scene scene = makeBuiltin("spheres?lights=64");
    Renderer renderer(device(), scene);
    const std::vector<Settings> modes = drawnModes();
    ASSERT_GE(modes.size(), 2u);
    PreparedFrames frames = renderer.prepare(modes);
    ASSERT_EQ(frames.size(), modes.size());
    const std::size_t pipelines = renderer.pipelines();
    EXPECT_GT(pipelines, 0u);
    std::vector<Image> first;
    for (std::size_t i = 0; i < modes.size(); ++i) {
        EXPECT_GT(frames.draw(i), 0);
        first.push_back(frames.lit(i));
    }
    for (int round = 0; round < 2; ++round)
        for (std::size_t i = modes.size(); i-- > 0;) {
            frames.draw(i);
            EXPECT_EQ(frames.lit(i).data, first[i].data) << nameOf(modes[i].assign) << ", round " << round;
        }
    EXPECT_EQ(renderer.pipelines(), pipelines);
    EXPECT_FALSE(frames.profile(0).empty());
    // The same when a Renderer draws by itself.
    for (std::size_t i = 0; i < modes.size(); ++i) {
        const Frame frame = renderer.draw(modes[i], untimed({Channel::lit}));
        EXPECT_EQ(frame.channels.at(Channel::lit).data, first[i].data);
        EXPECT_EQ(frames.described(i).counters.lights, frame.counters.lights);
    }
    // Negative control: another mode does create pipelines.
    Settings other = mode(Path::deferred, Assignment::every);
    other.gbuffer = GBufferEncoding::compact;
    renderer.prepare(std::vector{other});
    EXPECT_GT(renderer.pipelines(), pipelines);
}

// The largest difference, relative to the pixel's largest component.
double furthest(const Image& a, const Image& b) {
    double max = 0;
    for (std::size_t i = 0; i < a.pixels(); ++i) {
        const float *p = a.pixel(i), *q = b.pixel(i);
        const double largest = static_cast<double>(std::max({q[0], q[1], q[2]}));
        for (int c = 0; c < 3; ++c) {
            const double difference = std::abs(static_cast<double>(p[c]) - static_cast<double>(q[c]));
            if (!(difference <= max * largest))
                max = largest > 0 ? difference / largest : std::numeric_limits<double>::infinity();
        }
    }
    return max;
}

// Sums of 48 lights of one sign, each with some forty roundings of 6e-8, and fused multiply-adds in the
// CPU's kernel only. 1e-5 is several times that and far below the difference of any other formula.
constexpr double oneArithmetic = 1e-5;

TEST(BenchKernels, TheCpusIsTheShadersArithmetic) {
    if (!hasCpuKernel()) GTEST_SKIP() << "no AVX2 and FMA here";
    const KernelWorkload workload = makeWorkload({64, 48}, 256, 48, 3);
    Image byHand{64, 48, 3, {}};
    byHand.data.resize(byHand.pixels() * 3);
    for (const DeviceKernel& kernel : deviceKernels()) {
        if (!whyNotDrawn(device(), kernel).empty()) continue;
        const std::unique_ptr<DrawnKernel> drawn = makeDrawnKernel(device(), workload, kernel);
        for (const int length : {4, 48}) {
            drawn->draw(length);
            const Image image = drawn->image();
            runCpuKernel(workload, length, byHand);
            EXPECT_GT(byHand.data[0], 0.0f);
            EXPECT_LT(furthest(byHand, image), oneArithmetic) << kernel.name << ", " << length << " lights";
        }
        // Negative control: one light fewer is detected.
        runCpuKernel(workload, 47, byHand);
        EXPECT_GT(furthest(byHand, drawn->image()), 100 * oneArithmetic);
    }
}

TEST(BenchKernels, EachTileListsLightsOfItsOwnInOrder) {
    const KernelWorkload workload = makeWorkload({48, 32}, 64, 16, 7);
    ASSERT_EQ(workload.lights.size(), 64u);
    ASSERT_EQ(workload.indices.size(), 6u * 16u) << "3 x 2 tiles";
    std::set<std::vector<std::uint32_t>> lists;
    for (std::size_t tile = 0; tile < 6; ++tile) {
        const auto begin = workload.indices.begin() + static_cast<std::ptrdiff_t>(16 * tile);
        const std::vector<std::uint32_t> list(begin, begin + 16);
        EXPECT_EQ(std::ranges::adjacent_find(list, std::greater_equal()), list.end())
            << "in order, none twice";
        EXPECT_LT(list.back(), 64u);
        EXPECT_TRUE(lists.insert(list).second) << "another tile's list";
    }
    EXPECT_EQ(makeWorkload({48, 32}, 64, 16, 7).indices, workload.indices);
    EXPECT_NE(makeWorkload({48, 32}, 64, 16, 8).indices, workload.indices);
    EXPECT_NE(makeWorkload({48, 32}, 64, 16, 8).lights[0].position, workload.lights[0].position);
    for (const gpu::Light& light : workload.lights) {
        for (int axis = 0; axis < 3; ++axis) {
            EXPECT_GE(light.intensity[axis], 0.2f);
            EXPECT_LT(light.intensity[axis], 1.0f);
        }
        EXPECT_EQ(light.inverse_range_squared * light.range * light.range, 1);
    }
}

TEST(BenchKernels, WorkloadsAreOfWholeTilesAndListsThatFit) {
    EXPECT_EQ(makeWorkload({16, 16}, maxKernelLights, 4, 1).indices.size(), 4u);
    EXPECT_EQ(makeWorkload({16, 16}, 4, 4, 1).indices, (std::vector<std::uint32_t>{0, 1, 2, 3}));
    EXPECT_THROW(makeWorkload({24, 16}, 64, 16, 1), std::logic_error);
    EXPECT_THROW(makeWorkload({16, 24}, 64, 16, 1), std::logic_error);
    EXPECT_THROW(makeWorkload({16, 16}, 64, 6, 1), std::logic_error);
    EXPECT_THROW(makeWorkload({16, 16}, 8, 12, 1), std::logic_error);
    EXPECT_THROW(makeWorkload({16, 16}, maxKernelLights + 1, 4, 1), std::logic_error);
}

}  // namespace
}  // namespace diptych::tests
