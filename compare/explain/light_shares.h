// SPDX-License-Identifier: MIT
// Attributes a cause's share to lights, if the cause is direct light or shadows.
#pragma once

#include "compare/explain/ablation.h"
#include "compare/explain/channel_lighting.h"
#include "compare/explain/explained_sides.h"
#include "compare/explain/explanation.h"
#include "shared/image/image.h"
#include "shared/scene/model/scene.h"

#include <cstddef>
#include <string_view>
#include <vector>

namespace diptych {

// Renders lights alone on the test's surfaces. The constructor arguments must outlive it.
class LightShares {
public:
    LightShares(const ExplainedSides& sides, ChannelLighting& lighting, const Ablation& ablation)
        : sides_(sides), lighting_(lighting), ablation_(ablation) {}

    // Each light's part of a cause's share, unordered; empty if the cause is not direct light. `map`: as
    // Cause::map, one value per pixel.
    std::vector<LightShare> of(const AblationCause& cause, const std::vector<double>& map);

    // The largest numbers of lights rendered alone for a cause, and of those omitted as too many.
    std::size_t drawn() const { return drawn_; }
    std::size_t leftOut() const { return left_out_; }

private:
    std::vector<std::size_t> drawnLights(const std::vector<Light>& lights, std::string_view of,
                                         std::size_t pixels);
    std::vector<Image> lightsAlone(const Settings& settings, const std::vector<std::size_t>& places,
                                   const LightingComponents::Component* component);

    const ExplainedSides& sides_;
    ChannelLighting& lighting_;
    const Ablation& ablation_;
    std::size_t drawn_ = 0, left_out_ = 0;
};

}  // namespace diptych
