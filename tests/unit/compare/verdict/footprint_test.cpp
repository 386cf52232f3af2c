// SPDX-License-Identifier: MIT
// Comparison with a reference in mode scene: which pixels have tight bounds, which are evaluated by FLIP, and
// that either can fail.
#include "compare/verdict/footprint.h"
#include "compare/metrics/flip.h"
#include "compare/verdict/blended_pixels.h"
#include "compare/verdict/comparison.h"
#include "shared/frame/supported_channels.h"
#include "tests/support/report_builder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace diptych {
namespace {

constexpr int side = 32;

// The reference in mode scene and forward+; an image of one material with constant channels.
std::vector<Frame> evenFrames() {
    std::vector<Frame> frames(2);
    for (const Path path : {Path::reference, Path::forward_plus}) {
        Frame& frame = frames[path == Path::forward_plus];
        frame.name = std::string(nameOf(path));
        frame.scene = "builtin:one";
        frame.settings.path = path;
        frame.settings.size = {side, side};
        frame.settings.reference_mode =
            path == Path::reference ? ReferenceMode::scene : ReferenceMode::surface;
        for (const DebugMode& mode : debugModes()) {
            if (!isSupportedByReference(mode)) continue;
            Image& image = frame.channels[mode.channel] =
                Image(side, side, mode.width, mode.kind == ChannelKind::id ? 3.0f : 0.5f);
            if (isAngle(mode.error_kind))
                for (std::size_t i = 0; i < image.pixels(); ++i)
                    std::ranges::copy(std::array{0.6f, 0.0f, 0.8f}, image.pixel(i));
        }
    }
    return frames;
}

Image& channelIn(Frame& frame, Channel mode) {
    return frame.channels.at(mode);
}

ChannelDiff evaluated(std::vector<Frame> frames, Channel mode, const CompareOptions& options = {},
                      const Requirements& needs = {}) {
    Report report;
    report.device = {"a CPU", "1.0", "cpu"};
    report.frames = std::move(frames);
    for (Frame& frame : report.frames) frame.requested = {mode};
    const Comparison comparison = compareFrames(report, 0, 1, needs, options);
    const bool traced = std::ranges::any_of(report.frames, [](const Frame& frame) {
        return frame.settings.reference_mode == ReferenceMode::scene;
    });
    EXPECT_EQ(std::ranges::any_of(comparison.notes,
                                  [](const auto& n) { return n.starts_with("--reference-mode scene: "); }),
              traced);
    for (const ChannelDiff& channel : comparison.channels)
        if (channel.mode->channel == mode) return channel;
    throw std::runtime_error("no such channel");
}

// A checkerboard of two values in the left half.
void addDetail(Image& image, float low, float high, int phase = 0) {
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side / 2; ++x)
            for (int c = 0; c < image.components; ++c) image.at(x, y, c) = (x + y + phase) % 2 ? low : high;
}

TEST(Footprint, EvenPixelsAreHeldTightly) {
    std::vector<Frame> frames = evenFrames();
    const ChannelDiff even = evaluated(frames, Channel::roughness);
    ASSERT_TRUE(even.footprints.has_value());
    EXPECT_EQ(even.footprints->smooth, std::uint64_t{side * side});
    EXPECT_EQ(even.footprints->detailed, 0u);
    EXPECT_EQ(even.verdict, Verdict::pass);
    EXPECT_NEAR(even.tolerance.max, 1e-4, 1e-9);
    for (float& v : channelIn(frames[1], Channel::roughness).data) v = 0.5f + 0.9e-4f;
    EXPECT_EQ(evaluated(frames, Channel::roughness).verdict, Verdict::pass);
    for (float& v : channelIn(frames[1], Channel::roughness).data) v = 0.5f + 1.2e-4f;
    const ChannelDiff off = evaluated(frames, Channel::roughness);
    EXPECT_EQ(off.verdict, Verdict::fail);
    EXPECT_NE(off.reason.find("1.2 times the bound"), std::string::npos) << off.reason;
}

