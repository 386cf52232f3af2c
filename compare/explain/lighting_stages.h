// SPDX-License-Identifier: MIT
// Of what the lighting of a Frame's own channels leaves of its lit, which stage of lighting it lies in: for
// two Frames that have the terms of lit as channels, as another renderer's files may.
#pragma once

#include "compare/render/channel_shading.h"
#include "shared/frame/frame.h"
#include "shared/image/image.h"

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace diptych {

// Channels that both must have: lit_diffuse, lit_specular, lit_ambient, lit_haze and transmittance.
std::vector<int> termChannels();
bool haveTerms(const Frame& baseline, const Frame& test);

// What our lighting makes of surfaces: lit; its terms before anything is blended; and what they emit.
struct LitSurfaces {
    Image lit;
    ChannelTerms terms;
    const Image* emission = nullptr;
};

// The stages whose results two Frames differ in beyond what their channels and Settings say. A stage that is
// taken from the baseline moves the terms that it is of to the baseline's.
class LightingStages {
public:
    // `own`: of each side's own channels under its own Settings: baseline, test.
    LightingStages(const Frame& baseline, const Frame& test, const std::array<LitSurfaces, 2>& own);

    struct Stage {
        std::string name, shows;  // "direct diffuse"
        // What it adds to each term, and to lit, when it is the baseline's: W x H x 3; empty: nothing.
        std::array<Image, 6> adds;
    };
    const std::vector<Stage>& stages() const { return stages_; }

    // lit of surfaces as the test has it beyond our lighting, but for the stages of the baseline. `taken`:
    // one entry per stage.
    Image lit(const LitSurfaces& surfaces, const std::vector<bool>& taken) const;

private:
    std::array<Image, 6> rest_;  // of the test: of each term, and of lit
    std::vector<Stage> stages_;
};

}  // namespace diptych
