// SPDX-License-Identifier: MIT
// The device's MSAA behaviour that both paths rely on.
#include "shared/vulkan/passes/pass_list.h"
#include "shared/vulkan/pipelines/descriptors.h"
#include "shared/vulkan/pipelines/pipelines.h"
#include "tests/image/probe_words.h"
#include "tests/image/scenes.h"

#include <algorithm>
#include <array>
#include <bit>
#include <string>
#include <vector>

namespace diptych::tests {
namespace {

constexpr VkFormat uintFormat = VK_FORMAT_R32G32B32A32_UINT, zFormat = VK_FORMAT_D32_SFLOAT,
                   oneFormat = VK_FORMAT_R32_SFLOAT;
constexpr VkSampleCountFlagBits four = VK_SAMPLE_COUNT_4_BIT;

struct Corners {
    std::array<glm::vec4, 3> corners{};
    glm::vec3 values{0};
    std::uint32_t kept = 15;
};

constexpr VkShaderStageFlags bothStages = VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT;

struct Sampled {
    std::vector<glm::uvec4> texels[4];
    std::vector<float> depths[4];
};

class Multisampled {
public:
    static constexpr std::uint32_t size = 16;
    struct Drawn {
        Corners triangle;
        bool depth_only = false, sample_shading = false, depth_write = true;
    };
    Multisampled()
        : v_(probeWords("multisampled.vert")),
          f_(probeWords("multisampled.frag")),
          r_(probeWords("multisampled_read.frag")) {}

    Sampled draw(const std::vector<Drawn>& drawn) {
        const ShaderModule vertex{"multisampled.vert", v_}, fragment{"multisampled.frag", f_},
            read{"multisampled_read.frag", r_};
        constexpr std::array types{VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
                                   VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER};
        const OwnedDescriptorSetLayout setLayout = makeSetLayout(device(), types);
        const std::array<VkDescriptorSetLayout, 1> setLayouts{setLayout};
        const OwnedPipelineLayout layout =
            makePipelineLayout(device(), setLayouts, VkPushConstantRange{bothStages, 0, sizeof(Corners)});
        Pipelines pipelines(device(), layout, [&](const PipelineKey& key) {
            const bool reads = key.samples == VK_SAMPLE_COUNT_1_BIT;
            return PipelineParts{&vertex, key.colors.empty() ? nullptr : reads ? &read : &fragment, {}, {}};
        });
        PassList passes(device(), size, size);
        const ImageRef color = passes.image({.name = "color", .format = uintFormat, .samples = four}),
                       depth = passes.image({.name = "depth", .format = zFormat, .samples = four});
        bool cleared = false;
        const auto push = [&layout](VkCommandBuffer commands, const Corners& corners) {
            vkCmdSetCullMode(commands, VK_CULL_MODE_NONE);
            vkCmdSetFrontFace(commands, VK_FRONT_FACE_COUNTER_CLOCKWISE);
            vkCmdPushConstants(commands, layout, bothStages, 0, sizeof corners, &corners);
        };
        bool colored = false;
        for (const Drawn& d : drawn) {
            Pass& pass = passes.draw("draw");
            PipelineKey key{.colors = {uintFormat},
                            .depth = zFormat,
                            .depth_compare = VK_COMPARE_OP_GREATER_OR_EQUAL,
                            .depth_write = d.depth_write,
                            .samples = four,
                            .sample_shading = d.sample_shading};
            if (d.depth_only)
                key.colors.clear();
            else
                pass.color(color, colored ? Load::keep : Load::clear);
            colored |= !d.depth_only;
            pass.depth(depth, cleared ? Load::keep : Load::clear);
            cleared = true;
            pass.record(
                [&push, pipeline = pipelines.get(key), corners = d.triangle](VkCommandBuffer commands) {
                    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline);
                    push(commands, corners);
                    vkCmdDraw(commands, 3, 1, 0, 0);
                });
        }
        DescriptorSets sets(device(), setLayout, types, 1);
        std::array<ImageRef, 4> one, oneDepth;
        const Pipeline reading = pipelines.get(PipelineKey{.colors = {uintFormat, oneFormat}});
        const OwnedSampler sampler = makeNearestSampler(device());
        for (std::uint32_t s = 0; s < 4; ++s) {
            one[s] = passes.image("one", uintFormat);
            oneDepth[s] = passes.image("one depth", oneFormat);
            Corners all{{glm::vec4(-1, -1, 0.5, 0), {3, -1, 0.5, 0}, {-1, 3, 0.5, 0}}, {}, s};
            passes.draw("read")
                .samples(color, inFragment)
                .samples(depth, inFragment)
                .color(one[s], Load::clear)
                .color(oneDepth[s], Load::clear)
                .prepare([&passes, &sets, &sampler, color, depth] {
                    sets.image(0, 0, passes.view(color), sampler, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
                    sets.image(0, 1, passes.view(depth), sampler, access::sampledDepth(inFragment).layout);
                })
                .record([&, all](VkCommandBuffer commands) {
                    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, reading);
                    const VkDescriptorSet set = sets[0];
                    vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout, 0, 1, &set, 0,
                                            nullptr);
                    push(commands, all);
                    vkCmdDraw(commands, 3, 1, 0, 0);
                });
        }
        passes.run();
        Sampled result;
        for (std::uint32_t s = 0; s < 4; ++s) {
            const auto texels = passes.readBack(std::array{PassList::ReadBack{one[s], 4}}).front();
            for (std::size_t i = 0; i < texels.size(); i += 4)
                result.texels[s].push_back({std::bit_cast<std::uint32_t>(texels[i]),
                                            std::bit_cast<std::uint32_t>(texels[i + 1]),
                                            std::bit_cast<std::uint32_t>(texels[i + 2]),
                                            std::bit_cast<std::uint32_t>(texels[i + 3])});
            result.depths[s] = passes.readBack(std::array{PassList::ReadBack{oneDepth[s], 1}}).front();
        }
        return result;
    }

private:
    std::vector<std::uint32_t> v_, f_, r_;
};

