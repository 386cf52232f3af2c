// SPDX-License-Identifier: MIT
// Views of scenes, and the output of a renderer with a known fault: wrong surface channels, another scene,
// Settings or light, terms summed differently. Its Frame does not declare the fault: the Settings are
// those of the correct one.
#pragma once

#include "compare/explain/explain.h"
#include "compare/render/channel_shading.h"
#include "tests/image/scenes.h"

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace diptych::tests {

class InjectedView;

// Name of a view's first light; the others have none.
inline constexpr const char* firstLight = "the first";

// Kind of view that a fault needs: lights, haze and ambient light on opaque surfaces; or blended surfaces
// before an environment, in haze.
enum class ViewKind { opaque, blended };

struct InjectedFault {
    std::string means;               // "normals of 8 bits"
    std::vector<std::string> named;  // acceptable names of the first cause
    ViewKind kind = ViewKind::opaque;
    bool of_first_light = false;  // affects only the first of the scene's lights
    // Changes a pixel of one surface channel; ...
    std::string channel{};
    std::function<void(float*)> pixel{};
    // ... or the Settings and scene before rendering, ...
    std::function<void(Settings&, Scene&)> draw{};
    // ... or terms and lit after rendering.
    std::function<void(InjectedView&, Frame&)> after{};
};

// At least 50 faults.
const std::vector<InjectedFault>& injectedFaults();
const InjectedFault& injectedFault(std::string_view means);  // throws std::out_of_range

// One scene x camera x seed. The seed sets lights, materials, baked light and occlusion.
class InjectedView {
public:
    InjectedView(const std::string& scene, const std::string& camera, std::uint32_t seed, ViewKind kind);

    // The Frame of a renderer with these faults, including the terms of lit as channels.
    Frame with(std::span<const InjectedFault* const> faults);
    Frame with(const InjectedFault& fault);
    Explanation explained(const Frame& test);
    // Whether the fault changes lit by more than rounding in this view; cached.
    bool feels(const InjectedFault& fault);

    bool covered(std::size_t pixel) const;

    const std::string name;
    const ViewKind kind;
    Scene scene;
    SceneViews views;
    Renderer renderer;
    Settings settings;
    Frame right;

    // Relights the correct surfaces with other Settings and, optionally, one changed channel.
    Image litUnder(const Settings& other, const std::string& channel = {},
                   const std::function<void(float*)>& pixel = {});

private:
    void shadeInto(Frame& frame, const Settings& drawn);

    // Relighting of the correct image; channels are replaced.
    SurfaceImages images_;
    std::optional<ChannelShading> shading_;
    std::map<std::string, bool> felt_;
};

// Whether two images differ by more than rounding: by over 1e-5 of the first one's mean.
bool differsVisibly(const Image& a, const Image& b);

// View `index` for injecting faults of a kind, created on first use and cached; null after the last. There
// are at least 20, seed by seed.
InjectedView* injectedView(ViewKind kind, std::size_t index);

}  // namespace diptych::tests
