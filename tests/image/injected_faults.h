// SPDX-License-Identifier: MIT
// Views of scenes, and what a renderer with a known fault draws of them: channels of its surfaces that are
// wrong, a scene, Settings or light that it takes otherwise, terms that it adds up otherwise. Its Frame says
// nothing of the fault: Settings are those of the right one.
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

// The name of the first of a view's lights, which alone has one.
inline constexpr const char* firstLight = "the first";

// What a view must have for a fault to be in it: light of lights, haze and ambient light on opaque surfaces;
// or blended surfaces before an environment, in haze.
enum class ViewKind { opaque, blended };

struct InjectedFault {
    std::string means;               // "normals of 8 bits"
    std::vector<std::string> named;  // the causes of which one has to be first
    ViewKind kind = ViewKind::opaque;
    bool of_first_light = false;  // it is in the first of the scene's lights alone
    // What it makes of a pixel of one channel of the surface; or, if it is no fault of a channel, ...
    std::string channel{};
    std::function<void(float*)> pixel{};
    // ... of what is drawn, ...
    std::function<void(Settings&, Scene&)> draw{};
    // ... or of terms and lit, once they are drawn.
    std::function<void(InjectedView&, Frame&)> after{};
};

// At least 50 of them.
const std::vector<InjectedFault>& injectedFaults();
const InjectedFault& injectedFault(std::string_view means);  // throws std::out_of_range

// One scene x camera x seed. The seed sets lights, materials, and what baked light and occlusion there is.
class InjectedView {
public:
    InjectedView(const std::string& scene, const std::string& camera, std::uint32_t seed, ViewKind kind);

    // The Frame of a renderer with these faults, with the terms of its lit as channels.
    Frame with(std::span<const InjectedFault* const> faults);
    Frame with(const InjectedFault& fault);
    Explanation explained(const Frame& test);
    // Whether the fault changes lit by more than rounding here; drawn once for each.
    bool feels(const InjectedFault& fault);

    bool covered(std::size_t pixel) const;

    const std::string name;
    const ViewKind kind;
    Scene scene;
    SceneViews views;
    Renderer renderer;
    Settings settings;
    Frame right;

    // Our lighting of the right surfaces under other Settings, with some channel of theirs changed.
    Image litUnder(const Settings& other, const std::string& channel = {},
                   const std::function<void(float*)>& pixel = {});

private:
    void shadeInto(Frame& frame, const Settings& drawn);

    // The right picture's lighting, in which channels are replaced.
    SurfaceImages images_;
    std::optional<ChannelShading> shading_;
    std::map<std::string, bool> felt_;
};

// Whether two pictures differ by more than rounding: by over 1e-5 of the mean of the first.
bool differsVisibly(const Image& a, const Image& b);

// The views in which faults of a kind are planted: at least 20, each made at its first use and then kept.
std::vector<InjectedView*> injectedViews(ViewKind kind);

}  // namespace diptych::tests
