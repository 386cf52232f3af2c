// SPDX-License-Identifier: MIT
// The result of one renderer, or of a picture file: anything that makes a Frame can be compared.
#pragma once

#include "shared/frame/settings.h"
#include "shared/image/image.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace diptych {

// Time of the whole frame in one piece, from culling to linear lit, in milliseconds.
struct FrameTime {
    double median = 0, min = 0, max = 0;
    int runs = 0;
    // What the host does for each frame and `median` does not hold, ms: recording its commands (the median),
    // and choosing the lights of every object (--assign per_object; once, when the frame was prepared).
    double record = 0, object_lists = 0;
};

struct PassTime {
    std::string name;
    double ms = 0;  // from a separate, profiled run
};

struct FrameBytes {
    std::uint64_t images = 0, buffers = 0;  // device memory of the path and the scene
    std::uint64_t gbuffer_per_pixel = 0;    // deferred: attachments and depth; forward+: depth; all samples
    std::uint64_t picture_images = 0;       // of `images`: those of the picture's size, light's too
};

// Pages of --shadows clipmap: requested = resident + fallback.
struct ShadowPages {
    std::uint64_t requested = 0;  // by the picture
    std::uint64_t resident = 0;   // of these, in the pool
    std::uint64_t fallback = 0;   // of these, served by a coarser level
    std::uint64_t drawn = 0;      // before the first frame; the others were there already
};

// Fragments of blended surfaces that --transparency list put in no order, and the pixels that have some.
struct UnsortedFragments {
    std::uint64_t fragments = 0, pixels = 0;
};

struct FrameCounters {
    std::uint64_t nonfinite_pixels = 0;  // in lit
    std::uint64_t overflowed_lists = 0;
    std::uint64_t lights = 0;  // every light, the sun too
    ShadowPages shadow_pages;
    UnsortedFragments unsorted;
    // Where the lit of the capture differs from that of the timed pipeline.
    std::uint64_t unreproduced_pixels = 0;
    double energy_cut =
        0;  // share of the flux of lights without a range that settings.light_cutoff takes away
};

// Differences between two runs of the same path. On a CPU device there must be none; any is a race.
struct ChannelNoise {
    std::uint64_t pixels = 0;  // not bit-identical
    double max = 0;            // in the channel's metric, over all pixels, the background too
};

// Origin of a Frame that was read from a file; unknown fields are empty.
struct FrameOrigin {
    std::string file;  // empty: drawn by this program run
    std::string device, driver, commit;
    std::vector<std::string> left_out = {};     // the file's channels that are none of ours
    std::vector<std::string> not_applied = {};  // what the file says of its colours or pixels, FileNotes
    // Drawn now, by a program that is not ours: `file` is the one that names it, and what it is granted
    // stands here, in words.
    bool external = false;
    std::vector<std::string> granted = {};
};

// The device that a Frame was drawn on, as reports name it.
struct ReportDevice {
    std::string name, driver, type;
    // All pipelines round alike there (DeviceProfile::bit_exact, of a device that may be elsewhere).
    bool bitExact() const { return type == "cpu"; }
};

// The camera of the picture, in world space, metres; for the report and for other renderers.
struct FrameCamera {
    std::string name;
    double eye[3] = {0, 0, 0}, target[3] = {0, 0, -1}, up[3] = {0, 1, 0};
    double fov_degrees = 0;    // vertical; 0: orthographic
    double ymag = 0;           // orthographic: half the height, m
    double near = 0, far = 0;  // far: infinity for a camera without far plane
    std::string choice{};  // of a default view: what was chosen and how much it shows, in words; else empty
};

// How far from the edge of a shadow, across the light, a path's filter may show anything between light and
// shadow: from its middle to a corner and one texel, m, up to a view depth, m.
struct ShadowReach {
    double depth = 0, reach = 0;
    double texel = 0;  // m
};

