// SPDX-License-Identifier: MIT
// The culling compute shader never removes a triangle that covers a sample, whatever the device's
// rounding. It keeps meshlet order and removes about as many triangles as the CPU.
#include "shared/draw/culling.h"

#include "shared/draw/posing.h"
#include "tests/support/rasteriser.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <map>
#include <random>
#include <span>
#include <string>
#include <vector>

namespace diptych {
namespace {

using tests::Rasteriser;
using tests::TriangleMesh;

// The available device, with culling by compute.
struct ChoosingDevice {
    Device device{{.choice = "", .validate = true, .choices = ProfileChoices::culling_by_compute}};
    OwnedDescriptorSetLayout material = Materials::makeLayout(device);
    Layouts layouts{device, material};
    Pipelines pipelines{device, layouts.pipeline};
};
ChoosingDevice& chooser() {
    static ChoosingDevice made;
    return made;
}

struct ChosenCounts {
    std::size_t triangles = 0, kept = 0, shown = 0, by_host = 0;
};

struct KernelRound {
    TriangleMesh mesh;
    View view;
    int samples = 1;
    glm::dmat4 placed{1};
    bool double_sided = false;
};

Scene sceneOf(const TriangleMesh& mesh, bool double_sided) {
    Scene scene;
    scene.materials.resize(1);
    scene.materials[0].double_sided = double_sided;
    Primitive p;
    p.positions = mesh.positions;
    p.normals.assign(p.positions.size(), {0, 0, 1});
    p.tangents.assign(p.positions.size(), {1, 0, 0, 1});
    p.indices = mesh.indices;
    scene.meshes = {{"mesh", {p}}};
    return scene;
}

// Culls one instance, and checks that no culled triangle covers a sample.
ChosenCounts expectTheKernelKeepsWhatShows(const KernelRound& round, const std::string& name) {
    ChoosingDevice& on = chooser();
    const Scene scene = sceneOf(round.mesh, round.double_sided);
    Uploader uploader(on.device);
    const Geometry geometry(on.device, uploader, scene);
    const Materials materials(on.device, uploader, scene);
    uploader.flush();
    Pose pose;
    pose.instances.push_back({0, 0, 0, 0, round.placed});
    DrawList list = makeDrawList(pose, geometry, materials, round.view);
    ChosenCounts counts;
    if (list.items.empty()) return counts;
    const Culling culling(on.device, on.pipelines, on.layouts, geometry,
                          {pose, round.view, round.samples, true}, list);
    EXPECT_NE(culling.indirectDraws(), VkBuffer{VK_NULL_HANDLE});
    const std::vector<std::uint32_t> indices = culling.visibleIndices();
    const DrawItem& item = list.items[0];
    std::vector<std::array<std::uint32_t, 3>> visible;
    for (const IndexRange& run : std::span(list.runs).subspan(item.first_run, item.runs))
        for (std::uint32_t i = 0; i < run.count; i += 3)
            visible.push_back(
                {indices[run.first + i], indices[run.first + i + 1], indices[run.first + i + 2]});

    const SampleGrid grid{round.view.width, round.view.height, round.samples,
                          std::ldexp(1.0, -static_cast<int>(on.device.limits().subPixelPrecisionBits))};
    const PlacedPrimitive placed = geometry.placed(pose, pose.instances[0]);
    const glm::dmat4 fromCamera = fromEye(placed, round.view.eye());
    const VisibleMeshlets host(grid, round.view.clipFromWorld() * fromCamera, item.range.bounds_min,
                               item.range.bounds_max, !round.double_sided, item.mirrored);
    // From near to far, as Culling sorts.
    const glm::dvec4 depth = glm::transpose(fromCamera) * glm::dvec4(-round.view.backward(), 0);
    std::vector<std::pair<double, std::uint32_t>> order;
    for (std::uint32_t k = 0; k < item.range.meshlet_count; ++k) {
        const std::uint32_t meshlet = item.range.first_meshlet + k;
        order.emplace_back(glm::dot(depth, glm::dvec4(middleOf(geometry.meshlet(meshlet)), 1)), meshlet);
    }
    std::ranges::sort(order);
    const glm::mat4& clip = list.draws[item.draw].clip_from_object;
    std::size_t next = 0;
    for (const auto& [deep, number] : order) {
        const Meshlet& meshlet = geometry.meshlet(number);
        const std::span<const std::uint32_t> of = geometry.indicesOf(meshlet);
        counts.by_host += static_cast<std::size_t>(std::popcount(
            host.of(meshlet, geometry.meshletTriangles(), geometry.meshletTriangles()[number])));
        for (std::size_t i = 0; i < of.size(); i += 3) {
            const std::array<std::uint32_t, 3> numbers{of[i], of[i + 1], of[i + 2]};
            // Two consecutive triangles with the same corners are indistinguishable.
            const bool isKept = next < visible.size() && visible[next] == numbers;
            next += isKept;
            std::array<glm::vec3, 3> corners;
            for (std::size_t c = 0; c < 3; ++c) corners[c] = round.mesh.positions[numbers[c]];
            bool shows = false;
            for (const bool truncates : {false, true})
                for (const bool reversed : {false, true})
                    shows = shows || Rasteriser(grid, truncates, reversed)
                                         .shows(clip, corners, item.mirrored, round.double_sided);
            counts.triangles += 1;
            counts.kept += isKept;
            counts.shown += shows;
            EXPECT_TRUE(isKept || !shows) << name << ": cluster " << number << ", triangle " << i / 3;
        }
    }
    EXPECT_EQ(next, visible.size()) << name << ": of another order, or none of the mesh";
    return counts;
}

void addTo(ChosenCounts& all, const ChosenCounts& counts) {
    all.triangles += counts.triangles;
    all.kept += counts.kept;
    all.shown += counts.shown;
    all.by_host += counts.by_host;
}

glm::dmat4 turned(std::mt19937& random, const glm::dvec3& scale) {
    std::uniform_real_distribution<double> part(-1, 1);
    return glm::scale(glm::rotate(glm::dmat4(1), 3 * part(random),
                                  glm::normalize(glm::dvec3(part(random), 1, part(random)))),
                      scale);
}

TEST(CullingKernel, LeavesOutNothingThatCoversASample) {
    std::mt19937 random(21);
    std::uniform_real_distribution<double> part(-1, 1);
    ChosenCounts all;
    for (int i = 0; i < 160; ++i) {
        KernelRound round;
        round.samples = i % 3 == 0 ? (i % 2 == 0 ? 4 : 8) : 1;
        // Some have several meshlet ranges.
        round.mesh = tests::ballOf(i % 20 == 7 ? 60 : 6 + i % 17, i % 4 == 0 ? 0.3 : 0.0, random);
        round.placed = turned(random, {i % 7 == 3 ? -1 : 1, i % 6 == 0 ? 0.05 : 1, 1 + 0.5 * part(random)});
        round.double_sided = i % 9 == 0;
        const double away = std::exp(3.0 + 2.5 * part(random));
        const glm::dvec3 eye = away * glm::normalize(glm::dvec3(part(random), part(random), part(random)));
        const glm::dvec3 target =
            (i % 3 == 1 ? 0.4 * away : 0.5) * glm::dvec3(part(random), part(random), part(random));
        round.view = tests::viewOf({48 + i % 37, 40, round.samples}, eye, target, i % 2 == 0 ? 0.9 : 0.2,
                                   0.05, i % 8 == 5);
        // Some are far from the world's origin.
        if (i % 5 == 0) {
            const glm::dvec3 far(90'000, -300, 50'000);
            round.placed = glm::translate(glm::dmat4(1), far) * round.placed;
            round.view.camera.world_from_camera[3] += glm::dvec4(far, 0);
        }
        addTo(all, expectTheKernelKeepsWhatShows(round, fmt::format("round {}", i)));
        if (testing::Test::HasFailure()) return;
    }
    EXPECT_GT(all.shown, 5000u);
    EXPECT_LT(all.kept, all.triangles);
    RecordProperty("kept", fmt::format("{} of {}, by the host {}, {} show", all.kept, all.triangles,
                                       all.by_host, all.shown));
    EXPECT_LT(2 * all.kept, all.by_host) << "which keeps clusters that reach beyond the view whole";
    // Triangles kept without covering a sample are the cost of the margins: under a third of the visible
    // ones.
    EXPECT_LT(10 * all.kept, 13 * all.shown);
    EXPECT_EQ(chooser().device.validationMessages(), 0u) << chooser().device.firstValidationMessage();
}

// Ball far from its own origin, where the mesh has another triangle. Products of its corners cancel, and
// their error exceeds the rasteriser's snapping.
TEST(CullingKernel, LeavesOutNothingThatProductsMayMoveToASample) {
    std::mt19937 random(31);
    std::uniform_real_distribution<double> part(-1, 1);
    ChosenCounts all;
    for (int i = 0; i < 60; ++i) {
        KernelRound round;
        // Margins cover the worst case, so nearly all triangles are kept where rounding is visible.
        const glm::vec3 middle = (i % 2 == 0 ? 1.0f : 6.0f) * glm::vec3(2250, -750, 1250);
        round.mesh = tests::ballOf(i % 2 == 0 ? 8 + i % 5 : 50, i % 3 == 0 ? 0.1 : 0.0, random, middle);
        const auto first = static_cast<std::uint32_t>(round.mesh.positions.size());
        round.mesh.positions.insert(round.mesh.positions.end(), {{0, 0, 0}, {0.01f, 0, 0}, {0, 0.01f, 0}});
        round.mesh.indices.insert(round.mesh.indices.end(), {first, first + 1, first + 2});
        round.placed = glm::translate(turned(random, glm::dvec3(1)), -glm::dvec3(middle));
        round.double_sided = i % 5 == 0;
        const double away = 4 + 3 * part(random);
        const glm::dvec3 eye =
            (1.5 + away) * glm::normalize(glm::dvec3(part(random), part(random), part(random)));
        round.view = tests::viewOf({480 + i % 37, 270, 1}, eye, {0, 0, 0}, 0.9, 0.05, false);
        addTo(all, expectTheKernelKeepsWhatShows(round, fmt::format("round {}", i)));
        if (testing::Test::HasFailure()) return;
    }
    EXPECT_GT(all.shown, 5000u);
    EXPECT_GT(all.triangles - all.kept, 1000u);
}

// Seen along a triangle's plane, slightly in front or behind: near the facing threshold.
TEST(CullingKernel, LeavesOutNothingSeenAlongItsPlaneThatCoversASample) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> part(-1, 1);
    ChosenCounts all;
    for (int i = 0; i < 300; ++i) {
        KernelRound round;
        round.samples = i % 4 == 0 ? (i % 8 == 0 ? 4 : 8) : 1;
        round.mesh = tests::ballOf(3 + i % 6, i % 2 == 0 ? 0.15 : 0.0, random);
        round.placed = turned(random, {i % 7 == 3 ? -1 : 1, 1, 1 + 0.5 * part(random)});
        const std::size_t seen = random() % (round.mesh.indices.size() / 3);
        std::array<glm::dvec3, 3> at;
        for (std::size_t c = 0; c < 3; ++c)
            at[c] =
                glm::dvec3(round.placed *
                           glm::dvec4(glm::dvec3(round.mesh.positions[round.mesh.indices[3 * seen + c]]), 1));
        const glm::dvec3 normal = glm::cross(at[1] - at[0], at[2] - at[0]);
        if (!(glm::length(normal) > 1e-9)) continue;
        // Along one of its edges or across, and off its plane by a fraction of the distance.
        const double turn = 3.2 * part(random);
        const glm::dvec3 edge = glm::normalize(at[1] - at[0]), up = glm::normalize(normal),
                         along = std::cos(turn) * edge + std::sin(turn) * glm::cross(up, edge);
        const double away = std::exp(1.6 + 0.5 * part(random)),
                     fraction = std::pow(10.0, -3 + 1.5 * part(random)) * (i % 2 == 0 ? 1 : -1);
        const glm::dvec3 eye = at[static_cast<std::size_t>(i % 3)] + away * (along + fraction * up);
        round.view =
            tests::viewOf({640 + i % 101, 360, round.samples}, eye, {0, 0, 0}, 0.9, 0.05, i % 8 == 5);
        addTo(all, expectTheKernelKeepsWhatShows(round, fmt::format("round {}", i)));
        if (testing::Test::HasFailure()) return;
    }
    EXPECT_GT(all.shown, 5000u);
    EXPECT_GT(all.triangles - all.kept, 5000u);
    RecordProperty("kept", fmt::format("{} of {}, by the host {}, {} show", all.kept, all.triangles,
                                       all.by_host, all.shown));
    EXPECT_LT(all.kept, all.by_host);
    EXPECT_LT(10 * all.kept, 13 * all.shown);
}

// A board of one meshlet that reaches over an edge of the image by about a pixel is kept; one that is as
// far outside is culled.
TEST(CullingKernel, KeepsWhatReachesIntoTheViewAlone) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> part(0, 1);
    ChosenCounts within, beyond;
    for (int i = 0; i < 240; ++i) {
        KernelRound round;
        round.mesh = tests::boardOf(5);
        round.samples = i % 3 == 0 ? 4 : 1;
        const bool orthographic = i % 5 == 0, reaches = i % 7 < 4;
        round.view = tests::viewOf({640, 360, round.samples}, {0, 0, 0}, {0, 0, -1}, 0.9, 0.05, orthographic);
        const double size = orthographic ? 0.2 : 1, sides = orthographic ? 0.5 : 3 * std::tan(0.45),
                     pixel = 2 * sides / 360,
                     reach = (reaches ? 1.2 * part(random) : -0.01 - part(random)) * pixel;
        const bool across = i % 2 == 0;
        const double edge = across ? sides * 640 / 360 : sides,
                     at = (edge + size - reach) * (i % 4 < 2 ? 1 : -1);
        round.placed = glm::scale(glm::translate(glm::dmat4(1), glm::dvec3(across ? at : 0.3 * sides,
                                                                           across ? 0.3 * sides : at, -3)),
                                  glm::dvec3(size));
        round.double_sided = true;
        addTo(reaches ? within : beyond, expectTheKernelKeepsWhatShows(round, fmt::format("round {}", i)));
        if (testing::Test::HasFailure()) return;
    }
    EXPECT_GT(within.shown, 200u);
    EXPECT_EQ(within.by_host, within.triangles);
    EXPECT_LT(within.kept, within.triangles) << "of a board some triangles alone reach into it";
    EXPECT_EQ(beyond.kept, 0u);
}

