// SPDX-License-Identifier: MIT
// The result of one renderer, or an image file. Anything that makes a Frame can be compared.
#pragma once

#include "shared/frame/channel.h"
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

// Time of the whole frame, from culling to linear lit, in milliseconds.
struct FrameTime {
    double median = 0, min = 0, max = 0;
    int runs = 0;
    // Host time of each frame that `median` excludes, ms: recording commands (median), and choosing the
    // lights of every object (--assign per_object; once, when the frame was prepared).
    double record = 0, object_lists = 0;
};

struct PassTime {
    std::string name;
    double ms = 0;  // from a separate, profiled run
};

struct FrameBytes {
    std::uint64_t images = 0, buffers = 0;  // device memory of the path and the scene
    std::uint64_t gbuffer_per_pixel = 0;    // deferred: attachments and depth; forward+: depth; all samples
    std::uint64_t full_size_images = 0;     // part of `images`: full-size images, including light
};

// Pages of --shadows clipmap: requested = resident + fallback.
struct ShadowPages {
    std::uint64_t requested = 0;  // by the image
    std::uint64_t resident = 0;   // of `requested`: in the pool
    std::uint64_t fallback = 0;   // of `requested`: served by a coarser level
    std::uint64_t drawn = 0;      // before the first frame; the others were already there
};

// Blended fragments that --transparency list did not sort, and pixels with such fragments.
struct UnsortedFragments {
    std::uint64_t fragments = 0, pixels = 0;
};

struct FrameCounters {
    std::uint64_t nonfinite_pixels = 0;  // in lit
    std::uint64_t overflowed_lists = 0;
    std::uint64_t lights = 0;  // all lights, including directional ones
    ShadowPages shadow_pages;
    UnsortedFragments unsorted;
    // Pixels where lit of the capture differs from that of the timed pipeline.
    std::uint64_t unreproduced_pixels = 0;
    double energy_cut =
        0;  // fraction of the flux of lights without a range that settings.light_cutoff removes
};

// Differences between two runs of the same path. On a CPU device any difference is a race.
struct ChannelNoise {
    std::uint64_t pixels = 0;  // not bitwise identical
    double max = 0;            // in the channel's error kind, over all pixels including the background
};

// Origin of a Frame that was read from a file; unknown fields are empty.
struct FrameOrigin {
    std::string file;  // empty: rendered by this run
    std::string device, driver, commit;
    std::vector<std::string> omitted_channels = {};  // the file's channels that Diptych does not have
    std::vector<std::string> not_applied = {};  // what the file says of its colours or pixels (FileNotes)
    // Rendered now by an external renderer. `file` names it; `corrections` describes those of its input.
    bool external = false;
    std::vector<std::string> corrections = {};
};

// The device that rendered a Frame, as reports name it.
struct ReportDevice {
    std::string name, driver, type;
    // Whether all pipelines round alike (DeviceProfile::bit_exact, for a device that may be on another
    // machine).
    bool bitExact() const { return type == "cpu"; }
};

// The camera of the image, in world space, metres; for the report and for other renderers.
struct FrameCamera {
    std::string name;
    double eye[3] = {0, 0, 0}, target[3] = {0, 0, -1}, up[3] = {0, 1, 0};
    double fov_degrees = 0;    // vertical; 0: orthographic
    double ymag = 0;           // orthographic: half the height, m
    double near = 0, far = 0;  // far: infinity for a camera without far plane
    std::string choice{};      // default view only: the chosen view and how much it shows; else empty
};

// Filter radius: within it of a shadow boundary, perpendicular to the light, a path's filter may show
// partial shadow. From the filter's centre to a corner plus one texel, m; valid up to a view depth, m.
struct ShadowFilterRadius {
    double depth = 0, radius = 0;
    double texel = 0;  // m
};

