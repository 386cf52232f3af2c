// SPDX-License-Identifier: MIT
// Runs every kind of pass: blending, depth bias and clamping, resolves, levels and layers, storage images,
// indirect dispatches and draws, aliased memory, bands of rows, frames in flight. The validation layer
// reports missing barriers (validation_test.cpp).
#include "shared/vulkan/passes/pass_list.h"
#include "shared/vulkan/pipelines/descriptors.h"
#include "shared/vulkan/pipelines/pipelines.h"
#include "tests/image/scenes.h"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <cmath>
#include <fstream>
#include <span>
#include <string>
#include <vector>

namespace diptych::tests {
namespace {

constexpr VkFormat colorFormat = VK_FORMAT_R32G32B32A32_SFLOAT, depthOnly = VK_FORMAT_D32_SFLOAT;

struct DrawnTriangle {
    std::array<float, 4> color{};
    float depth = 0.5f;
    float corner = 3;  // 3: covers the image; 1: its upper left half
};

std::vector<std::uint32_t> compiledTestShader(const std::string& name) {
    const std::filesystem::path file = std::filesystem::path(DIPTYCH_PROBE_DIR) / (name + ".spv");
    std::vector<std::uint32_t> words(std::filesystem::file_size(file) / 4);
    std::ifstream(file, std::ios::binary)
        .read(reinterpret_cast<char*>(words.data()), static_cast<std::streamsize>(words.size() * 4));
    return words;
}

constexpr VkShaderStageFlags triangleStages = VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT;

// Triangles of constant colour and depth.
class Triangles {
public:
    explicit Triangles(Device& on = device())
        : vertexWords_(compiledTestShader("pass_kinds.vert")),
          fragmentWords_(compiledTestShader("pass_kinds.frag")),
          vertex_{"pass_kinds.vert", vertexWords_},
          fragment_{"pass_kinds.frag", fragmentWords_},
          layout_(makePipelineLayout(on, {}, VkPushConstantRange{triangleStages, 0, sizeof(DrawnTriangle)})),
          pipelines_(on, layout_, [this](const PipelineKey& key) {
              return PipelineParts{&vertex_, key.colors.empty() ? nullptr : &fragment_, {}, {}};
          }) {}

