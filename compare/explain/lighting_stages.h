// SPDX-License-Identifier: MIT
// Of what the lighting of a Frame's own channels leaves of its lit, which stage of lighting it lies in: for
// two Frames that have the terms of lit as channels, as another renderer's files may.
#pragma once

#include "compare/explain/by_light.h"
#include "compare/render/channel_shading.h"
#include "shared/frame/frame.h"
#include "shared/image/image.h"

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace diptych {

// Channels that both must have: lit_diffuse, lit_specular, lit_ambient, lit_haze and transmittance.
std::vector<int> termChannels();
bool haveTerms(const Frame& baseline, const Frame& test);
// Direct light of both lobes, W x H x 3.
Image sumOfLobes(const LightChannels& of);
// What a Frame that has them adds up to where it shows a surface, W x H x 3; 0 elsewhere.
Image sumOfTerms(const Frame& frame);
// The same of our terms of surfaces that emit so much.
Image sumOfTerms(const ChannelTerms& terms, const Image& emission);

// What our lighting makes of surfaces: lit; its terms before anything is blended; what they emit; and, where
// it is asked which stages there are, lit without what is blended.
struct LitSurfaces {
    Image lit;
    ChannelTerms terms;
    const Image* emission = nullptr;
    Image unblended;
};

// The stages whose results two Frames differ in beyond what their channels and Settings say. A stage that is
// taken from the baseline moves the terms that it is of to the baseline's.
class LightingStages {
public:
    // `lit`: the test's, without what is a factor on all of it. `own`: of each side's own channels under its
    // own Settings: baseline, test.
    LightingStages(const Frame& baseline, const Frame& test, const Image& lit,
                   const std::array<LitSurfaces, 2>& own);

    struct Stage {
        std::string name, shows;  // "direct diffuse"
        // What it adds to each term, and to lit, when it is the baseline's: W x H x 3; empty: nothing.
        std::array<Image, 6> adds;
        std::optional<LightChange> lights{};  // of direct light: what may have become of lights
    };
    // What a stage adds to direct light; and of some direct light the lobes that the stage is of, W x H x 3.
    static LightChannels change(const Stage& stage);
    static Image directLight(const Stage& stage, const LightChannels& of);
    const std::vector<Stage>& stages() const { return stages_; }

    // lit of surfaces as the test has it beyond our lighting, but for the stages of the baseline. `taken`:
    // one entry per stage.
    Image lit(const LitSurfaces& surfaces, const std::vector<bool>& taken) const;

private:
    std::array<Image, 6> rest_;  // of the test: of each term, and of lit
    std::vector<Stage> stages_;
};

}  // namespace diptych
