// SPDX-License-Identifier: MIT
// Everything needed to render a scene, prepared in advance: resources that all Settings share, and one
// view of the scene under one Settings, which can be rendered repeatedly.
#pragma once

#include "compare/render/path_table.h"
#include "shared/draw/culling.h"
#include "shared/draw/frame_buffers.h"
#include "shared/draw/frame_inputs.h"
#include "shared/environment/environment_light.h"
#include "shared/environment/haze.h"
#include "shared/frame/frame.h"
#include "shared/scene/scene_view.h"
#include "shared/shadow/shadow_maps.h"
#include "shared/transparent/fragment_lists.h"

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace diptych {

// Shared by all scenes on a device, so that each pipeline is compiled once.
struct PipelineSet {
    explicit PipelineSet(Device& device, Creation creation = Creation::at_once);
    OwnedDescriptorSetLayout material;
    Layouts layouts;
    Pipelines pipelines;
};

// Resources that all Settings share, uploaded and compiled once.
struct SharedResources {
    // Without `set` it creates its own pipelines.
    SharedResources(Device& device, const Scene& scene, std::shared_ptr<PipelineSet> set = nullptr);
    Uploader uploader;
    Geometry geometry;
    Posings posings;
    // Uploaded on first use.
    const Materials& materials(TexturePrecision precision);
    std::shared_ptr<PipelineSet> set;
    Layouts& layouts;
    Pipelines& pipelines;
    ClipmapAtlases clipmaps;
    EnvironmentStore environments;

private:
    Device& device_;
    std::map<TexturePrecision, Materials> materials_;
};

// One view of the scene under one Settings, ready for passes. Refers to its constructor's arguments, which
// must outlive it.
class PreparedView {
public:
    PreparedView(Device& device, SharedResources& shared, const SceneView& scene, const Settings& settings);
    PreparedView(const PreparedView&) = delete;
    PreparedView& operator=(const PreparedView&) = delete;

    std::vector<std::string> notes;    // what a reader of the image must know
    std::vector<std::string> details;  // for -v and plan: pre-pass, triangles of shadow maps
    const SceneView& scene;
    const Materials& materials_at_rest;
    std::optional<Materials> posed_materials;  // if an animation changes any
    const Materials& materials;
    GpuLights lights;
    DrawList draws;
    Culling culling;
    std::shared_ptr<const Posing> posing;
    FrameBuffers buffers;
    EnvironmentLight environment;
    Haze haze;
    ShadowMaps shadow;
    FragmentLists fragments;
    GBufferLayout gbuffer;
    FrameInputs inputs;
};

// A PreparedView with its passes, images and pipelines, ready to run again.
struct PreparedFrame {
    PreparedFrame(Device& device, SharedResources& shared, const SceneView& scene, const Settings& settings);

    const PathFunctions& path;
    PreparedView view;
    PassList passes;
    FrameImages images;
};

// Throws std::runtime_error naming --size if the image is too large for the device.
void checkSize(const Device& device, const Size& size);

// The Frame as known before rendering: names, Settings, camera, lights, notes of the scene.
Frame describedFrame(const PreparedFrame& prepared, const Scene& scene, const Settings& settings);
// Counters of the view's lists in the last run.
void readCounters(PreparedView& view, FrameCounters& counters);
FrameBytes bytesOf(const PreparedFrame& prepared, const SharedResources& shared);

// lit of the last run, row 0 on top, R, G, B.
Image readLit(PreparedFrame& prepared);
std::vector<Image> readImages(PassList& passes, std::span<const PassList::ReadBack> requests);

}  // namespace diptych
