// SPDX-License-Identifier: MIT
// The image of a path whose input a test has changed.
#pragma once

#include "compare/frames/frame_properties.h"
#include "compare/render/prepared_view.h"
#include "tests/image/scenes.h"

#include <array>
#include <functional>

namespace diptych::tests {

// lit, after `change` has modified the path's input; `after` is called with the view once it is rendered.
inline Image litWith(const Scene& scene, const Settings& settings,
                     const std::function<void(PreparedView&)>& change,
                     const std::function<void(PreparedView&)>& after = {}) {
    SharedResources shared(device(), scene, pipelines());
    const SceneView seen = makeSceneView(scene, viewRequest(settings));
    PreparedView view(device(), shared, seen, settings);
    change(view);
    const PathFunctions& path = functionsOf(settings.path);
    PassList passes(device(), static_cast<std::uint32_t>(settings.size.width),
                    static_cast<std::uint32_t>(settings.size.height));
    const FrameImages images = path.add(passes, view.inputs);
    passes.run();
    if (after) after(view);
    return readImages(passes, std::array{PassList::ReadBack{images.lit, 3}}).front();
}

}  // namespace diptych::tests
