// SPDX-License-Identifier: MIT
// A scene's properties that may decide between the paths, as a device measures them, and the scene with other
// values of them.
#pragma once

#include "compare/choose/deciders.h"
#include "compare/render/renderer.h"
#include "compare/tradeoff/measure.h"
#include "shared/frame/settings.h"
#include "shared/scene/model/scene.h"
#include "shared/scene/scene_view.h"

#include <array>
#include <memory>
#include <vector>

namespace diptych::cli {

struct VariedScene {
    Device& device;
    std::shared_ptr<PipelineSet> pipelines;
    SceneViews& views;  // of the scene as it is
    Renderer& renderer;
    const tradeoff::ReferenceFrames& references;
    std::array<Settings, 2> settings;  // the chosen ones, and the other path's
};

// Draws both of the scene as it is, from every camera of the references.
choose::DrawInOrder drawAsIs(const VariedScene& of);

// Size, overdraw, lights a pixel, blended pixels, samples, materials and triangles. What `of` refers to must
// outlive the variations, which are made when they are asked for, one at a time.
std::vector<choose::Property> propertiesOf(const VariedScene& of);

// Copies of a scene with one thing changed. Of posed `lights` each `factor` times, a whole number; or of 1/n
// every n-th one.
Scene withLights(const Scene& scene, std::span<const Light> lights, double factor);
// Before each solid triangle that no skin moves so many copies of it, a little below it.
Scene withOverdraw(const Scene& scene, int copies);
// For each triangle so many more that cover nothing.
Scene withEmptyTriangles(const Scene& scene, int copies);
// One material for all that is solid; one for each primitive.
Scene withOneMaterial(const Scene& scene);
Scene withOwnMaterials(const Scene& scene);
// Every material blended, or none.
Scene withBlends(const Scene& scene, bool all);

}  // namespace diptych::cli