// p99.9: of 1,024 pixels one may be out of tolerance, two may not.
TEST(Footprint, OnePixelInAThousandMayBeBeyond) {
    for (const int count : {1, 2}) {
        std::vector<Frame> frames = evenFrames();
        for (int i = 0; i < count; ++i) channelIn(frames[1], Channel::depth).at(4 + 8 * i, 8) = 0.5f * 1.1f;
        EXPECT_EQ(evaluated(frames, Channel::depth).verdict, count == 1 ? Verdict::pass : Verdict::fail);
        EXPECT_EQ(evaluated(frames, Channel::depth).footprints->beyond, static_cast<std::uint64_t>(count));
    }
}

TEST(Footprint, DetailIsEvaluatedByFlip) {
    std::vector<Frame> frames = evenFrames();
    for (Frame& frame : frames) addDetail(channelIn(frame, Channel::albedo), 0.2f, 0.8f);
    const ChannelDiff alike = evaluated(frames, Channel::albedo);
    EXPECT_EQ(alike.footprints->detailed, std::uint64_t{side * (side / 2 + 1)})
        << "the board, and the even column beside it";
    EXPECT_EQ(alike.footprints->flip, 0);
    EXPECT_EQ(alike.verdict, Verdict::pass);
    // Another mean is another texture; the right half stays unchanged.
    addDetail(channelIn(frames[1], Channel::albedo), 0.0f, 0.1f);
    const ChannelDiff other = evaluated(frames, Channel::albedo);
    EXPECT_EQ(other.footprints->beyond, 0u);
    EXPECT_GT(other.footprints->flip, detailFlip);
    EXPECT_EQ(other.verdict, Verdict::fail);
    EXPECT_NE(other.reason.find("mean FLIP"), std::string::npos) << other.reason;
    EXPECT_NE(other.tolerance.because.find("may have a mean FLIP"), std::string::npos);
}

// FLIP is averaged over the pixels with detail, however many others the image has.
TEST(Footprint, FlipIsOfTheDetailAlone) {
    std::vector<Frame> frames = evenFrames();
    addDetail(channelIn(frames[0], Channel::albedo), 0.2f, 0.8f);
    addDetail(channelIn(frames[1], Channel::albedo), 0.0f, 0.1f);
    std::vector<std::uint8_t> detailed(side * side, 0);
    for (std::size_t i = 0; i < detailed.size(); ++i) detailed[i] = i % side <= side / 2;
    FlipOptions options;
    options.covered = detailed;
    const double expected =
        ldrFlip(channelIn(frames[0], Channel::albedo), channelIn(frames[1], Channel::albedo), options).mean;
    const ChannelDiff albedo = evaluated(frames, Channel::albedo);
    EXPECT_NEAR(albedo.footprints->flip, expected, 1e-12);
    EXPECT_GT(
        expected,
        1.5 * ldrFlip(channelIn(frames[0], Channel::albedo), channelIn(frames[1], Channel::albedo), {}).mean);
}

// Detail in either image counts: a path may filter away detail of the reference, and vice versa.
TEST(Footprint, APixelIsSmoothOnlyInBoth) {
    for (const std::size_t other : {0u, 1u}) {
        std::vector<Frame> frames = evenFrames();
        addDetail(channelIn(frames[other], Channel::albedo), 0.47f, 0.53f);
        const ChannelDiff albedo = evaluated(frames, Channel::albedo);
        EXPECT_EQ(albedo.footprints->detailed, std::uint64_t{side * (side / 2 + 1)}) << other;
        EXPECT_EQ(albedo.footprints->beyond, 0u);
        EXPECT_EQ(albedo.verdict, Verdict::pass) << albedo.reason;
    }
}

// The tested image does not widen its own tolerance, left or right. Examples: wrong depths around a very
// wrong one, and uneven albedo where the reference is constant.
TEST(Footprint, OnlyTheReferencesSurroundingsAreGranted) {
    for (const std::size_t path : {1u, 0u}) {
        std::vector<Frame> frames = evenFrames();
        if (path == 0) std::swap(frames[0], frames[1]);
        Image& depth = channelIn(frames[path], Channel::depth);
        for (int y = 9; y < 12; ++y)
            for (int x = 9; x < 12; ++x) depth.at(x, y) = 0.6f;
        depth.at(10, 10) = 100;
        EXPECT_EQ(evaluated(frames, Channel::depth).footprints->beyond, 9u);
        addDetail(channelIn(frames[path], Channel::albedo), 0.496f, 0.504f);
        const ChannelDiff albedo = evaluated(frames, Channel::albedo);
        EXPECT_EQ(albedo.footprints->smooth, std::uint64_t{side * side});
        EXPECT_EQ(albedo.footprints->beyond, std::uint64_t{side * side / 2});
        EXPECT_EQ(albedo.verdict, Verdict::fail);
        // Negative control: a path may vary as much as the reference varies.
        std::swap(frames[0].channels, frames[1].channels);
        EXPECT_EQ(evaluated(frames, Channel::albedo).footprints->beyond, 0u);
    }
}

