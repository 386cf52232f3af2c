// SPDX-License-Identifier: MIT
// What single lights send to a pixel, as a path draws them.
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

// One view by one path, whose lights shine or are black. Only what the lights send changes: light lists,
// grids, shadow maps and pipelines are those of the whole picture, and so are the bits of what each light
// adds. What it was made of must outlive it.
class LightTerms {
public:
    // Of one of the two paths. Without `environment` the environment is dark.
    LightTerms(Device& device, SharedResources& shared, const SceneView& view, const Settings& settings,
               bool environment);
    LightTerms(LightTerms&&) noexcept;
    ~LightTerms();

    // lit_diffuse + lit_specular at a pixel, W/(sr m^2) before any haze, where these lights shine alone:
    // places in SceneView::lights, in any order. With several samples a pixel it is that of the first.
    std::array<double, 3> at(std::span<const std::size_t> shining, int x, int y);

    // The lights that the pixel evaluates, as places in SceneView::lights, in ascending order; `depth`: its
    // view depth, m. Nothing where each object has a list of its own.
    std::optional<std::vector<std::size_t>> listAt(int x, int y, float depth) const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace diptych
