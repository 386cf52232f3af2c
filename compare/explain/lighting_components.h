// SPDX-License-Identifier: MIT
// Attributes the relighting residual to lighting components, for two Frames that have the terms of lit as
// channels, as files of external renderers may.
#pragma once

#include "compare/render/channel_shading.h"
#include "shared/frame/frame.h"
#include "shared/image/image.h"

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace diptych {

// How a light may have changed. factor: its intensity is scaled; whole: it exists in one image only;
// visibility: what hides it changes, at each pixel independently.
enum class LightChange { factor, whole, visibility };

// Channels that both Frames must have: lit_diffuse, lit_specular, lit_ambient, lit_haze and transmittance.
std::vector<Channel> termChannels();
// Direct light of both lobes, W x H x 3.
Image sumOfLobes(const LightChannels& of);
// The sum of a Frame's terms at surfaces, W x H x 3; 0 elsewhere.
Image sumOfTerms(const Frame& frame);
// The same for our terms, with the surfaces' emission.
Image sumOfTerms(const ChannelTerms& terms, const Image& emission);

// Our lighting of surfaces: lit; its terms before blending; emission; and, if components are searched for,
// lit without blended surfaces.
struct LitSurfaces {
    Image lit;
    ChannelTerms terms;
    const Image* emission = nullptr;
    Image unblended;
};

// An image for each term of lit, and one for lit itself.
using TermImages = std::array<Image, 6>;

// The components in which two Frames differ beyond their channels and Settings. Taking a component from
// the baseline changes its terms to the baseline's.
class LightingComponents {
public:
    // `lit`: the test's, without exposure. `own`: each side's channels relit under its own Settings,
    // baseline and test.
    LightingComponents(const Frame& baseline, const Frame& test, const Image& lit,
                       const std::array<LitSurfaces, 2>& own);

    struct Component {
        std::string name, description;  // "direct diffuse"
        // Change of each term, and of lit, when taken from the baseline: W x H x 3; empty: none.
        TermImages adds;
        std::optional<LightChange> lights{};  // for direct light: how lights may have changed
    };
    // Change of direct light by a component; and the part of direct light in the component's lobes, W x H
    // x 3.
    static LightChannels change(const Component& component);
    static Image directLight(const Component& component, const LightChannels& of);
    const std::vector<Component>& components() const { return components_; }

    // lit of the surfaces plus the test's residual, with some components from the baseline. `taken`: one
    // entry per component.
    Image lit(const LitSurfaces& surfaces, const std::vector<bool>& taken) const;

private:
    void add(Component component);  // unless it changes nothing

    TermImages residual_;  // of the test
    std::vector<Component> components_;
};

}  // namespace diptych
