// SPDX-License-Identifier: MIT
// Which lights have a cause's share, where the cause is direct light or shadows.
#pragma once

#include "compare/explain/channel_lighting.h"
#include "compare/explain/explained_sides.h"
#include "compare/explain/explanation.h"
#include "compare/explain/swaps.h"
#include "shared/image/image.h"
#include "shared/scene/model/scene.h"

#include <cstddef>
#include <string_view>
#include <vector>

namespace diptych {

// Lights are drawn alone on the test's surfaces. What it is made of must outlive it.
class LightShares {
public:
    LightShares(const ExplainedSides& sides, ChannelLighting& lighting, const Swaps& swaps)
        : sides_(sides), lighting_(lighting), swaps_(swaps) {}

    // Each light's part of a cause's share, in no order; none where the cause is not of direct light. `map`:
    // as Cause::map, a value a pixel.
    std::vector<LightShare> of(const Swap& cause, const std::vector<double>& map);

    // The most lights that were drawn alone for a cause, and that were not, as too many.
    std::size_t drawn() const { return drawn_; }
    std::size_t leftOut() const { return left_out_; }

private:
    std::vector<std::size_t> drawnLights(const std::vector<Light>& lights, std::string_view of,
                                         std::size_t pixels);
    std::vector<Image> lightsAlone(const Settings& settings, const std::vector<std::size_t>& places,
                                   const LightingStages::Stage* stage);

    const ExplainedSides& sides_;
    ChannelLighting& lighting_;
    const Swaps& swaps_;
    std::size_t drawn_ = 0, left_out_ = 0;
};

}  // namespace diptych
