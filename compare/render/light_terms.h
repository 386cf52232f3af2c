// SPDX-License-Identifier: MIT
// Contributions of single lights to a pixel, as a path renders them.
#pragma once

#include "shared/frame/settings.h"
#include "shared/scene/scene_view.h"

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace diptych {

class Device;
struct SharedResources;

// One view by one path, with lights switched on or black. Only the lights' intensity changes: light lists,
// grids, shadow maps and pipelines are those of the full image, so each contribution is bitwise the same.
// The constructor's arguments must outlive it.
class LightTerms {
public:
    // For deferred or forward+. Without `environment` the environment is black.
    LightTerms(Device& device, SharedResources& shared, const SceneView& view, const Settings& settings,
               bool environment);
    LightTerms(LightTerms&&) noexcept;
    ~LightTerms();

    // lit_diffuse + lit_specular at a pixel, W/(sr m^2), before haze, with only these lights: indices in
    // SceneView::lights, in any order. Under MSAA, of the first sample.
    std::array<double, 3> at(std::span<const std::size_t> shining, int x, int y);

    // Lights that the pixel evaluates, as ascending indices in SceneView::lights. `depth`: view depth of
    // the pixel, m. Empty if each object has its own list.
    std::optional<std::vector<std::size_t>> listAt(int x, int y, float depth) const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace diptych