constexpr std::array<glm::dvec2, 4> places{{{0.375, 0.125}, {0.875, 0.375}, {0.125, 0.625}, {0.625, 0.875}}};

// Vertices are snapped to 1/256 pixel: samples closer than that to an edge may be in or out.
enum class Inside { no, yes, unsure };

class Plane {
public:
    explicit Plane(const Corners& of) {
        for (std::size_t i = 0; i < 3; ++i) {
            corners_[i] = (glm::dvec2(of.corners[i]) + 1.0) * 0.5 * double{Multisampled::size};
            depths_[static_cast<int>(i)] = of.corners[i].z;
        }
        values_ = of.values;
    }
    Inside covers(const glm::dvec2& p) const {
        const glm::dvec3 b = barycentric(p);
        Inside result = Inside::yes;
        for (int i = 0; i < 3; ++i) {
            const auto k = static_cast<std::size_t>(i);
            const double opposite = glm::distance(corners_[(k + 1) % 3], corners_[(k + 2) % 3]);
            const double off = b[i] * std::abs(area()) / opposite;  // from the edge, pixels
            if (std::abs(off) < 0.01)
                result = Inside::unsure;
            else if (off < 0)
                return Inside::no;
        }
        return result;
    }
    double depth(const glm::dvec2& p) const { return glm::dot(barycentric(p), depths_); }
    double value(const glm::dvec2& p) const { return glm::dot(barycentric(p), values_); }

private:
    std::array<glm::dvec2, 3> corners_{};
    glm::dvec3 depths_{0}, values_{0};
    static double cross(const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; }
    double area() const { return cross(corners_[1] - corners_[0], corners_[2] - corners_[0]); }
    glm::dvec3 barycentric(const glm::dvec2& p) const {
        return glm::dvec3(cross(corners_[1] - p, corners_[2] - p), cross(corners_[2] - p, corners_[0] - p),
                          cross(corners_[0] - p, corners_[1] - p)) /
               area();
    }
};

const Corners firstTriangle{
    {glm::vec4(-0.9f, -0.8f, 0.3f, 0), {0.95f, -0.5f, 0.8f, 0}, {-0.2f, 0.9f, 0.5f, 0}}, {1, 2, 4}},
    secondTriangle{{glm::vec4(-0.7f, 0.1f, 0.9f, 0), {0.8f, -0.9f, 0.4f, 0}, {0.5f, 0.8f, 0.6f, 0}},
                   {3, 5, 7}};

