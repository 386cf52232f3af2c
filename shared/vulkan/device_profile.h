// SPDX-License-Identifier: MIT
// What is chosen by the device instead of by the scene or the Settings. Nothing else asks what kind of device
// it is.
#pragma once

#include "shared/vulkan/device_info.h"

#include <cstdint>

namespace diptych {

// Nanoseconds of work on the whole device: for choices between ways to draw the same picture, where only
// their ratios matter, and for how long a draw takes, about, before it is divided (Pass::takes).
struct DeviceCosts {
    double draw = 0;      // of the same state as the one before
    double triangle = 0;  // of a depth pass
    double depth = 0;     // a fragment of a depth pass
    double surface = 0;   // making the surface of a shaded fragment
    double texture = 0;   // each texture of it
    double light = 0;     // each light at it
    // Of light lists, for the size of their cells.
    double list = 0;       // to clear, count and place one
    double listed = 0;     // to mark and write one of its lights
    double evaluated = 0;  // to evaluate one of its lights at a pixel
};

// Which device's choices a profile has. What is true of the device stays: whether it is software, agrees bit
// for bit, or has time stamps.
enum class ProfileChoices {
    of_device,
    gpu,  // a GPU's, on any device, so that tests may draw with them where there is none
    // The device's own, but for DeviceProfile::culls_by_compute: so that it alone may be measured and tested.
    culling_by_compute,
    flattening_branches,  // the same for DeviceProfile::flattens_branches
};

struct DeviceProfile {
    // A CPU draws: what a frame takes is this machine's CPU time.
    bool software = false;
    // Two pipelines that compute the same from the same bits agree bit for bit; elsewhere within some ULP.
    bool bit_exact = false;
    // Time stamps around passes are true. On lavapipe they are not: work runs later than they say.
    bool time_stamps = false;
    // A shader's load of a uniform is gathered for every lane anew, so that fragment shaders read the view
    // from texels.
    bool gathers_uniforms = false;
    // So many threads run at once that light lists are made by many for each tile (gather); otherwise by few
    // for each light, which test less (scatter).
    bool wide_groups = false;
    // The driver's compiler takes twice as long for every branch inside a loop: pipelines are made of modules
    // whose branches are selections (flattened() of flatten.h).
    bool flattens_branches = false;
    // Light packets that one draw may walk at a pixel; longer lists are walked by several draws. Mesa
    // lavapipe ends all loops of one shader invocation, silently, after 65,535 iterations together, of which
    // some are left for other loops.
    std::uint32_t packets_per_draw = 1;
    // With a depth pre-pass, forward+ reads the depth that was stored, as deferred lighting does. Elsewhere
    // that of the fragment has the same bits, which Vulkan does not promise.
    bool fetches_depth = true;
    // A draw to images of several samples takes as long for fragments none of whose samples pass the depth
    // test: on lavapipe, which skips them where images have one.
    bool shades_failed_samples = false;
    // So many triangles of a pass are binned before the device rasterises them (DrawDivision); 0: the device
    // decides. Measured on lavapipe with two cores: of 85,000 triangles 10,000 to 20,000 save a tenth of a
    // frame; less than 5,000, and what is loaded and stored between costs as much.
    std::uint32_t bins_at_once = 0;
    // What of a view may show is chosen by a kernel, into indirect draws; otherwise by the host. Measured on
    // lavapipe, where the host is faster. Never where indirect draws cannot begin at any instance.
    bool culls_by_compute = false;
    // How long a device must have worked before its clocks are up and times mean something.
    double warm_up_ms = 0;
    // A submit that takes longer may be taken for a hang. Infinite: there is no such limit.
    double longest_submit_ms = 0;
    DeviceCosts costs;
};

// `timestampBits`: how many bits of a time stamp the queue writes.
DeviceProfile profileOf(const DeviceInfo& info, std::uint32_t timestampBits,
                        ProfileChoices choices = ProfileChoices::of_device);

}  // namespace diptych
