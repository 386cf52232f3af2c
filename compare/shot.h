// SPDX-License-Identifier: MIT
// What drawing a scene takes, made up front: what all Settings share, and one view of the scene under one
// Settings, ready to be drawn again and again.
#pragma once

#include "compare/render.h"
#include "shared/draw/frame_inputs.h"
#include "shared/scene/requirements.h"
#include "shared/scene/view.h"

#include <cstdint>
#include <string>
#include <vector>

namespace diptych {

// What all Settings share: uploaded and compiled once.
struct SharedResources {
    SharedResources(Device& device, const Scene& scene);
    Uploader uploader;
    Geometry geometry;
    Materials materials;
    Layouts layouts;
    Pipelines pipelines;
};

// One view of the scene under one Settings, ready for passes.
class Shot {
public:
    Shot(Device& device, SharedResources& shared, const Scene& scene, const Settings& settings);
    Shot(const Shot&) = delete;
    Shot& operator=(const Shot&) = delete;

    std::vector<std::string> notes;  // what was decided for this view
    Pose pose;
    View view;
    Requirements needs;
    std::vector<Light> lit_by;
    GpuLights lights;
    DrawList draws;
    FrameBuffers buffers;
    GBufferLayout gbuffer;
    FrameInputs inputs;

private:
    // Tiles are bounded by depth, so they need it first.
    void decidePrepass(const Settings& settings);
};

// What a path is made of.
struct PathFunctions {
    Path path;
    FrameImages (*add)(PassList&, const FrameInputs&);
    std::vector<CapturedImage> (*capture)(PassList&, const FrameInputs&, const FrameImages&,
                                          const CaptureRequest&);
    std::uint32_t (*bytesPerPixel)(const FrameInputs&);
};
// Throws std::logic_error for the reference, which no device draws.
const PathFunctions& functionsOf(Path path);

// A Shot with its passes, images and pipelines: all that running it again needs.
struct DrawnShot {
    DrawnShot(Device& device, SharedResources& shared, const Scene& scene, const Settings& settings);

    const PathFunctions& path;
    Shot shot;
    PassList passes;
    FrameImages images;
};

// Throws std::runtime_error naming --size where the device draws no picture so large.
void checkSize(const Device& device, const Size& size);

// What is known of the Frame before it is drawn: names, Settings, camera, lights, notes of the scene.
Frame describedFrame(const DrawnShot& drawn, const SharedResources& shared, const Scene& scene,
                     const Settings& settings);
FrameBytes bytesOf(const DrawnShot& drawn, const SharedResources& shared);

// lit as the last run left it, row 0 on top, R, G, B.
Image readLit(DrawnShot& drawn);
std::vector<Image> readImages(PassList& passes, const std::vector<PassList::ReadBack>& requests);

// Median, least and greatest, ms.
FrameTime timeOf(std::vector<double> ms);

}  // namespace diptych