struct Frame {
    std::string name;   // "deferred"
    std::string scene;  // as the user gave it
    FrameOrigin origin;
    Settings settings;
    FrameCamera camera;
    std::map<Channel, Image> channels;  // background pixels are 0, material_id -1
    // By channel, the indices of pixels (row-major from the top left) that were NaN or infinite and have
    // been repaired: NaN is 0, infinity the largest float32. Images mark them.
    std::map<Channel, std::vector<std::uint32_t>> repaired;
    // Requested channels, which are compared and written; other `channels` are helpers (exposure,
    // background). Empty: all.
    std::vector<Channel> requested;
    bool isRequested(Channel channel) const {
        return requested.empty() || std::ranges::count(requested, channel) > 0;
    }
    // litModes shaded from the surfaces that deferred decodes from a G-buffer of settings.gbuffer: by
    // forward+, which must equal deferred, and by the reference in mode surface. Else empty.
    std::map<Channel, Image> through_gbuffer;
    // With MSAA, if RenderOptions::every_sample asks for it: the samples of a channel after the first.
    std::map<Channel, std::vector<Image>> further_samples;
    // If something may be blended in the view: lit before blending, W x H x 3; for forward+ also of
    // through_gbuffer. Else empty.
    Image unblended, unblended_through_gbuffer;
    std::array<float, 3> background{};      // colour of background pixels in images, W/(sr m^2)
    std::map<Channel, ChannelNoise> noise;  // of the channels rendered twice
    // Buffers in which a second run of the compute shaders left other bytes.
    std::vector<std::string> changed_buffers;
    // Reference with sampling: half the 95 % confidence interval of lit, W x H x 1, W/(sr m^2); and
    // relative to lit (as lit's error kind), at 99.9 % of the covered pixels.
    Image uncertainty;
    double relative_uncertainty = 0;
    // Reference with punctual lights: what float32 may err by more than 1e-4 of the light, in lit_diffuse,
    // lit_specular, lit_clearcoat and lit_sheen, W x H x 4, W/(sr m^2). Empty if 0 everywhere.
    Image rounding;
    // Reference with a shadow-casting directional light, W x H x 3. First, the pixel's distance from the
    // shadow boundary, perpendicular to the light, m; 0 in the penumbra. Second, reflected light without
    // the shadow, largest component, W/(sr m^2). Third, incident light without it, luminance, W/m^2.
    Image shadow_edge;
    // Reference with shadow-casting point or spot lights, W x H x 2. First, the pixel's distance from the
    // nearest shadow boundary, perpendicular to the rays, relative to the distance from the light. Second,
    // reflected light without shadows, largest component, W/(sr m^2).
    Image local_shadow_edge;
    // Reference with blended surfaces or glass, W x H x 3: the fraction of each pixel's background that they
    // hide; and, of rough or refracting glass, the largest component of the fraction of light that passes,
    // and of the light that passes, W/(sr m^2).
    Image blended;
    // Reference with an environment, if requested, W x H x 9, W/(sr m^2), largest components. Errors of
    // approximations: in lit_diffuse, by IblDiffuse; in lit_specular with --ibl split, by IblDiffuse; with
    // --ibl sampled, what maps cannot represent. Then, for both, the difference of a lobe with twice the
    // solid angle; and the light that the specular lobe reflects.
    Image environment_costs;
    // Reference, if requested: environment and ambient light in lit that geometry would occlude.
    struct HiddenLight {
        double mean = 0;    // fraction of all of it, over pixels that show a surface
        double p99 = 0;     // 99th percentile of the fractions by pixel
        double pixels = 0;  // fraction of pixels that would lose more than a tenth
    };
    std::optional<HiddenLight> hidden_light;
    // Path with shadow-casting point or spot lights: its filter radius in the unit of local_shadow_edge;
    // else 0.
    double local_shadow_filter_radius = 0;
    // Path that filters shadow maps: by ascending view depth; else empty.
    std::vector<ShadowFilterRadius> shadow_filter_radii;
    // --shadows clipmap: by resident level (cascade + page_residency), at all depths.
    std::vector<ShadowFilterRadius> shadow_level_filter_radii;
    FrameTime time;
    std::vector<PassTime> passes;
    double made_in_ms = 0;  // wall clock of rendering, timing, capturing and reading back this Frame
    FrameBytes bytes;
    FrameCounters counters;
    std::vector<std::string> notes;  // what users must know: deviations from the request
};

// nullptr: no image of the channel.
inline const Image* findChannel(const std::map<Channel, Image>& images, Channel channel) {
    const auto found = images.find(channel);
    return found == images.end() ? nullptr : &found->second;
}
inline const Image* findChannel(const Frame& frame, Channel channel) {
    return findChannel(frame.channels, channel);
}

// letGo() for all images of one channel, or of every channel.
void letGo(const Frame& frame, Channel channel);
void letGo(const Frame& frame);

// Whether it is a Frame of this program's reference, rendered now or read from a file that this program
// wrote. Files of other renderers are not.
bool isReferenceFrame(const Frame& frame);

// Note that tells users the relative_uncertainty of such a Frame.
std::string uncertaintyNote(double relative);

}  // namespace diptych