    // Commands that draw `triangle` with a pipeline of this key.
    auto draw(const PipelineKey& key, const DrawnTriangle& triangle) {
        return [this, pipeline = pipelines_.get(key), triangle](VkCommandBuffer commands) {
            bind(commands, pipeline, triangle);
            vkCmdDraw(commands, 3, 1, 0, 0);
        };
    }
    void bind(VkCommandBuffer commands, const Pipeline& pipeline, const DrawnTriangle& triangle) const {
        vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline);
        vkCmdSetCullMode(commands, VK_CULL_MODE_NONE);
        vkCmdSetFrontFace(commands, VK_FRONT_FACE_COUNTER_CLOCKWISE);
        vkCmdPushConstants(commands, layout_, triangleStages, 0, sizeof triangle, &triangle);
    }
    Pipelines& pipelines() { return pipelines_; }

private:
    std::vector<std::uint32_t> vertexWords_, fragmentWords_;
    ShaderModule vertex_, fragment_;
    OwnedPipelineLayout layout_;
    Pipelines pipelines_;
};

std::vector<float> readOne(PassList& passes, ImageRef image, int components = 1, Slice slice = {}) {
    return passes.readBack(std::array{PassList::ReadBack{image, components, slice}}).front();
}

VkClearColorValue gray(float value) {
    return {.float32 = {value, value, value, value}};
}

TEST(PassKinds, ColoursAreBlended) {
    Triangles triangles;
    const std::array<float, 4> source{0.25f, 0.5f, 2.0f, 0.75f}, there{1.0f, 0.5f, 4.0f, 0.5f};
    struct Case {
        Blend blend;
        float (*of)(float s, float d, float alpha);
    };
    const Case cases[] = {{Blend::none, [](float s, float, float) { return s; }},
                          {Blend::add, [](float s, float d, float) { return s + d; }},
                          {Blend::over, [](float s, float d, float a) { return s + (1 - a) * d; }},
                          {Blend::multiply, [](float s, float d, float) { return s * d; }},
                          {Blend::through, [](float s, float d, float a) { return s + a * d; }}};
    for (const Case& row : cases) {
        PassList passes(device(), 3, 2);
        // A second attachment keeps its own blend mode.
        const ImageRef first = passes.image("first", colorFormat);
        const PipelineKey key{.colors = {colorFormat}, .blends = {row.blend}};
        passes.draw("blend")
            .color(first, Load::clear, {.float32 = {there[0], there[1], there[2], there[3]}})
            .record(triangles.draw(key, {source}));
        passes.run();
        const std::vector<float> got = readOne(passes, first, 4);
        for (std::size_t i = 0; i < got.size(); ++i)
            EXPECT_EQ(got[i], row.blend == Blend::through && i % 4 == 3
                                  ? there[3]
                                  : row.of(source[i % 4], there[i % 4], source[3]))
                << static_cast<int>(row.blend) << " component " << i % 4;
    }
}

// One unit of bias is the float ULP at the depth's exponent: 2^-24 at 0.5.
TEST(PassKinds, DepthIsBiasedAndClamped) {
    Triangles triangles;
    const auto drawn = [&](PipelineKey key, float depth) {
        PassList passes(device(), 2, 2);
        const ImageRef image =
            passes.image({.name = "depth", .format = depthOnly, .depths = {.cleared = 0.25f}});
        key.depth = depthOnly;
        key.depth_compare = VK_COMPARE_OP_GREATER_OR_EQUAL;
        key.depth_write = true;
        passes.draw("depth").depth(image, Load::clear).record(triangles.draw(key, {{}, depth}));
        passes.run();
        return readOne(passes, image).front();
    };
    const float plain = drawn({}, 0.5f), biased = drawn({.depth_bias = {.constant = -1000}}, 0.5f);
    EXPECT_NEAR(plain, 0.5f, 1e-6f);
    EXPECT_NEAR(std::ldexp(biased - plain, 24), -1000, 1);
    EXPECT_EQ(drawn({}, 1.5f), 0.25f);  // clipped
}

// The hypotenuse of a triangle over half of the image crosses the pixels of a diagonal and covers two of
// their four samples. A resolved depth is that of one sample.
TEST(PassKinds, FourSamplesAreResolved) {
    Triangles triangles;
    constexpr std::uint32_t size = 8;
    PassList passes(device(), size, size);
    const auto image = [&](const char* name, VkFormat format, VkSampleCountFlagBits samples) {
        return passes.image({.name = name,
                             .format = format,
                             .samples = samples,
                             .life = samples == VK_SAMPLE_COUNT_1_BIT ? Life::kept : Life::transient});
    };
    const ImageRef color = image("color", colorFormat, VK_SAMPLE_COUNT_4_BIT),
                   depth = image("depth", depthOnly, VK_SAMPLE_COUNT_4_BIT),
                   mean = image("mean", colorFormat, VK_SAMPLE_COUNT_1_BIT),
                   first = image("first", depthOnly, VK_SAMPLE_COUNT_1_BIT);
    const auto triangle = triangles.draw({.colors = {colorFormat},
                                          .depth = depthOnly,
                                          .depth_compare = VK_COMPARE_OP_GREATER_OR_EQUAL,
                                          .depth_write = true,
                                          .samples = VK_SAMPLE_COUNT_4_BIT},
                                         {{1, 1, 1, 1}, 0.5f, 1});
    passes.draw("draw")
        .color(color, Load::clear, gray(0), {}, mean)
        .depth(depth, Load::clear, {}, first)
        .record(triangle);
    passes.run();
    const std::vector<float> means = readOne(passes, mean), depths = readOne(passes, first);
    std::size_t partly = 0;
    for (std::uint32_t y = 0; y < size; ++y)
        for (std::uint32_t x = 0; x < size; ++x) {
            const float got = means[y * size + x], z = depths[y * size + x];
            EXPECT_EQ(got * 4, std::round(got * 4)) << x << ", " << y;
            EXPECT_TRUE(z == 0.0f || z == 0.5f) << z;
            if (x + y + 1 < size)
                EXPECT_EQ(got, 1.0f) << x << ", " << y;
            else if (x + y + 1 > size)
                EXPECT_EQ(got, 0.0f) << x << ", " << y;
            else
                partly += got > 0 && got < 1;
        }
    EXPECT_EQ(partly, size);
}

// A pass has the extent of its attachment; every level of every layer keeps its own contents.
TEST(PassKinds, LevelsAndLayersAreDrawnTo) {
    Triangles triangles;
    PassList passes(device(), 5, 3);
    const ImageRef chain =
        passes.image({.name = "chain", .format = colorFormat, .extent = {16, 8}, .layers = 3, .levels = 4});
    const auto value = [](std::uint32_t level, std::uint32_t layer) {
        return static_cast<float>(1 + level * 10 + layer);
    };
    for (std::uint32_t layer = 0; layer < 3; ++layer)
        for (std::uint32_t level = 0; level < 4; ++level) {
            const float v = value(level, layer);
            passes.draw("slice")
                .color(chain, Load::clear, gray(0), {level, layer})
                .record(triangles.draw({.colors = {colorFormat}}, {{v, v, v, v}}));
        }
    passes.run();
    for (std::uint32_t layer = 0; layer < 3; ++layer)
        for (std::uint32_t level = 0; level < 4; ++level)
            EXPECT_EQ(readOne(passes, chain, 1, {level, layer}),
                      std::vector<float>((16u >> level) * (8u >> level), value(level, layer)));
}

// A copy pass fills the dispatch size; the dispatch writes a storage image; a third pass draws over it.
TEST(PassKinds, PassesAreDispatchedAndDrawnIndirectly) {
    Triangles triangles;
    constexpr std::uint32_t width = 8, height = 4;
    PassList passes(device(), width, height);
    const ImageRef image = passes.image(
        {.name = "picture", .format = VK_FORMAT_R32_SFLOAT, .usage = VK_IMAGE_USAGE_STORAGE_BIT});
    const GpuBuffer arguments(device(), "arguments", 32,
                              VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT);
    const BufferRef argumentsRef = passes.buffer("arguments", arguments);

    constexpr std::array storage{VK_DESCRIPTOR_TYPE_STORAGE_IMAGE};
    const OwnedDescriptorSetLayout setLayout = makeSetLayout(device(), storage);
    const std::array<VkDescriptorSetLayout, 1> setLayouts{setLayout};
    const OwnedPipelineLayout layout = makePipelineLayout(device(), setLayouts);
    DescriptorSets sets(device(), setLayout, storage, 1);
    const std::vector<std::uint32_t> words = compiledTestShader("pass_kinds.comp");
    const ShaderModule module{"pass_kinds.comp", words};
    const Pipeline kernel = triangles.pipelines().compute(module, {}, layout);

    constexpr std::uint32_t groups = 5;
    const std::array<std::uint32_t, 8> sizes{groups, height, 1, 0,
                                             3,      1,      0, 0};  // VkDrawIndirectCommand: from index 4
    passes.copy("sizes").uses(argumentsRef, access::transferWrite).record([&](VkCommandBuffer commands) {
        vkCmdUpdateBuffer(commands, arguments.handle(), 0, sizeof sizes, sizes.data());
    });
    passes.compute("dispatch")
        .uses(argumentsRef, access::indirectRead)
        .uses(image, access::storageImageWrite(inCompute), {}, true)
        .prepare([&] { sets.image(0, 0, passes.view(image), VK_NULL_HANDLE, VK_IMAGE_LAYOUT_GENERAL); })
        .record([&](VkCommandBuffer commands) {
            const VkDescriptorSet set = sets[0];
            vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, kernel);
            vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, layout, 0, 1, &set, 0, nullptr);
            vkCmdDispatchIndirect(commands, arguments.handle(), 0);
        });
    const Pipeline add =
        triangles.pipelines().get({.colors = {VK_FORMAT_R32_SFLOAT}, .blends = {Blend::add}});
    passes.draw("draw")
        .color(image, Load::keep)
        .uses(argumentsRef, access::indirectRead)
        .record([&](VkCommandBuffer commands) {
            triangles.bind(commands, add, {{100, 0, 0, 0}});
            vkCmdDrawIndirect(commands, arguments.handle(), 16, 1, 0);
        });
    passes.run();
    const std::vector<float> got = readOne(passes, image);
    for (std::uint32_t i = 0; i < got.size(); ++i)
        if (const std::uint32_t x = i % width; x < groups) {
            EXPECT_EQ(got[i], 100.0f + static_cast<float>(x + 1)) << i;
        }
}