// A material edge may change depth at one pixel. A moved camera changes depth everywhere and fails.
TEST(Footprint, GeometryIsHeldInsideOfMaterials) {
    std::vector<Frame> frames = evenFrames();
    for (Frame& frame : frames)
        for (int y = 0; y < side; ++y)
            for (int x = 0; x < side / 2; ++x) {
                channelIn(frame, Channel::material_id).at(x, y) = 4;
                channelIn(frame, Channel::depth).at(x, y) = 7;
            }
    channelIn(frames[1], Channel::depth).at(side / 2 - 1, 5) = 0.5f;
    const ChannelDiff edge = evaluated(frames, Channel::depth);
    EXPECT_EQ(edge.verdict, Verdict::pass);
    EXPECT_EQ(edge.footprints->edges, std::uint64_t{2 * side});
    for (float& v : channelIn(frames[1], Channel::depth).data) v *= 1.001f;
    EXPECT_EQ(evaluated(frames, Channel::depth).verdict, Verdict::fail);
}

// A different material everywhere is not an edge, and neither is a missing object.
TEST(Footprint, AnotherMaterialIsNoEdge) {
    for (const float id : {5.0f, -1.0f}) {
        std::vector<Frame> frames = evenFrames();
        for (float& v : channelIn(frames[1], Channel::material_id).data) v = id;
        for (float& v : channelIn(frames[1], Channel::depth).data) v = id < 0 ? 0 : 0.7f;
        EXPECT_EQ(evaluated(frames, Channel::material_id).verdict, Verdict::fail) << id;
        EXPECT_EQ(evaluated(frames, Channel::depth).verdict, Verdict::fail) << id;
    }
}

// A NaN is a fault everywhere; FLIP's mean over the detail would hide two of them.
TEST(Footprint, NansAreNeverDetail) {
    std::vector<Frame> frames = evenFrames();
    for (Frame& frame : frames) addDetail(channelIn(frame, Channel::albedo), 0.2f, 0.8f);
    for (const int x : {3, 7})
        channelIn(frames[1], Channel::albedo).at(x, 4) = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(evaluated(frames, Channel::albedo).verdict, Verdict::fail);
}

// An infinite uncertainty of the reference does not excuse a NaN.
TEST(Footprint, AnInfiniteBoundHoldsNoNan) {
    std::vector<Frame> frames = evenFrames();
    frames[0].uncertainty = Image(side, side, 1, std::numeric_limits<float>::infinity());
    for (float& v : channelIn(frames[1], Channel::lit).data) v = 0.9f;
    EXPECT_EQ(evaluated(frames, Channel::lit).footprints->used, 0) << "it excuses any number";
    for (const int x : {3, 7})
        channelIn(frames[1], Channel::lit).at(x, 4) = std::numeric_limits<float>::quiet_NaN();
    const ChannelDiff lit = evaluated(frames, Channel::lit);
    EXPECT_EQ(lit.footprints->beyond, 2u);
    EXPECT_EQ(lit.footprints->used, std::numeric_limits<double>::infinity());
    EXPECT_EQ(lit.footprints->x, 3) << "where it is";
    EXPECT_EQ(lit.footprints->y, 4);
    EXPECT_EQ(lit.verdict, Verdict::fail);
}

// Light has tight bounds where both images show the same surface; elsewhere the surface's channel fails.
TEST(Footprint, LightIsHeldWhereTheSurfaceIsOne) {
    std::vector<Frame> frames = evenFrames();
    for (float& v : channelIn(frames[1], Channel::lit).data) v *= 1.01f;
    EXPECT_EQ(evaluated(frames, Channel::lit).verdict, Verdict::fail);
    for (float& v : channelIn(frames[1], Channel::metallic).data) v += 0.01f;
    const ChannelDiff light = evaluated(frames, Channel::lit);
    EXPECT_EQ(light.footprints->smooth, 0u);
    EXPECT_EQ(light.verdict, Verdict::pass) << "a hundredth is no FLIP of 0.3";
    EXPECT_EQ(evaluated(frames, Channel::metallic).verdict, Verdict::fail);
}

