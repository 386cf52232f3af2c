// SPDX-License-Identifier: MIT
// Distance from a shadow edge within which a path may show any value: by view depth, or by the clipmap's
// resident level.
#include "compare/verdict/shadow_edges.h"

#include "shared/contract/debug_mode.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace diptych {
namespace {

Image rowOf(const std::vector<float>& values, int components = 1) {
    Image image(static_cast<int>(values.size()) / components, 1, components);
    std::ranges::copy(values, image.pixel(0));
    return image;
}

// Whether an edge is near, per pixel; empty if edges are unknown.
std::vector<bool> nearOf(const Frame& path, const std::vector<float>& edges) {
    Frame reference;
    reference.settings.path = Path::reference;
    std::vector<float> both;
    for (const float edge : edges) both.insert(both.end(), {edge, 1});
    reference.shadow_edge = rowOf(both, 2);
    const Requirements needs;
    const Coverage coverage = everyPixel(edges.size());
    const ShadowEdges shadow_edges({reference, path, needs, coverage});
    std::vector<bool> near;
    for (std::size_t i = 0; shadow_edges.any() && i < edges.size(); ++i)
        near.push_back(shadow_edges.isNear(i));
    return near;
}

TEST(ShadowEdges, CascadesReachByViewDepth) {
    Frame path;
    path.settings.path = Path::deferred;
    path.shadow_filter_radii = {{2, 0.1}, {8, 0.4}};
    EXPECT_TRUE(nearOf(path, {0, 0, 0, 0}).empty()) << "without depths";
    path.channels[Channel::depth] = rowOf({1, 1, 5, 50});
    EXPECT_EQ(nearOf(path, {0.05f, 0.2f, 0.2f, 0.3f}), (std::vector{true, false, true, true}));
}

// A coarser resident page applies its own filter radius, not that of the missing page.
TEST(ShadowEdges, AClipmapReachesByTheLevelThatServes) {
    Frame path;
    path.settings.path = Path::deferred;
    path.shadow_level_filter_radii = {{9, 0.1}, {9, 0.2}, {9, 0.4}, {9, 3}};
    path.channels[Channel::cascade] = rowOf({0, 0, 1, 1});
    EXPECT_TRUE(nearOf(path, {0, 0, 0, 0}).empty()) << "without what serves";
    path.channels[Channel::page_residency] = rowOf({0, 2, 0, 2});
    EXPECT_EQ(nearOf(path, {0.3f, 0.3f, 0.3f, 2.9f}), (std::vector{false, true, false, true}));
}

// Within a filter radius, all that the light adds, or all of its visibility; a distance equal to it counts.
TEST(ShadowEdges, GrantWhatTheirLightsAdd) {
    Frame reference, path;
    reference.settings.path = Path::reference;
    path.settings.path = Path::deferred;
    reference.shadow_edge = rowOf({0.125f, 3, 0.25f, 3, 0.125f, 3, 9, 3}, 2);
    reference.local_shadow_edge = rowOf({0.5f, 5, 0.5f, 5, 0.75f, 5, 0.75f, 5}, 2);
    path.shadow_filter_radii = {{10, 0.125}};
    path.local_shadow_filter_radius = 0.5;
    path.channels[Channel::depth] = rowOf({1, 1, 1, 1});
    const Requirements needs;
    const Coverage coverage = everyPixel(4);
    const auto grantedTo = [&](Channel mode) {
        const FramePair pair{path, reference, needs, coverage};
        const ShadowEdges edges(pair);
        std::vector<double> granted;
        for (std::size_t i = 0; i < 4; ++i) granted.push_back(edges.allowed(debugMode(mode), i));
        return granted;
    };
    using Granted = std::vector<double>;
    for (const Channel mode : {Channel::lit, Channel::lit_diffuse, Channel::lit_specular})
        EXPECT_EQ(grantedTo(mode), (Granted{8, 5, 3, 0})) << debugMode(mode).name;
    EXPECT_EQ(grantedTo(Channel::shadow_visibility), (Granted{1, 0, 1, 0}));
    EXPECT_EQ(grantedTo(Channel::local_visibility), (Granted{1, 1, 0, 0}));
    for (const Channel mode :
         {Channel::lit_ambient, Channel::lit_haze, Channel::albedo, Channel::light_count})
        EXPECT_EQ(grantedTo(mode), (Granted{0, 0, 0, 0})) << debugMode(mode).name;
    path.local_shadow_filter_radius = 0;
    EXPECT_EQ(grantedTo(Channel::lit), (Granted{3, 0, 3, 0})) << "no local shadows";
    reference.shadow_edge = {};
    EXPECT_EQ(grantedTo(Channel::lit), (Granted{0, 0, 0, 0}));
    path.local_shadow_filter_radius = 0.5;
    EXPECT_EQ(grantedTo(Channel::lit), (Granted{5, 5, 0, 0})) << "no sun";
}

}  // namespace
}  // namespace diptych