// Transients that share memory, each copied while alive; and again in a second run.
TEST(PassKinds, TransientsOfOneMemoryKeepTheirContentsWhileTheyLive) {
    Triangles triangles;
    PassList passes(device(), 7, 5);
    const ImageRef sum =
        passes.image({.name = "sum", .format = colorFormat, .usage = VK_IMAGE_USAGE_TRANSFER_DST_BIT});
    std::array<ImageRef, 3> transients;
    for (std::size_t i = 0; i < transients.size(); ++i) {
        transients[i] = passes.image({.name = fmt::format("transient {}", i),
                                      .format = colorFormat,
                                      .usage = VK_IMAGE_USAGE_TRANSFER_SRC_BIT,
                                      .life = Life::transient});
        const auto v = static_cast<float>(1 << i);
        passes.draw("draw")
            .color(transients[i], Load::clear)
            .record(triangles.draw({.colors = {colorFormat}}, {{v, v, v, v}}));
        passes.copy("copy")
            .uses(transients[i], access::copiedFromImage, {})
            .uses(sum, access::copiedToImage, {})
            .record([&passes, from = transients[i], sum, i](VkCommandBuffer commands) {
                const VkImageSubresourceLayers layers{VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
                const auto x = static_cast<std::int32_t>(i);  // one column each
                const VkImageCopy copy{layers, {x, 0, 0}, layers, {x, 0, 0}, {1, 5, 1}};
                vkCmdCopyImage(commands, passes.handle(from), access::copiedFromImage.layout,
                               passes.handle(sum), access::copiedToImage.layout, 1, &copy);
            });
    }
    for (int run = 0; run < 2; ++run) {
        passes.run();
        const std::vector<float> got = readOne(passes, sum);
        for (std::size_t i = 0; i < transients.size(); ++i)
            EXPECT_EQ(got[7 + i], static_cast<float>(1 << i)) << run;
    }
    EXPECT_EQ(passes.sharedBytes(), 2u * 7 * 5 * 16);
}

// A mip chain has a third more texels than its image.
TEST(PassKinds, LevelsCountAmongBytesPerPixel) {
    PassList passes(device(), 16, 8);
    const ImageRef chain = passes.image({.name = "chain", .format = colorFormat, .levels = 4});
    passes.image({.name = "apart", .format = colorFormat, .extent = {16, 8}});
    EXPECT_EQ(passes.pixelBytes(chain), (128u + 32 + 8 + 2) * 16 / 128);
    EXPECT_EQ(passes.pixelBytes(), passes.pixelBytes(chain)) << "only images of the list's size";
    EXPECT_EQ(passes.imageBytes(), (128u + 32 + 8 + 2 + 128) * 16);
}

// A draw's estimated time splits it into bands on devices that must not be busy for long. Together the
// bands give the whole image: nothing is drawn twice or cleared again.
TEST(PassKinds, LongDrawsComeInBands) {
    Device patient{{.choice = "", .validate = true, .choices = ProfileChoices::gpu}};
    ASSERT_EQ(patient.profile().longest_submit_ms, 100);
    Triangles triangles(patient);
    const PipelineKey key{.colors = {colorFormat}, .blends = {Blend::add}};
    struct Case {
        double ms;
        int bands;
    };
    for (const Case& row : {Case{0, 1}, Case{100, 1}, Case{101, 2}, Case{1000, 10}, Case{1e9, 13}}) {
        PassList passes(patient, 4, 13);
        const ImageRef image = passes.image("image", colorFormat);
        int recorded = 0;
        passes.draw("slow")
            .color(image, Load::clear, gray(1))
            .takes(row.ms)
            .record([&](VkCommandBuffer commands) {
                ++recorded;
                triangles.draw(key, {{2, 2, 2, 2}})(commands);
            });
        passes.run();
        EXPECT_EQ(recorded, row.bands) << row.ms;
        EXPECT_EQ(readOne(passes, image), std::vector<float>(4 * 13, 3.0f)) << row.ms;
    }
    EXPECT_EQ(patient.validationMessages(), 0u) << patient.firstValidationMessage();
}

// Five frames of a list, two in flight at a time. Host writes for a frame persist until the device has
// read them, because each slot has its own buffer. The device runs the frames in order.
TEST(PassKinds, TwoFramesAreInFlight) {
    constexpr std::uint32_t frames = 5, width = 16;
    PassList passes(device(), width, 1);
    FramesInFlight inFlight(device());
    ASSERT_EQ(inFlight.count(), 2u);
    std::vector<GpuBuffer> written;
    for (std::uint32_t slot = 0; slot < inFlight.count(); ++slot)
        written.emplace_back(device(), "written by the host", width * 4, VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
                             MemoryUse::upload);
    const GpuBuffer history(device(), "history", frames * width * 4,
                            VK_BUFFER_USAGE_TRANSFER_DST_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT);
    const BufferRef historyRef = passes.buffer("history", history);
    const ImageRef image = passes.image(
        {.name = "row", .format = VK_FORMAT_R32_SFLOAT, .usage = VK_IMAGE_USAGE_TRANSFER_DST_BIT});
    std::uint32_t frame = 0, slot = 0;
    passes.copy("row").uses(image, access::copiedToImage, {}, true).record([&](VkCommandBuffer commands) {
        const VkBufferImageCopy copy{0, 0, 0, {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1}, {}, {width, 1, 1}};
        vkCmdCopyBufferToImage(commands, written[slot].handle(), passes.handle(image),
                               access::copiedToImage.layout, 1, &copy);
    });
    passes.copy("keep")
        .uses(image, access::copiedFromImage, {})
        .uses(historyRef, access::transferWrite)
        .record([&](VkCommandBuffer commands) {
            const VkBufferImageCopy copy{frame * width * 4, 0, 0, {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1}, {},
                                         {width, 1, 1}};
            vkCmdCopyImageToBuffer(commands, passes.handle(image), access::copiedFromImage.layout,
                                   history.handle(), 1, &copy);
        });
    for (frame = 0; frame < frames; ++frame) {
        slot = inFlight.nextSlot();
        EXPECT_EQ(slot, frame % 2);
        std::fill_n(static_cast<float*>(written[slot].mapped()), width, static_cast<float>(frame + 1));
        passes.enqueue(inFlight);
    }
    inFlight.wait();
    const GpuBuffer seen(device(), "seen", history.size(), VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                         MemoryUse::readback);
    device().submit([&](VkCommandBuffer commands) {
        memoryBarrier(commands, VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT,
                      VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_READ_BIT);
        const VkBufferCopy copy{0, 0, history.size()};
        vkCmdCopyBuffer(commands, history.handle(), seen.handle(), 1, &copy);
        memoryBarrier(commands, VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT,
                      VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT);
    });
    const auto* rows = static_cast<const float*>(seen.mapped());
    for (std::uint32_t i = 0; i < frames * width; ++i)
        EXPECT_EQ(rows[i], static_cast<float>(i / width + 1)) << i;
}

// The hash covers every byte of buffers that compute passes write, and no other buffer.
TEST(PassKinds, WhatKernelsLeaveIsHashed) {
    PassList passes(device(), 1, 1);
    constexpr VkDeviceSize bytes = 1024;
    constexpr VkBufferUsageFlags usage = VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;
    const GpuBuffer stays(device(), "stays", bytes, usage), moves(device(), "moves", bytes, usage),
        copied(device(), "copied", bytes, usage);
    const BufferRef copiedRef = passes.buffer("copied", copied);
    std::uint32_t run = 0;
    passes.copy("copy").uses(copiedRef, access::transferWrite).record([&](VkCommandBuffer commands) {
        vkCmdFillBuffer(commands, copied.handle(), 0, bytes, ++run);
    });
    passes.compute("kernel")
        .uses(copiedRef, access::transferRead)
        .uses(passes.buffer("stays", stays), access::transferWrite)
        .uses(passes.buffer("moves", moves), access::transferWrite)
        .record([&](VkCommandBuffer commands) {
            vkCmdFillBuffer(commands, stays.handle(), 0, bytes, 7);
            vkCmdFillBuffer(commands, moves.handle(), 0, bytes - 4, 7);
            vkCmdFillBuffer(commands, moves.handle(), bytes - 4, 4, run);
        });
    passes.run();
    const auto first = passes.kernelResults(0, passes.size());
    passes.run();
    const auto again = passes.kernelResults(0, passes.size());
    ASSERT_EQ(first.size(), 2u);
    EXPECT_EQ(first.at("stays"), again.at("stays"));
    EXPECT_NE(first.at("moves"), again.at("moves"));
}

}  // namespace
}  // namespace diptych::tests
