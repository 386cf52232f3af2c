// SPDX-License-Identifier: MIT
// Channels of surfaces with transmission against the reference in mode surface, which traces these surfaces
// itself.
#include "compare/verdict/blended_pixels.h"
#include "compare/verdict/tolerance.h"
#include "shared/contract/debug_mode.h"

#include <gtest/gtest.h>

namespace diptych {
namespace {

constexpr int glassSide = 8;

// A pane 2 m thick on the right half of the reference's image, from column 4 on.
struct GlassPair {
    static constexpr Channel thickness = Channel::transmission_thickness;
    Frame reference, path;
    Requirements needs;
    Coverage covered = everyPixel(std::size_t{glassSide} * glassSide);

    GlassPair() {
        reference.settings.path = Path::reference;
        path.settings.path = Path::forward_plus;
        reference.blended = Image(glassSide, glassSide, 3);
        reference.channels[thickness] = path.channels[thickness] = pane(4, 2);
        for (std::size_t i = 0; i < reference.blended.pixels(); ++i)
            reference.blended.pixel(i)[0] = reference.channels[thickness].data[i] > 0 ? 1.0f : 0.0f;
    }
    static Image pane(int column, float thick) {
        Image image(glassSide, glassSide, 1);
        for (int y = 0; y < glassSide; ++y)
            for (int x = column; x < glassSide; ++x) image.at(x, y) = thick;
        return image;
    }
    double excess() const {
        const DebugMode& mode = debugMode(thickness);
        const FramePair pair{reference, path, needs, covered};
        return nearestRank(certainErrors(mode, pair).value(), 0.999) / derivedTolerance(mode, pair).max;
    }
};

TEST(GlassChannels, EdgesMayBeBesideThoseOfTheReference) {
    GlassPair p;
    EXPECT_EQ(p.excess(), 0);
    p.path.channels[GlassPair::thickness] = GlassPair::pane(5, 2);
    EXPECT_EQ(p.excess(), 0);
    p.path.channels[GlassPair::thickness] = GlassPair::pane(7, 2);
    EXPECT_GT(p.excess(), 1) << "three pixels away";
}

TEST(GlassChannels, ATextureMayBeACodeOff) {
    GlassPair p;
    p.path.channels[GlassPair::thickness] = GlassPair::pane(4, 2 + 0.9f * 3 / 255);
    EXPECT_GT(p.excess(), 1) << "no texture";
    p.needs.textures = 1;
    for (const float range : {3.0f, 2.0f}) {
        p.needs.volume_thickness_range = range;
        EXPECT_EQ(p.excess() <= 1, range == 3) << range;
    }
    p.path.channels[GlassPair::thickness] = GlassPair::pane(4, 2.0001f);
    p.needs = {};
    EXPECT_LE(p.excess(), 1) << "float32";
}

// A code of 8 bits: of a number, or of the thickness that a texture scales. Other channels have no texels.
TEST(GlassChannels, TexelsHave8Bits) {
    GlassPair p;
    p.needs.textures = 1;
    p.needs.volume_thickness_range = 3;
    for (const auto& [channel, allowed] : {std::pair{Channel::transmission, 1.0 / 255},
                                           {Channel::transmission_thickness, 3.0 / 255},
                                           {Channel::dispersion, 0.0}}) {
        const DebugMode& mode = debugMode(channel);
        p.reference.channels[channel] = Image(glassSide, glassSide, mode.width, 0.5f);
        const FramePair pair{p.reference, p.path, p.needs, p.covered};
        EXPECT_EQ(BlendedPixels(pair).allowed(mode, glassSide - 1), allowed) << mode.name;
        EXPECT_EQ(BlendedPixels(pair).allowed(mode, 0), 0) << mode.name << ": no glass";
        p.needs.textures = 0;
        EXPECT_EQ(BlendedPixels(pair).allowed(mode, glassSide - 1), 0) << mode.name << ": no texture";
        p.needs.textures = 1;
    }
}

}  // namespace
}  // namespace diptych
