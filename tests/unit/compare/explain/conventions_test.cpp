// SPDX-License-Identifier: MIT
// Conventions that another renderer's image shows, of images that are functions of the Settings.
#include "compare/explain/conventions.h"

#include "compare/explain/frame_images.h"
#include "tests/support/errors.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace diptych::tests {
namespace {

using Colour = std::array<float, 3>;
using Said = std::vector<std::pair<std::string, std::string>>;

Image pixelOf(const Colour& colour) {
    Image image(1, 1, 3);
    image.data.assign(colour.begin(), colour.end());
    return image;
}

bool has(const Settings& settings, const char* option, const char* value) {
    return settings.valueOf(option) == value;
}

// The conventions by which `colourOf` comes nearest to `theirs`.
std::vector<Convention> nearestOf(const std::function<Colour(const Settings&)>& colourOf,
                                  const Colour& theirs, const Settings& said = {}) {
    const Image image = pixelOf(theirs);
    return nearestConventions(said, {[&](const Settings& settings) { return pixelOf(colourOf(settings)); },
                                     [&](const Image& ours) { return meanOf(errorsOf(ours, image)); }});
}
Said saidBy(const std::vector<Convention>& conventions) {
    Said said;
    for (const Convention& each : conventions) said.emplace_back(each.option, each.value);
    return said;
}

// Each convention adds its own light.
Colour addedLight(const Settings& s) {
    return {
        has(s, "base-layer", "component") ? 3.0f : 0.0f,
        (has(s, "spot-cone", "smoothstep") ? 1.0f : 0.0f) + (has(s, "range-window", "squared") ? 8.0f : 0.0f),
        has(s, "multiscatter", "energy") ? 1.0f
        : has(s, "multiscatter", "fdez") ? 2.0f
                                         : 0.0f};
}

TEST(NearestConventions, EachIsFoundAndDescribed) {
    const std::pair<Convention, Colour> rows[] = {
        {{"base-layer", "component", "a base layer that loses, per component, what its coating reflects"},
         {3, 0, 0}},
        {{"spot-cone", "smoothstep", "spot lights with a smoothstep falloff at the cone edge"}, {0, 1, 0}},
        {{"range-window", "squared", "lights with a squared range window"}, {0, 8, 0}},
        {{"multiscatter", "energy", "multiple scattering between microfacets, as a gain of the lobe"},
         {0, 0, 1}},
        {{"multiscatter", "fdez", "multiple scattering between microfacets, as a separate lobe"}, {0, 0, 2}}};
    for (const auto& [convention, theirs] : rows) {
        const std::vector<Convention> found = nearestOf(addedLight, theirs);
        ASSERT_EQ(saidBy(found), (Said{{std::string(convention.option), std::string(convention.value)}}));
        EXPECT_EQ(found[0].description, convention.description);
        Settings set;
        set.set(convention.option, std::string(convention.value));
        EXPECT_EQ(withConventions({}, found), set);
    }
    EXPECT_EQ(saidBy(nearestOf(addedLight, {0, 0, 0})), Said{});
    EXPECT_EQ(saidBy(nearestOf(addedLight, {3, 9, 3})), (Said{{"base-layer", "component"},
                                                              {"spot-cone", "smoothstep"},
                                                              {"range-window", "squared"},
                                                              {"multiscatter", "fdez"}}))
        << "an option has one value";
    Settings said;
    said.set("multiscatter", "energy");
    EXPECT_EQ(saidBy(nearestOf(addedLight, {3, 0, 2}, said)), (Said{{"base-layer", "component"}}))
        << "what is said is believed";
}

// Taken alone, each of two that cancel leads away.
TEST(NearestConventions, TwoMayCancel) {
    const auto light = [](const Settings& s) {
        return Colour{(has(s, "base-layer", "component") ? 3.0f : 0.0f) -
                          (has(s, "range-window", "squared") ? 2.0f : 0.0f),
                      0, 0};
    };
    EXPECT_EQ(saidBy(nearestOf(light, {1, 0, 0})),
              (Said{{"base-layer", "component"}, {"range-window", "squared"}}));
}

// A change of 4 must bring the image nearer by more than 2.
TEST(NearestConventions, EachIsWorthHalfOfItsChange) {
    const auto light = [](const Settings& s) {
        return has(s, "spot-cone", "smoothstep") ? Colour{4, 4, 4} : Colour{0, 0, 0};
    };
    EXPECT_EQ(saidBy(nearestOf(light, {2.875f, 2.875f, 2.875f})), Said{});
    EXPECT_EQ(saidBy(nearestOf(light, {3, 3, 3})), Said{});
    EXPECT_EQ(saidBy(nearestOf(light, {3.125f, 3.125f, 3.125f})), (Said{{"spot-cone", "smoothstep"}}));
}

// Of two, the second is not worth its change beside the first; without it, the first is judged again by what
// is left: nearer by 0.25 of a change of 0.75, or by all of it.
TEST(NearestConventions, TheOthersAreJudgedAgainAfterARemoval) {
    for (const bool kept : {false, true}) {
        const auto light = [&](const Settings& s) {
            const bool first = has(s, "base-layer", "component"), second = has(s, "spot-cone", "smoothstep");
            return first    ? Colour{second ? 1.0f : -1.25f, 0, 0}
                   : second ? Colour{5, 0, 0}
                            : Colour{kept ? -1.25f : -1, 0.5f, 0};
        };
        EXPECT_EQ(saidBy(nearestOf(light, {0, 0, 0})), kept ? (Said{{"base-layer", "component"}}) : Said{});
    }
}

// ---- images of a Frame -------------------------------------------------------------------------------

TEST(FrameImages, OfAnExplanationByHand) {
    Image a(2, 1, 3), b(2, 1, 3);
    a.data = {1, 2, 4, NAN, 1, 2};
    b.data = {2, 0, 0.5f, 0, 3, 1};
    EXPECT_EQ(errorsOf(a, b), (std::vector<double>{6.5 / 3, 0}));
    EXPECT_EQ(differenceOf(a, b).data, (PixelData{-1, 2, 3.5f, 0, -2, 1}));
    EXPECT_EQ(differenceOf(a, b).width, 2);
    EXPECT_EQ(meanOf({1, 2, 6}), 3);
    EXPECT_EQ(meanOf({}), 0);
    EXPECT_EQ(colorAt(b, 1), glm::dvec3(0, 3, 1));
    EXPECT_TRUE(sameBits(a, a)) << "a NaN, too";
    EXPECT_FALSE(sameBits(a, b));
    EXPECT_FALSE(sameBits(Image(1, 1, 1, 0.0f), Image(1, 1, 1, -0.0f)));
    EXPECT_FALSE(sameBits(Image(1, 1, 1), Image(2, 1, 1)));
    Scene scene;
    scene.materials.resize(2);
    for (const auto& [id, material] : {std::pair{-1.0f, -1}, {0.0f, 0}, {1.0f, 1}, {2.0f, -1}, {NAN, -1}})
        EXPECT_EQ(materialOf(&id, scene), material) << id;
    Frame frame;
    frame.name = "deferred";
    EXPECT_EQ(faultOf([&] { channelOf(frame, Channel::albedo); }),
              "deferred has no channel albedo, which an explanation needs");
}

}  // namespace
}  // namespace diptych::tests