// 2,304 triangles within a pixel, and within a quarter of one.
TEST(CullingKernel, LeavesOutWhatLiesBetweenSamples) {
    std::mt19937 random(3);
    for (const int samples : {1, 4})
        for (const double off : {0.0, 0.5}) {
            KernelRound round;
            round.mesh = tests::ballOf(24, 0, random);
            round.samples = samples;
            round.double_sided = true;
            round.view = tests::viewOf({64, 64, samples}, {0, 0, 500}, {0, 0, 0}, 0.9, 0.1, false);
            // The image's centre is a pixel corner, half a pixel from four pixel centres.
            const double pixel = 2 * 500.0 * std::tan(0.45) / 64, radius = 0.3 * pixel / samples;
            round.placed = glm::scale(glm::translate(glm::dmat4(1), glm::dvec3(off * pixel, off * pixel, 0)),
                                      glm::dvec3(radius));
            const ChosenCounts counts =
                expectTheKernelKeepsWhatShows(round, fmt::format("{} {}", samples, off));
            if (samples == 1 && off > 0) {
                EXPECT_GT(counts.kept, 0u);
                EXPECT_LT(counts.kept, counts.triangles / 10);
            } else {
                EXPECT_EQ(counts.kept, 0u) << samples << " " << off;
            }
        }
}

}  // namespace
}  // namespace diptych
