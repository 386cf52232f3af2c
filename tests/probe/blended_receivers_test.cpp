// SPDX-License-Identifier: MIT
// Receivers of the sun's shadow among blended surfaces: their view depths, and the shadow pages they read.
#include "shared/shadow/blended_receivers.h"

#include "shared/vulkan/device/device.h"
#include "shared/vulkan/device/resources.h"
#include "tests/probe/probe.h"
#include "tests/support/shapes.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include <bit>
#include <cmath>
#include <vector>

namespace diptych {
namespace {

// Unit square from (0, 0, 0) to (1, 1, 0), once blended (material 0) and once opaque.
class BlendedReceiversOf : public testing::Test {
protected:
    Scene scene = [] {
        Scene made;
        made.materials.resize(2);
        made.materials[0].alpha_mode = AlphaMode::blend;
        const Primitive p = rectangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
        Primitive opaque = p;
        opaque.material = 1;
        made.meshes = {{"square", {p, opaque}}};
        return made;
    }();
    Uploader uploader{probeDevice()};
    Geometry geometry{probeDevice(), uploader, scene};
    Materials materials{probeDevice(), uploader, scene};
    Pose pose;
    View view;
    DrawList draws;

    BlendedReceiversOf() {
        uploader.flush();
        view.camera.world_from_camera[3] = {5, 6, 7, 1};
        view.camera.yfov = glm::radians(90.0);
        view.camera.near = 1;
        view.camera.far = 100;
        view.width = view.height = 64;
    }
    // `at`: relative to the eye.
    void add(const glm::dvec3& at, const glm::dvec3& scale, int primitive = 0, double pitch = 0) {
        const glm::dmat4 placed = glm::translate(glm::dmat4(1), view.eye() + at);
        pose.instances.push_back(
            {0, primitive, 0, 0, glm::scale(glm::rotate(placed, pitch, glm::dvec3(1, 0, 0)), scale)});
        draws = makeDrawList(pose, geometry, materials, view, Transparency::sorted);
    }
    BlendedReceivers receivers() const { return {draws, pose, geometry, view}; }
};

TEST_F(BlendedReceiversOf, NothingHasNoDepths) {
    add({0, 0, -5}, glm::dvec3(1), 1);
    add({0, 0, 5}, glm::dvec3(1));
    EXPECT_FALSE(receivers().depths());
}

TEST_F(BlendedReceiversOf, DepthsAreThoseOfWhatTheViewShows) {
    add({0, 0, -5}, glm::dvec3(1));
    ASSERT_TRUE(receivers().depths());
    EXPECT_DOUBLE_EQ(receivers().depths()->near, 5);
    EXPECT_DOUBLE_EQ(receivers().depths()->far, 5);
    // Floor 2 m below the eye, from behind it to 30 m in front; visible from where the lower frustum
    // plane, at 45 degrees, meets it.
    add({-1, -2, 10}, glm::dvec3(2, 40, 1), 0, glm::radians(-90.0));
    EXPECT_NEAR(receivers().depths()->near, 2, 1e-12);
    EXPECT_NEAR(receivers().depths()->far, 30, 1e-12);
    // Extends past the eye: begins at the near plane.
    add({-0.5, -0.01, -20}, glm::dvec3(1, 30, 1), 0, glm::radians(90.0));
    EXPECT_NEAR(receivers().depths()->near, 1, 1e-12);
}

TEST_F(BlendedReceiversOf, RangesUniteWhereThereAreSome) {
    const DepthRange a{2, 5}, b{1, 3};
    EXPECT_FALSE(united({}, {}));
    EXPECT_EQ(united(a, {})->near, 2);
    EXPECT_EQ(united({}, a)->far, 5);
    EXPECT_EQ(united(a, b)->near, 1);
    EXPECT_EQ(united(b, a)->far, 5);
}

// Marks the pages of points all over a visible square, at the level of each point's distance, and at most
// four times as many others.
TEST_F(BlendedReceiversOf, EveryPageThatIsReadIsMarkedAndFewOthers) {
    add({-8, -1.5, 0.5}, glm::dvec3(16, 40, 1), 0, glm::radians(-85.0));
    const Bounds bounds{view.eye() - 50.0, view.eye() + 50.0};
    const Clipmap clipmap =
        fitClipmap(view, bounds, glm::normalize(glm::dvec3(0.3, 1, 0.2)), {.size = 512, .page = 32});
    std::vector<gpu::uint> marks((clipmap.pages() + 31) / 32), read(marks.size());
    receivers().mark(clipmap, marks);
    const glm::dmat4 clipFromWorld = view.clipFromWorld();
    constexpr int steps = 2000;
    for (int i = 0; i < steps; ++i)
        for (int k = 0; k < steps; ++k) {
            const glm::dvec3 world(pose.instances[0].world_from_object *
                                   glm::dvec4((i + 0.5) / steps, (k + 0.5) / steps, 0, 1));
            const glm::dvec4 clip = clipFromWorld * glm::dvec4(world - view.eye(), 1);
            if (std::abs(clip.x) > clip.w || std::abs(clip.y) > clip.w || clip.z > clip.w || clip.z < 0)
                continue;
            const double octaves =
                std::ceil(std::log2(glm::distance(world, clipmap.centre) / clipmap.levels[0].area.end));
            const auto level = static_cast<std::size_t>(
                std::clamp(octaves, 0.0, static_cast<double>(clipmap.levels.size() - 1)));
            const CascadeArea& area = clipmap.levels[level].area;
            const bool whole = level + 1 == clipmap.levels.size();
            const glm::dvec2 at =
                (glm::dvec2(clipmap.grid.space.from(world)) - area.corner) / (area.texel * 32);
            const std::size_t page = clipmap.numberOf(
                {level, whole ? 0 : static_cast<int>(at.x), whole ? 0 : static_cast<int>(at.y)});
            read[page / 32] |= gpu::uint{1} << (page % 32);
        }
    int needed = 0, marked = 0;
    for (std::size_t word = 0; word < marks.size(); ++word) {
        EXPECT_EQ(read[word] & ~marks[word], 0u) << word;
        needed += std::popcount(read[word]);
        marked += std::popcount(marks[word]);
    }
    EXPECT_GT(needed, 50);
    EXPECT_LT(marked, 4 * needed);
}

}  // namespace
}  // namespace diptych