struct Frame {
    std::string name;   // "deferred"
    std::string scene;  // as the user wrote it
    FrameOrigin origin;
    Settings settings;
    FrameCamera camera;
    std::map<int, Image> channels;  // by debug mode number; background pixels are 0, material_id -1
    // By channel, the pixels (row by row from the top left) that were NaN or infinite when they were drawn
    // and have been repaired since: NaN is 0, infinity the largest float32. Pictures mark them.
    std::map<int, std::vector<std::uint32_t>> repaired;
    // Of `channels`, those that were requested, which are compared and written; the others are helpers
    // (exposure, background). Empty: all.
    std::vector<int> requested;
    bool isRequested(int mode) const { return requested.empty() || std::ranges::count(requested, mode) > 0; }
    // litModes shaded from the surfaces that deferred decodes from a G-buffer of settings.gbuffer: by
    // forward+, which has to equal deferred, and by the reference in mode surface. Empty elsewhere.
    std::map<int, Image> through_gbuffer;
    // With MSAA, where RenderOptions::every_sample asks for it: the samples of a channel after the first.
    std::map<int, std::vector<Image>> further_samples;
    // Of a path or the reference in whose view something may be blended: lit before that, W x H x 3; and
    // forward+ only, the same of through_gbuffer. Else empty.
    Image unblended, unblended_through_gbuffer;
    std::array<float, 3> background{};  // colour of background pixels in pictures, W/(sr m^2)
    std::map<int, ChannelNoise> noise;  // of the channels that were drawn twice
    // Names of the buffers in which compute kernels left other bytes when the frame was drawn again.
    std::vector<std::string> changed_buffers;
    // Of the reference, if something was sampled: half the 95 % confidence interval of lit, W x H x 1, W/(sr
    // m^2); and the same relative to lit (as lit's metric is), at 99.9 % of the covered pixels.
    Image uncertainty;
    double relative_uncertainty = 0;
    // Of the reference where a sun casts, W x H x 3: the distance of each pixel from the edge of its shadow,
    // across the light, m, 0 where a part of its disc is seen; what the surface would reflect of the sun
    // unshadowed, the largest component, W/(sr m^2); and what would arrive, the luminance, W/m^2.
    Image shadow_edge;
    // Of the reference where points or spots cast, W x H x 2: the distance of each pixel from the nearest
    // edge of their shadows, across their rays, a share of the distance from the light; and what the surface
    // would reflect of them unshadowed, the largest component, W/(sr m^2).
    Image local_shadow_edge;
    // Of the reference where surfaces are blended, W x H x 1: the share of each pixel that they hide of what
    // lies behind them.
    Image blended;
    // Of a reference that was asked for it, where an environment shines, W x H x 9, W/(sr m^2), the largest
    // components: what approximations of it are off by in lit_diffuse, by IblDiffuse; likewise in
    // lit_specular with --ibl split; with --ibl sampled what maps cannot hold; with either how far a lobe of
    // twice the solid angle is from the surface's; and what the specular lobe sends.
    Image environment_costs;
    // Likewise: the light of the environment and of ambient light that geometry would hide, which lit has.
    struct HiddenLight {
        double mean = 0;    // a share of all of it, over the pixels that show a surface
        double p99 = 0;     // the 99th percentile of the pixels' own shares
        double pixels = 0;  // the share of the pixels that would lose more than a tenth
    };
    std::optional<HiddenLight> hidden_light;
    // Of a path whose points or spots cast: how far its filter reaches, in the same measure; else 0.
    double local_shadow_reach = 0;
    // Of a path that filters shadow maps, by view depth in ascending order; empty where it has none.
    std::vector<ShadowReach> shadow_reach;
    // The same of --shadows clipmap by the level that serves, cascade + page_residency, at all depths.
    std::vector<ShadowReach> shadow_level_reach;
    FrameTime time;
    std::vector<PassTime> passes;
    double made_in_ms = 0;  // wall clock of all drawing, timing, capturing and reading back for this Frame
    FrameBytes bytes;
    FrameCounters counters;
    std::vector<std::string> notes;  // what users must know: what was drawn otherwise than requested
};

// letGo() of all pictures of one channel, and of every channel.
void letGo(const Frame& frame, int mode);
void letGo(const Frame& frame);

// Whether it is a Frame of this program's reference: drawn now, or read from a file that this program wrote.
// A file of another renderer is not.
bool isReferenceFrame(const Frame& frame);

// The note of such a Frame that tells its relative_uncertainty to users.
std::string uncertaintyNote(double relative);

}  // namespace diptych
