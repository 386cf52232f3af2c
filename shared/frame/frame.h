// SPDX-License-Identifier: MIT
// Whatever makes a Frame can be compared.
#pragma once

#include "shared/frame/settings.h"
#include "shared/image/image.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace diptych {

// The whole frame, unsplit, from culling to linear lit; milliseconds.
struct FrameTime {
    double median = 0, min = 0, max = 0;
    int runs = 0;
};

struct PassTime {
    std::string name;
    double ms = 0;  // from a separate, profiled run
};

struct FrameBytes {
    std::uint64_t images = 0, buffers = 0;  // device memory of the path and the scene
    std::uint64_t gbuffer_per_pixel = 0;    // deferred: attachments and depth; forward+: depth
};

struct FrameCounters {
    std::uint64_t nonfinite_pixels = 0;  // in lit
    std::uint64_t overflowed_lists = 0;
    std::uint64_t lights = 0;               // every light, the sun too
    std::uint64_t unreproduced_pixels = 0;  // where the capture's lit is not the timed pipeline's
    double energy_cut =
        0;  // share of the flux of lights without a range that settings.light_cutoff takes away
};

// What two runs of one path differ by: nothing on a CPU device, or it is a race.
struct ChannelNoise {
    std::uint64_t pixels = 0;  // not the same, bit for bit
    double max = 0;            // in the channel's metric, the background counted
};

// Where a Frame comes from that was not drawn now; what is not known is empty.
struct FrameOrigin {
    std::string file;  // empty: drawn now
    std::string device, driver, commit;
};

// What a Frame was drawn on, as a report names it.
struct ReportDevice {
    std::string name, driver, type;  // type "cpu" rounds alike in every pipeline
};

// Where the picture was taken from, world, metres; for the report and for another renderer.
struct FrameCamera {
    std::string name;
    double eye[3] = {0, 0, 0}, target[3] = {0, 0, -1}, up[3] = {0, 1, 0};
    double fov_degrees = 0;    // vertical; 0: orthographic
    double ymag = 0;           // orthographic: half the height, m
    double near = 0, far = 0;  // far: infinity where there is none
};

struct Frame {
    std::string name;   // "deferred"
    std::string scene;  // as the user wrote it
    FrameOrigin origin;
    Settings settings;
    FrameCamera camera;
    std::map<int, Image> channels;  // by debug mode number; background pixels are 0, material_id -1
    // What of it was asked for and is compared and written; the rest helps (exposure, background). Empty:
    // all.
    std::vector<int> asked;
    bool isAsked(int mode) const { return asked.empty() || std::ranges::count(asked, mode) > 0; }
    // Forward+: lit, lit_diffuse, lit_specular and lit_ambient of a surface that went through the encoding of
    // settings.gbuffer and back: what the deferred path must show. It explains a difference of lit.
    std::map<int, Image> through_gbuffer;
    std::array<float, 3> background{};  // what pictures show there, W/(sr m^2)
    std::map<int, ChannelNoise> noise;  // of every channel, where the frame was drawn twice
    // The reference's, where something was sampled: half the 95 % confidence interval of lit, W x H x 1,
    // W/(sr m^2); and relative to lit as its metric is, at 99.9 % of the covered pixels.
    Image uncertainty;
    double relative_uncertainty = 0;
    FrameTime time;
    std::vector<PassTime> passes;
    double made_in_ms = 0;  // wall clock of all drawing, timing, capturing and reading back for this Frame
    FrameBytes bytes;
    FrameCounters counters;
    std::vector<std::string> notes;  // what a reader must know: what was drawn otherwise than asked
};

// A Frame of our reference: drawn now, or read from a file that we wrote. Another renderer's file is none.
bool isReferenceFrame(const Frame& frame);

// What readers of such a Frame must know of its relative_uncertainty, as a note of the Frame.
std::string uncertaintyNote(double relative);

}  // namespace diptych