// Light is evaluated alike whichever channels are compared. Channels missing in both images do not matter. If
// one image lacks a channel, surfaces may differ; then the report says that only FLIP decides, and --strict
// fails.
TEST(Footprint, LightIsHeldTightlyWhateverIsCompared) {
    std::vector<Frame> frames = evenFrames();
    for (Frame& frame : frames) frame.requested = {Channel::lit};
    for (float& v : channelIn(frames[1], Channel::lit).data) v *= 1.01f;
    EXPECT_EQ(evaluated(frames, Channel::lit).verdict, Verdict::fail);
    for (Frame& frame : frames) frame.channels.erase(Channel::albedo);
    EXPECT_EQ(evaluated(frames, Channel::lit).verdict, Verdict::fail) << "neither has albedo";
    frames[0].channels.erase(Channel::metallic);
    const ChannelDiff loose = evaluated(frames, Channel::lit);
    EXPECT_EQ(loose.footprints->closeFraction(), 0);
    EXPECT_EQ(loose.verdict, Verdict::pass);
    Report report;
    report.device = {"a CPU", "1.0", "cpu"};
    report.frames = std::move(frames);
    CompareOptions options;
    const std::string line =
        "almost no pixel has a bound of its own in lit (0 of 1024 pixels, the others by a mean FLIP of "
        "0.3)";
    EXPECT_EQ(compareFrames(report, 0, 1, {}, options).emptiness, line);
    options.strict = true;
    const Comparison strict = compareFrames(report, 0, 1, {}, options);
    EXPECT_EQ(strict.failures, std::vector<std::string>{line + "; --strict does not accept that"});
    EXPECT_FALSE(strict.passed());
}

TEST(Footprint, TheChannelsOfASurfaceAreThoseThatLightNeeds) {
    const std::vector<Channel> channels = footprintChannels();
    for (const Channel mode : {Channel::albedo, Channel::metallic, Channel::roughness, Channel::normals,
                               Channel::emission, Channel::material_id})
        EXPECT_EQ(std::ranges::count(channels, mode), 1) << debugMode(mode).name;
    for (const Channel mode : {Channel::lit, Channel::depth, Channel::light_count})
        EXPECT_EQ(std::ranges::count(channels, mode), 0) << debugMode(mode).name;
}

TextureSampling exactTexels() {
    TextureSampling texels;
    for (std::size_t code = 0; code < 256; ++code) {
        texels.linear[code] = static_cast<float>(code) / 255;
        texels.srgb[code] = static_cast<float>(exactSrgb(code));
    }
    return texels;
}

// Texel errors are tolerated as measured on the device: at this code and no more.
TEST(Footprint, TexelsAreGrantedWhatIsMeasured) {
    CompareOptions options;
    TextureSampling& texels = options.texels.emplace(exactTexels());
    std::vector<Frame> frames = evenFrames();
    // At 0.5 a code is 0.006 wide; mip levels may be off by this.
    for (float& v : channelIn(frames[1], Channel::albedo).data) v = 0.5f + 0.005f;
    EXPECT_EQ(evaluated(frames, Channel::albedo).verdict, Verdict::fail);
    EXPECT_EQ(evaluated(frames, Channel::albedo, options).verdict, Verdict::pass);
    for (float& v : channelIn(frames[1], Channel::albedo).data) v = 0.5f + 0.012f;
    EXPECT_EQ(evaluated(frames, Channel::albedo, options).verdict, Verdict::fail);
    texels.srgb[220] = static_cast<float>(exactSrgb(220) * 1.02);
    EXPECT_EQ(evaluated(frames, Channel::albedo, options).verdict, Verdict::pass) << "2 % at a brighter code";
    texels.srgb[220] = static_cast<float>(exactSrgb(220));
    texels.srgb[100] = static_cast<float>(exactSrgb(100) * 1.02);
    EXPECT_EQ(evaluated(frames, Channel::albedo, options).verdict, Verdict::fail)
        << "no factor brightens a darker code to a half";
    for (float& v : channelIn(frames[1], Channel::roughness).data) v = 0.5f + 0.9f / 255;
    EXPECT_EQ(evaluated(frames, Channel::roughness, options).verdict, Verdict::pass);
    for (float& v : channelIn(frames[1], Channel::roughness).data) v = 0.5f + 1.1f / 255;
    EXPECT_EQ(evaluated(frames, Channel::roughness, options).verdict, Verdict::fail);
}

