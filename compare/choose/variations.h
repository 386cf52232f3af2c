// SPDX-License-Identifier: MIT
// Measures properties of a scene that may decide between the paths, and varies them.
#pragma once

#include "compare/choose/sensitivity.h"
#include "compare/experiment/references.h"
#include "compare/render/renderer.h"
#include "shared/frame/settings.h"
#include "shared/scene/model/scene.h"
#include "shared/scene/scene_view.h"

#include <array>
#include <memory>
#include <vector>

namespace diptych::choose {

struct VariedScene {
    Device& device;
    std::shared_ptr<PipelineSet> pipelines;
    SceneViews& views;  // of the original scene
    Renderer& renderer;
    const experiment::ReferenceFrames& references;
    std::array<Settings, 2> settings;  // chosen path, other path
};

// Renders both Settings of the scene, from every camera of the references.
DrawInOrder drawAsIs(const VariedScene& of);

// Size, overdraw, lights per pixel, blended pixels, samples, materials and triangles. The references in
// `of` must outlive the variations. Variations are created on demand, one at a time.
std::vector<Property> propertiesOf(const VariedScene& of);

// Copies of a scene with one change. withLights(): `lights` have world transforms. `factor` n repeats each
// light n times; 1/n keeps every n-th light.
Scene withLights(const Scene& scene, std::span<const Light> lights, double factor);
// Adds `copies` hidden copies below each opaque triangle that is not skinned or morphed.
Scene withOverdraw(const Scene& scene, int copies);
// Adds `copies` degenerate triangles per triangle.
Scene withEmptyTriangles(const Scene& scene, int copies);
// withOneMaterial(): one for all opaque primitives. withOwnMaterials(): one for each primitive.
Scene withOneMaterial(const Scene& scene);
Scene withOwnMaterials(const Scene& scene);
// Makes every material blended, or none.
Scene withBlends(const Scene& scene, bool all);

}  // namespace diptych::choose
