// SPDX-License-Identifier: MIT
// Cascades of the sun's shadow map: contact shadows, stability of a moving camera, and seams.
#include "shared/contract/debug_mode.h"
#include "shared/shadow/cascades.h"
#include "tests/image/shadow_scenes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
#include <vector>

namespace diptych::tests {
namespace {

Settings cascaded(const Size& size, int texels, int cascades) {
    Settings settings = smallImage(GBufferEncoding::standard);
    settings.size = size;
    settings.shadows = Shadows::pcf;
    settings.shadow_size = texels;
    settings.shadow_cascades = cascades;
    return settings;
}

Frame drawnCascades(Renderer& renderer, const Settings& settings) {
    return drawnBy(Path::forward_plus, renderer, settings,
                   {Channel::shadow_visibility, Channel::cascade, Channel::depth, Channel::material_id,
                    Channel::position});
}
Frame drawnCascades(const Scene& scene, const Settings& settings) {
    Renderer renderer(device(), scene, pipelines());
    return drawnCascades(renderer, settings);
}

// A board leans over the ground at 45 degrees, away from the sun, touching it along x = 0. It casts a
// shadow, but the camera above sees only its culled back. So the whole image is ground, dark from the line
// of contact on.
struct Contact {
    double degrees = 45;  // of the sun above the ground
    int kernel = 3, texels = 1024;
    int cascades = 4, serving = 0;  // `serving`: the cascade of the ground in the image
    double padding = 0;             // m of depth behind the ground
};

struct Gap {
    double texels = 0;    // from the line of contact to the shadow, in light space: mean of all rows
    double min = 1;       // visibility on the sun's side, beyond the filter's radius and 1.5 texels
    double farthest = 0;  // largest distance behind the line with visibility over a half; texels
};

Gap gapOf(const Contact& contact) {
    constexpr double scale = 100, distance = 200;  // m
    constexpr Size size{320, 40};
    const Light sun = sunAt(contact.degrees);
    // The front faces the ground.
    Scene scene = groundUnder(sun, {rectangle({0, 0, -4}, {0, 0, 8}, {-4, 4, 0}, 1)}, scale);
    scene.materials[1].double_sided = false;
    if (contact.padding > 0) {
        Primitive speck = rectangle({0, 0, 0}, {1e-3f, 0, 0}, {0, 0, -1e-3f}, 2);
        for (glm::vec3& p : speck.positions) p += glm::vec3(sun.direction * contact.padding);
        scene.meshes.front().primitives.push_back(std::move(speck));
    }
    // Straight down, over the line.
    Camera& camera = scene.cameras.front();
    camera.orthographic = true;
    camera.near = 0.1;
    camera.far = 1e4;
    const std::vector<double> ends = splitDepths(distance / 500, distance, contact.cascades);
    const auto serving = static_cast<std::size_t>(contact.serving);
    const double begin = serving == 0 ? 0 : ends[serving - 1], end = ends[serving];
    const double height = (begin + end) / 2;
    camera.world_from_camera =
        glm::inverse(glm::lookAt(glm::dvec3(0, height, 0), glm::dvec3(0), glm::dvec3(0, 0, -1)));
    // The image is wide enough for the filter's radius and 1.75 texels on both sides of the line, in light
    // space. A cascade is about as wide as the bounding sphere of its part of the frustum.
    const glm::dvec3 to_light = -sun.direction;
    const double across = to_light.y / std::sqrt(1 - to_light.z * to_light.z);  // light space per ground
    const double part = 2 * (contact.kernel / 2.0 + 1.75) / across / contact.texels;  // of a cascade's width
    camera.ymag =
        part * (end - begin) / 2 / std::sqrt(std::max(1 - part * part, 0.05)) * size.height / size.width;
    Settings settings = cascaded(size, contact.texels, contact.cascades);
    settings.shadow_kernel = contact.kernel;
    settings.shadow_distance = static_cast<float>(distance);
    const Frame frame = drawnCascades(scene, settings);
    const Image &seen = frame.channels.at(Channel::shadow_visibility),
                &place = frame.channels.at(Channel::position);
    Gap gap;
    int rows = 0;
    for (int y = 0; y < size.height; ++y) {
        std::optional<double> begins;  // where visibility falls to a half, going away from the line
        for (int x = size.width - 1; x >= 0; --x) {
            EXPECT_EQ(frame.channels.at(Channel::material_id).at(x, y), 0);
            const auto serves = static_cast<std::size_t>(frame.channels.at(Channel::cascade).at(x, y));
            const double texel = frame.shadow_filter_radii.at(serves).texel;
            const double behind = -double{place.at(x, y, 0)} * across / texel;
            const double v{seen.at(x, y)};
            if (behind < -(contact.kernel / 2.0 + 1.5)) gap.min = std::min(gap.min, v);
            if (behind < 0) continue;
            if (v > 0.5) gap.farthest = std::max(gap.farthest, behind);
            if (v <= 0.5 && !begins) begins = behind;
        }
        EXPECT_TRUE(begins) << y;
        gap.texels += begins.value_or(1e9);
        ++rows;
    }
    gap.texels /= rows;
    return gap;
}

// Neither acne nor a gap at any grazing angle.
TEST(ShadowContactGap, IsAtMostOneAndAHalfTexelsAndTheFiltersRadius) {
    for (const double degrees : {0.1, 1.0, 10.0, 45.0, 80.0, 89.9})
        for (const int kernel : {1, 3, 7}) {
            Contact contact{.degrees = degrees, .kernel = kernel};
            if (degrees < 1) {
                contact.cascades = 1;  // one large map: a texel is 573 times longer on the ground
                contact.texels = kernel == 7 ? 8192 : 4096;
            }
            const Gap gap = gapOf(contact);
            EXPECT_LE(gap.farthest, 1.5 + kernel / 2.0) << degrees << " " << kernel;
            EXPECT_EQ(gap.min, 1) << degrees << " " << kernel;
            RecordProperty(fmt::format("gap_{}_{}", kernel, degrees), fmt::format("{:.3f}", gap.texels));
        }
}

// In texels the gap is the same in every cascade and for any depth range.
TEST(ShadowContactGap, IsTheSameInEveryCascadeAndAtEveryDepth) {
    for (const double degrees : {1.0, 20.0, 60.0})
        for (const int kernel : {3, 7}) {
            double min = 1e9, max = 0;
            const auto take = [&](int serving, double padding) {
                const Gap gap =
                    gapOf({.degrees = degrees, .kernel = kernel, .serving = serving, .padding = padding});
                min = std::min(min, gap.texels);
                max = std::max(max, gap.texels);
            };
            for (const int serving : {0, 1, 2, 3}) take(serving, 0);
            for (const double padding : {10.0, 1000.0}) take(1, padding);
            EXPECT_LE(max - min, 0.25) << degrees << " " << kernel << ": " << min << " to " << max;
        }
}

// A camera moving by whole pixels and along its view sees the same ground points at the same or
// neighbouring pixels. Their shadow is stable up to rounding: the camera is the origin.
TEST(ShadowWalk, StaticPointsKeepTheirVisibility) {
    constexpr Size size{160, 90};
    constexpr int steps = 100;
    constexpr double pixel = 0.02;  // m
    Scene scene =
        groundUnder(sunAt(40), {board(1), rectangle({-1, 0, 1.5f}, {0.5f, 0, 0.3f}, {0, 0.7f, 0}, 1)}, 3);
    const Camera first = scene.cameras.front();
    const glm::dmat4 from = glm::inverse(glm::lookAt(glm::dvec3(-6, 9, 5), glm::dvec3(-4, 0, 0), {0, 1, 0}));
    std::vector<int> across(steps + 1, 0);
    scene.cameras.clear();
    for (int i = 0; i <= steps; ++i) {
        if (i > 0) across[static_cast<std::size_t>(i)] = across[static_cast<std::size_t>(i) - 1] + i % 4;
        Camera camera = first;
        camera.orthographic = true;
        camera.ymag = pixel * size.height / 2;
        camera.far = 100;
        camera.world_from_camera = from;
        camera.world_from_camera[3] +=
            from[0] * (pixel * across[static_cast<std::size_t>(i)]) - from[2] * (0.0137 * i);
        scene.cameras.push_back(camera);
    }
    Renderer renderer(device(), scene, pipelines());
    std::uint64_t same = 0, changed = 0;
    std::optional<Frame> last;
    for (int i = 0; i <= steps; ++i) {
        Settings settings = cascaded(size, 512, 3);
        settings.camera = std::to_string(i);
        settings.shadow_distance = 16;
        Frame frame = drawnCascades(renderer, settings);
        const int moved = i % 4;
        for (int y = 0; last && y < size.height; ++y)
            for (int x = 0; x + moved < size.width; ++x) {
                const auto at = [&](const Frame& f, Channel channel, int column) {
                    return f.channels.at(channel).at(column, y);
                };
                const float now = at(frame, Channel::cascade, x),
                            before = at(*last, Channel::cascade, x + moved);
                if (now != before || now < 0 ||
                    at(frame, Channel::material_id, x) != at(*last, Channel::material_id, x + moved))
                    continue;
                // Not where a cascade blends into the next.
                const auto number = static_cast<std::size_t>(now);
                if (std::max(at(frame, Channel::depth, x), at(*last, Channel::depth, x + moved)) >
                    frame.shadow_filter_radii.at(number).depth)
                    continue;
                ++same;
                changed += std::abs(at(frame, Channel::shadow_visibility, x) -
                                    at(*last, Channel::shadow_visibility, x + moved)) > 1.0f / 256;
            }
        last = std::move(frame);
    }
    EXPECT_GT(same, 500'000u);
    EXPECT_LE(static_cast<double>(changed), 1e-4 * static_cast<double>(same)) << changed << " of " << same;
    RecordProperty("changed", std::to_string(changed));
}

// A shadow's straight edge crosses the cascades. From row to row it moves by the maps' texel size; between
// cascades by at most twice that.
TEST(ShadowSeams, AreNoWiderThanTexels) {
    constexpr Size size{320, 240};
    Scene scene = groundUnder(sunAt(45), {}, 25);
    scene.meshes.front().primitives.push_back(rectangle({0, 0, 100}, {0, 0, -200}, {0, 1, 0}, 1));
    Camera& camera = scene.cameras.front();
    camera.near = 0.1;
    camera.world_from_camera =
        glm::inverse(glm::lookAt(glm::dvec3(-1, 2, 50), glm::dvec3(-1, 0, 30), glm::dvec3(0, 1, 0)));
    Settings settings = with(cascaded(size, 256, 4), "shadow-distance 60 shadow-bias 0.5");
    const Frame frame = drawnCascades(scene, settings);
    struct Row {
        int cascade;
        double edge, texel;  // where visibility rises to a half, m; m
    };
    std::vector<Row> rows;
    for (int y = size.height - 1; y >= 0; --y) {
        std::optional<Row> row;
        for (int x = 1; x < size.width; ++x) {
            const auto value = [&](Channel channel, int column, int c = 0) {
                return double{frame.channels.at(channel).at(column, y, c)};
            };
            if (value(Channel::material_id, x) != 0 || value(Channel::material_id, x - 1) != 0 ||
                value(Channel::cascade, x) < 0)
                continue;
            const double left = value(Channel::shadow_visibility, x - 1),
                         right = value(Channel::shadow_visibility, x);
            if (left >= 0.5 && right < 0.5 && !row) {
                const double part = (left - 0.5) / (left - right);
                const auto number = static_cast<std::size_t>(value(Channel::cascade, x));
                row = {static_cast<int>(number),
                       value(Channel::position, x - 1) +
                           part * (value(Channel::position, x) - value(Channel::position, x - 1)),
                       frame.shadow_filter_radii.at(number).texel};
            }
        }
        if (row) rows.push_back(*row);
    }
    ASSERT_GT(rows.size(), 60u);
    std::vector<double> inside(4, 0);  // the largest step within each cascade
    for (std::size_t i = 1; i < rows.size(); ++i)
        if (rows[i].cascade == rows[i - 1].cascade) {
            double& max = inside[static_cast<std::size_t>(rows[i].cascade)];
            max = std::max(max, std::abs(rows[i].edge - rows[i - 1].edge));
        }
    int seams = 0;
    for (std::size_t i = 1; i < rows.size(); ++i) {
        if (rows[i].cascade == rows[i - 1].cascade) continue;
        ++seams;
        const auto a = static_cast<std::size_t>(rows[i - 1].cascade),
                   b = static_cast<std::size_t>(rows[i].cascade);
        EXPECT_LE(std::abs(rows[i].edge - rows[i - 1].edge), 2 * std::max(inside[a], inside[b]))
            << a << " to " << b;
        RecordProperty(fmt::format("seam_{}", a),
                       fmt::format("{:.4f} of {:.4f}", std::abs(rows[i].edge - rows[i - 1].edge),
                                   std::max(inside[a], inside[b])));
    }
    EXPECT_GE(seams, 2);
}

}  // namespace
}  // namespace diptych::tests