// A sheen's colour is decoded by the sRGB curve, its roughness and a film's weight are linear.
TEST(Footprint, TexelsOfASheenAndAFilmAreGranted) {
    CompareOptions options;
    options.texels = exactTexels();
    for (const auto& [mode, code] : {std::pair{Channel::sheen_color, 0.006f},
                                     {Channel::sheen_roughness, 1.0f / 255},
                                     {Channel::iridescence, 1.0f / 255}})
        for (const float fraction : {0.8f, 2.0f}) {
            std::vector<Frame> frames = evenFrames();
            for (float& v : channelIn(frames[1], mode).data) v = 0.5f + fraction * code;
            EXPECT_EQ(evaluated(frames, mode).verdict, Verdict::fail)
                << debugMode(mode).name << " without texels";
            EXPECT_EQ(evaluated(frames, mode, options).verdict, fraction < 1 ? Verdict::pass : Verdict::fail)
                << debugMode(mode).name << " " << fraction;
        }
}

// A code of a thickness texture is 1/255 of the thicknesses among which it chooses: of a film, or of the
// volume's that it scales.
TEST(Footprint, TexelsOfAThicknessAreGrantedByItsRange) {
    CompareOptions options;
    options.texels = exactTexels();
    for (const auto& [mode, range, thickness] : {std::tuple{Channel::iridescence_thickness, 300.0f, 400.0f},
                                                 {Channel::transmission_thickness, 0.3f, 0.5f}})
        for (const float part : {1.0f, 0.6f, 0.0f}) {
            std::vector<Frame> frames = evenFrames();
            for (Frame& frame : frames) std::ranges::fill(channelIn(frame, mode).data, thickness);
            for (float& v : channelIn(frames[1], mode).data) v += 0.9f * range / 255;
            Requirements needs;
            (mode == Channel::iridescence_thickness ? needs.film_thickness_range
                                                    : needs.volume_thickness_range) = part * range;
            EXPECT_EQ(evaluated(frames, mode, options, needs).verdict,
                      part == 1 ? Verdict::pass : Verdict::fail)
                << debugMode(mode).name << " " << part;
        }
}

// As images, indices above 1 must not all be white.
TEST(Footprint, DetailOfLargeIndicesIsEvaluated) {
    std::vector<Frame> frames = evenFrames();
    addDetail(channelIn(frames[0], Channel::iridescence_ior), 1.2f, 1.6f);
    addDetail(channelIn(frames[1], Channel::iridescence_ior), 1.2f, 1.6f);
    EXPECT_EQ(evaluated(frames, Channel::iridescence_ior).verdict, Verdict::pass);
    addDetail(channelIn(frames[1], Channel::iridescence_ior), 10, 10);
    EXPECT_EQ(evaluated(frames, Channel::iridescence_ior).verdict, Verdict::fail);
}

// Specular-glossiness: albedo is diffuse times 1 - F0, so a code of F0 counts as well: at 0.5, and a diffuse
// colour of 1, as much as one of albedo. At F0 0.01 it is a tenth.
TEST(Footprint, TexelsOfF0AreGrantedToTheAlbedoThatTheyDarken) {
    CompareOptions options;
    options.texels = exactTexels();
    Requirements glossy;
    glossy.specular_glossiness = true;
    std::vector<Frame> frames = evenFrames();
    for (float& v : channelIn(frames[1], Channel::albedo).data) v = 0.5f + 0.010f;
    EXPECT_EQ(evaluated(frames, Channel::albedo, options).verdict, Verdict::fail);
    EXPECT_EQ(evaluated(frames, Channel::albedo, options, glossy).verdict, Verdict::pass);
    for (Frame& frame : frames)
        for (float& v : channelIn(frame, Channel::dielectric_f0).data) v = 0.01f;
    EXPECT_EQ(evaluated(frames, Channel::albedo, options, glossy).verdict, Verdict::fail);
}