// gl_SampleMaskIn is the triangle's coverage of the standard locations, before depth tests. Inputs and
// depth are those of its plane at the mean of the covered locations.
TEST(Multisampled, AFragmentOfAPixelKnowsWhatItsTriangleCovers) {
    Multisampled samples;
    const Plane plane(firstTriangle);
    const Sampled drawn = samples.draw({{firstTriangle}});
    std::size_t edges = 0, inner = 0;
    for (std::uint32_t i = 0; i < Multisampled::size * Multisampled::size; ++i) {
        const glm::dvec2 corner(i % Multisampled::size, i / Multisampled::size);
        std::uint32_t mask = 0;
        bool sure = true;
        glm::dvec2 mean(0);
        for (std::uint32_t s = 0; s < 4; ++s) {
            const Inside inside = plane.covers(corner + places[s]);
            sure &= inside != Inside::unsure;
            if (inside == Inside::yes) mask |= 1u << s, mean += corner + places[s];
        }
        if (!sure) continue;
        edges += mask != 0 && mask != 15;
        inner += mask == 15;
        mean /= std::max(std::popcount(mask), 1);
        for (std::uint32_t s = 0; s < 4; ++s) {
            const glm::uvec4& texel = drawn.texels[s][i];
            const bool covered = (mask >> s & 1u) != 0;
            EXPECT_EQ(texel.x, covered ? mask : 0u) << i << " sample " << s;
            if (!covered) continue;
            // float32 interpolates values up to 4 and depths up to 1 over 16 pixels. Vertices snap to
            // 1/256 pixel; slopes are up to 0.3 and 0.1 per pixel.
            EXPECT_NEAR(std::bit_cast<float>(texel.y), plane.value(mean), 3e-3) << i;
            EXPECT_NEAR(std::bit_cast<float>(texel.z), plane.depth(mean), 1e-3) << i;
            EXPECT_NEAR(drawn.depths[s][i], plane.depth(corner + places[s]), 1e-3) << i;
        }
    }
    EXPECT_GT(edges, 20u);
    EXPECT_GT(inner, 40u);
}

// A pre-pass removes samples from fragments, but changes neither their mask nor their inputs.
TEST(Multisampled, APrePassChangesNoFragment) {
    Multisampled samples;
    const Sampled alone = samples.draw({{firstTriangle}, {secondTriangle}}),
                  after = samples.draw({{.triangle = firstTriangle, .depth_only = true},
                                        {.triangle = secondTriangle, .depth_only = true},
                                        {.triangle = firstTriangle, .depth_write = false},
                                        {.triangle = secondTriangle, .depth_write = false}});
    std::size_t shared = 0;
    for (std::size_t s = 0; s < 4; ++s) {
        EXPECT_EQ(alone.texels[s], after.texels[s]) << "sample " << s;
        EXPECT_EQ(alone.depths[s], after.depths[s]) << "sample " << s;
    }
    for (std::size_t i = 0; i < alone.texels[0].size(); ++i)
        shared += alone.texels[0][i] != alone.texels[3][i];
    EXPECT_GT(shared, 20u) << "both triangles are in these pixels";
}

// With sample shading each fragment's mask has only its own sample, and its depth is the stored one.
TEST(Multisampled, AFragmentOfASampleIsAtItsPlace) {
    Multisampled samples;
    const Sampled drawn = samples.draw({{.triangle = firstTriangle, .sample_shading = true},
                                        {.triangle = secondTriangle, .sample_shading = true}});
    std::size_t covered = 0;
    for (std::uint32_t s = 0; s < 4; ++s)
        for (std::size_t i = 0; i < drawn.texels[s].size(); ++i) {
            const glm::uvec4& texel = drawn.texels[s][i];
            if (texel.x == 0) continue;
            ++covered;
            EXPECT_EQ(texel.x, 1u << s) << i;
            EXPECT_EQ(std::bit_cast<float>(texel.z), drawn.depths[s][i]) << i;
            EXPECT_EQ(std::bit_cast<float>(texel.w),
                      static_cast<float>(static_cast<double>(i % Multisampled::size) + places[s].x));
        }
    EXPECT_GT(covered, 400u);
}

// Samples cleared in gl_SampleMask are not written, nor is their depth.
TEST(Multisampled, AFragmentMayKeepSomeOfItsSamples) {
    Multisampled samples;
    Corners some = secondTriangle;
    some.kept = 5;
    const Sampled before = samples.draw({{firstTriangle}}),
                  all = samples.draw({{firstTriangle}, {secondTriangle}}),
                  after = samples.draw({{firstTriangle}, {some}});
    for (std::size_t s = 0; s < 4; ++s) {
        const Sampled& expected = s % 2 == 0 ? all : before;
        EXPECT_EQ(after.texels[s], expected.texels[s]) << "sample " << s;
        EXPECT_EQ(after.depths[s], expected.depths[s]) << "sample " << s;
    }
    EXPECT_NE(all.texels[1], before.texels[1]);
}

}  // namespace
}  // namespace diptych::tests
