// SPDX-License-Identifier: MIT
// The declared uses of a frame's passes: the barriers that follow from them, stage by stage, and that no
// declaration is redundant. The validation layer does not detect missing source stages.
#include "compare/frames/frame_properties.h"
#include "compare/render/prepared_view.h"
#include "tests/image/computing_device.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <memory>
#include <optional>
#include <set>

namespace diptych::tests {
namespace {

struct Bit {
    std::uint64_t bit;
    const char* name;
};
constexpr Bit stageNames[] = {{inVertex, "vertex"},
                              {inFragment, "fragment"},
                              {inCompute, "compute"},
                              {VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT, "early"},
                              {VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT, "late"},
                              {VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT, "color"},
                              {VK_PIPELINE_STAGE_2_INDEX_INPUT_BIT, "indices"},
                              {VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT, "draws"},
                              {VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, "transfer"}};
constexpr Bit accessNames[] = {{VK_ACCESS_2_SHADER_STORAGE_READ_BIT, "read"},
                               {VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT, "write"},
                               {VK_ACCESS_2_SHADER_SAMPLED_READ_BIT, "sample"},
                               {VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT, "blend"},
                               {VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT, "write"},
                               {VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT, "test"},
                               {VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT, "write"},
                               {VK_ACCESS_2_INDEX_READ_BIT, "read"},
                               {VK_ACCESS_2_INDIRECT_COMMAND_READ_BIT, "read"},
                               {VK_ACCESS_2_TRANSFER_WRITE_BIT, "fill"},
                               {VK_ACCESS_2_TRANSFER_READ_BIT, "copy"}};

template <std::size_t n>
std::string bitText(std::uint64_t bits, const Bit (&names)[n]) {
    std::string text;
    for (const Bit& name : names) {
        if ((bits & name.bit) == 0) continue;
        text += (text.empty() ? "" : "+") + std::string(name.name);
        bits &= ~name.bit;
    }
    if (bits != 0) text += fmt::format("+{:#x}", bits);
    return text.empty() ? "-" : text;
}

std::string textOf(const RecordedBarrier& barrier) {
    return fmt::format("{}: {}, {} {} -> {} {}{}", barrier.pass, barrier.resource,
                       bitText(barrier.from.stages, stageNames), bitText(barrier.from.access, accessNames),
                       bitText(barrier.to.stages, stageNames), bitText(barrier.to.access, accessNames),
                       barrier.from.layout != barrier.to.layout ? ", layout" : "");
}

// The passes of one path, declared but not run.
class Declared {
public:
    Declared(Path path, Assignment assign, LightKernel kernel = LightKernel::scatter,
             const char* lights = "point:40,spot:10", Lighting lighting = Lighting::fragment,
             Device& on = device(), const std::shared_ptr<PipelineSet>& set = pipelines())
        : scene_(loadScene("builtin:triangle")), shared_(on, scene_, set) {
        Settings settings = smallImage(GBufferEncoding::standard);
        settings.path = path;
        settings.assign = assign;
        settings.lights = lights;
        settings.light_kernel = kernel;
        settings.lighting = lighting;
        settings.prepass = Switch::on;
        seen_.emplace(makeSceneView(scene_, viewRequest(settings)));
        frame_ = std::make_unique<PreparedFrame>(on, shared_, *seen_, settings);
        frame_->passes.allocate();
    }
    PassList& passes() { return frame_->passes; }

private:
    Scene scene_;
    SharedResources shared_;
    std::optional<SceneView> seen_;
    std::unique_ptr<PreparedFrame> frame_;
};

std::vector<std::string> secondRun(const PassList& passes) {
    const std::vector<RecordedBarrier> one = passes.plannedBarriers(1), two = passes.plannedBarriers(2);
    std::vector<std::string> lines;
    for (std::size_t i = one.size(); i < two.size(); ++i) lines.push_back(textOf(two[i]));
    return lines;
}

// Barriers of a second frame: every write waits for the previous frame's readers.
TEST(Declarations, BarriersOfForwardPlusWithLightClusters) {
    Declared declared(Path::forward_plus, Assignment::clustered);
    EXPECT_EQ(secondRun(declared.passes()),
              (std::vector<std::string>{
                  "depth pre-pass: depth, early+late - -> early+late test+write, layout",
                  "assign lights: list overflow, compute write -> transfer fill",
                  "assign lights: light masks, compute write -> transfer fill",
                  "assign lights: light masks, transfer fill -> compute read+write",
                  "assign lights: light masks, compute write -> compute sample",
                  "assign lights: used words, compute write -> compute write",
                  "assign lights: light counts, compute write -> compute read+write",
                  "assign lights: list begins, compute write -> compute write",
                  "assign lights: list begins, compute write -> compute read+write",
                  "assign lights: light masks, compute write -> compute read",
                  "assign lights: used words, compute write -> compute read",
                  "assign lights: light counts, compute write -> compute read",
                  "assign lights: list begins, compute write -> compute read",
                  "assign lights: list overflow, transfer fill -> compute read+write",
                  "assign lights: list heads, fragment+compute write -> compute write",
                  "assign lights: light lists, fragment+compute write -> compute write",
                  "assign lights: list counts, fragment+compute write -> compute write",
                  "shade: list heads, compute write -> fragment sample",
                  "shade: light lists, compute write -> fragment sample",
                  "shade: list counts, compute write -> fragment read",
                  "shade: lit, color write -> color blend+write, layout",
                  "shade: depth, early+late write -> early+late test, layout",
              }));
}

// Gather waits for the candidates of tiles and slices; everything else matches scatter.
TEST(Declarations, BarriersOfGather) {
    Declared scatter(Path::forward_plus, Assignment::clustered),
        gather(Path::forward_plus, Assignment::clustered, LightKernel::gather);
    std::vector<std::string> lines = secondRun(gather.passes()), other = secondRun(scatter.passes());
    const auto isMask = [](const std::string& line) {
        return line.find("light masks") != line.npos || line.find("candidates") != line.npos;
    };
    std::vector<std::string> masks;
    std::ranges::copy_if(lines, std::back_inserter(masks), isMask);
    EXPECT_EQ(masks, (std::vector<std::string>{
                         "assign lights: light masks, compute write -> transfer fill",
                         "assign lights: light candidates, compute write -> transfer fill",
                         "assign lights: light candidates, transfer fill -> compute read+write",
                         "assign lights: light candidates, compute write -> compute read",
                         "assign lights: light masks, transfer fill -> compute write",
                         "assign lights: light masks, compute write -> compute sample",
                         "assign lights: light masks, compute write -> compute read",
                     }));
    std::erase_if(lines, isMask);
    std::erase_if(other, isMask);
    EXPECT_EQ(lines, other);
}

// The culling dispatch waits for the previous frame's draws; the frame's first draw waits for the
// dispatch.
TEST(Declarations, BarriersOfChosenTriangles) {
    Declared declared(Path::forward_plus, Assignment::every, LightKernel::scatter, "point:40",
                      Lighting::fragment, byCompute(), computePipelines());
    std::vector<std::string> lines = secondRun(declared.passes());
    std::erase_if(lines, [](const std::string& line) {
        return line.find("chosen indices") == line.npos && line.find("indirect draws") == line.npos;
    });
    EXPECT_EQ(lines, (std::vector<std::string>{
                         "clusters: chosen indices, compute+indices write -> compute write",
                         "clusters: indirect draws, compute+draws write -> compute write",
                         "depth pre-pass: chosen indices, compute write -> indices read",
                         "depth pre-pass: indirect draws, compute write -> draws read",
                     }));
}

// Meshlets need no depth, so they do not wait for the G-buffer. Tiles do.
TEST(Declarations, OnlyTilesWaitForDepth) {
    for (const Assignment assign : {Assignment::clustered, Assignment::tiled}) {
        Declared declared(Path::deferred, assign);
        std::size_t waits = 0;
        for (const std::string& line : secondRun(declared.passes()))
            waits += line.starts_with("assign") && line.find(" depth,") != line.npos;
        EXPECT_EQ(waits, assign == Assignment::tiled ? 1u : 0u) << nameOf(assign);
    }
}

// Declarations that change no barrier of two frames when removed, and that no other declaration covers:
// removing that one too would change barriers. Covered ones are recorded with the test's results.
std::string inVain(const PassList& passes) {
    const std::vector<DeclaredUse> all = passes.declarations();
    const std::vector<RecordedBarrier> whole = passes.plannedBarriers(2);
    std::string covered, vain;
    for (std::size_t i = 0; i < all.size(); ++i) {
        if (passes.plannedBarriers(2, {i}) != whole) continue;
        std::size_t cover = 0;
        while (cover < all.size() &&
               (cover == i || passes.plannedBarriers(2, {cover}) == passes.plannedBarriers(2, {i, cover})))
            ++cover;
        if (cover == all.size())
            vain += fmt::format("{}: {}\n", all[i].pass, all[i].resource);
        else
            covered += fmt::format("{}: {} is covered by {}: {}\n", all[i].pass, all[i].resource,
                                   all[cover].pass, all[cover].resource);
    }
    testing::Test::RecordProperty("covered", covered);
    return vain;
}

TEST(Declarations, NoneIsInVain) {
    for (const Path path : {Path::forward_plus, Path::deferred})
        for (const Assignment assign : {Assignment::clustered, Assignment::tiled, Assignment::every})
            for (const LightKernel kernel : {LightKernel::scatter, LightKernel::gather})
                EXPECT_EQ(inVain(Declared(path, assign, kernel).passes()), "")
                    << nameOf(path) << ", " << nameOf(assign) << ", " << nameOf(kernel);
    for (const Path path : {Path::forward_plus, Path::deferred})
        EXPECT_EQ(inVain(Declared(path, Assignment::every, LightKernel::scatter, "point:40",
                                  Lighting::fragment, byCompute(), computePipelines())
                             .passes()),
                  "")
            << nameOf(path) << ", triangles chosen by a kernel";
    for (const Lighting lighting : {Lighting::fragment, Lighting::compute})
        for (const char* lights : {"point:70000", "point:40,spot:10"})
            EXPECT_EQ(
                inVain(Declared(Path::deferred, Assignment::every, LightKernel::scatter, lights, lighting)
                           .passes()),
                "")
                << nameOf(lighting) << ", " << lights;
}

TEST(Declarations, OneInVainIsFound) {
    const GpuBuffer uploaded(device(), "uploaded", 16, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
    Declared declared(Path::deferred, Assignment::clustered);
    PassList& passes = declared.passes();
    passes.compute("idle").uses(passes.buffer("uploaded", uploaded), access::storageRead(inCompute));
    EXPECT_EQ(inVain(passes), "idle: uploaded\n");
}

// Partial sums of light batches reuse memory: two batches are live at a time, however many there are.
TEST(Declarations, PartialSumsShareMemory) {
    Declared declared(Path::deferred, Assignment::every, LightKernel::scatter, "point:200000");
    std::size_t batches = 0;
    for (const DeclaredUse& use : declared.passes().declarations())
        batches += use.resource == "partial diffuse sum" && writes(use.access);
    ASSERT_GT(batches, 2u);
    constexpr std::uint64_t sums = 2u * 160 * 90 * 16;
    EXPECT_GE(declared.passes().sharedBytes(), (batches - 2) * sums);
    EXPECT_LT(declared.passes().sharedBytes(), (batches - 1) * sums);
}

}  // namespace
}  // namespace diptych::tests