// The tolerance's words, with the numbers of each kind of pixel that there is.
TEST(Footprint, ATolerancesWordsCountItsPixels) {
    Footprints f;
    f.smooth = 1;
    f.max = 0.25;
    const std::string smooth =
        " with smooth surroundings in both images; the bound of each is the reference's change within two "
        "pixels, 8-bit texel filtering, G-buffer quantization and 1e-4";
    EXPECT_EQ(footprintTolerance(f).because, "1 pixel" + smooth);
    EXPECT_EQ(footprintTolerance(f).max, 0.25);
    EXPECT_TRUE(footprintTolerance(f).max_pixels);
    f.smooth = 3, f.glass = 1, f.detailed = 4, f.edges = 5, f.flip = 0.12345;
    EXPECT_EQ(footprintTolerance(f).because,
              "3 pixels" + smooth + "; 1 pixel may have " + std::string(throughGlassBecause) +
                  "; the other 4 may have a mean FLIP of 0.3 and have 0.123; 5 at edges have no limit");
    EXPECT_EQ(f.pixels(), 12u);
    EXPECT_EQ(f.closeFraction(), 0.25);
    EXPECT_EQ(Footprints().closeFraction(), 1);
}

// Components of 2 t - 1: three of a normal; two of a line, in the plane of a normal with three.
TEST(Footprint, TexelsOfADirectionTurnIt) {
    CompareOptions options;
    options.texels = exactTexels();
    options.texels->linear_filter.rounding = 1.0 / 255;
    for (const auto& [mode, radians] :
         {std::pair{Channel::normals, 2 * std::sqrt(3.0) * 2 / 255},
          {Channel::anisotropy_direction, 2 * (std::sqrt(2.0) + std::sqrt(3.0)) * 2 / 255}})
        for (const double fraction : {0.97, 1.03}) {
            std::vector<Frame> frames = evenFrames();
            const double angle = std::atan2(0.6, 0.8) + fraction * radians;
            Image& turned = channelIn(frames[1], mode);
            for (std::size_t i = 0; i < turned.pixels(); ++i) {
                turned.pixel(i)[0] = static_cast<float>(std::sin(angle));
                turned.pixel(i)[2] = static_cast<float>(std::cos(angle));
            }
            EXPECT_EQ(evaluated(frames, mode, options).verdict, fraction < 1 ? Verdict::pass : Verdict::fail)
                << debugMode(mode).name << fraction;
            EXPECT_EQ(evaluated(frames, mode).verdict, Verdict::fail) << "without texels";
        }
}

// Light is granted what decoded surfaces change, where a path without a G-buffer shows it.
TEST(Footprint, LightIsGrantedItsEncoding) {
    for (const float lit : {0.5f, 0.6f, 0.7f}) {
        std::vector<Frame> frames = evenFrames();
        frames[1].settings.path = Path::deferred;
        frames[1].settings.gbuffer = GBufferEncoding::standard;
        frames[0].through_gbuffer[Channel::lit] = Image(side, side, 3, 0.6f);
        std::ranges::fill(channelIn(frames[1], Channel::lit).data, lit);
        EXPECT_EQ(evaluated(frames, Channel::lit).verdict, lit < 0.65f ? Verdict::pass : Verdict::fail)
            << lit;
    }
}

// Without materials on one side, no pixel is at an edge.
TEST(Footprint, WithoutMaterialsEveryPixelIsInside) {
    std::vector<Frame> frames = evenFrames();
    for (int y = 0; y < side; ++y) channelIn(frames[0], Channel::material_id).at(7, y) = 4;
    EXPECT_EQ(evaluated(frames, Channel::depth).footprints->edges, std::uint64_t{3 * side});
    frames[1].channels.erase(Channel::material_id);
    EXPECT_EQ(evaluated(frames, Channel::depth).footprints->edges, 0u);
}

TEST(Footprint, OtherComparisonsHaveNone) {
    std::vector<Frame> frames = evenFrames();
    frames[0].settings.reference_mode = ReferenceMode::surface;
    EXPECT_FALSE(evaluated(frames, Channel::roughness).footprints.has_value());
}

}  // namespace
}  // namespace diptych
