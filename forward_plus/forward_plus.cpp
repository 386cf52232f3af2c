// SPDX-License-Identifier: MIT
#include "forward_plus/forward_plus.h"

#include "shared/draw/background.h"
#include "shared/draw/forward_draws.h"
#include "shared/draw/pipeline_keys.h"
#include "shared/draw/record.h"
#include "shared/draw/resolve.h"
#include "shared/shadow/shadow_maps.h"
#include "shared/transparent/transparent.h"

#include <algorithm>
#include <memory>
#include <utility>

namespace diptych {

namespace {

void addShadedDraws(Pass& pass, PassList& passes, const FrameInputs& inputs, const FrameImages& images,
                    const LightBatch& batch, const KeyOf& keyOf) {
    inputs.shadow.read(pass);
    addForwardDraws(pass, passes, inputs, images, {inputs.draws.solids(), keyOf, inputs.prepass}, batch);
}

}  // namespace

FrameImages addForwardPlus(PassList& passes, const FrameInputs& inputs) {
    FrameImages images;
    addGeometryPasses(passes, inputs);
    inputs.shadow.addPasses(passes, inputs);
    images.depth = sceneDepth(passes, inputs);
    if (inputs.prepass)
        readGeometry(passes, passes.draw("depth pre-pass"), inputs)
            .depth(images.depth, Load::clear)
            .record(recordDraws(inputs, inputs.draws.solids(), depthKey));
    inputs.lists.addPasses(passes, inputs.pipelines, inputs.variant, inputs.frame_set, images.depth);
    // Without a pre-pass the first shading pass writes depth.
    bool drawn = inputs.prepass;
    const auto addShading = [&](Pass& pass, const LightBatch& batch, const auto& keyOf) {
        if (drawn)
            pass.depthTest(images.depth);
        else
            pass.depth(images.depth, Load::clear);
        addShadedDraws(pass, passes, inputs, images, batch, [&](const DrawItem& item) {
            PipelineKey key = keyOf(inputs, item, batch);
            key.depth_write = !drawn;
            return key;
        });
        drawn = true;
    };
    const LightBatch last = addEarlierBatches(
        passes, inputs,
        [&](Pass& pass, const LightBatch& batch, const auto&) { addShading(pass, batch, forwardBatchKey); },
        SumsBy::attachments, inputs.layers);
    const ImageRef lit = sampledImage(passes, inputs, "lit", inputs.lit_format);
    addShading(passes.draw("shade").color(lit, Load::clear), last, forwardKey);
    addBackground(passes, inputs, images.depth, lit);
    addTransparent(passes, inputs, images.depth, lit);
    images.lit_samples = lit;
    images.lit = addResolve(passes, inputs, lit);
    inputs.shadow.addMarks(passes, inputs, images.depth);
    return images;
}

std::vector<CapturedImage> addForwardPlusCapture(PassList& passes, const FrameInputs& inputs,
                                                 const FrameImages& frame, const CaptureRequest& request) {
    std::vector<CapturedImage> images;
    const auto capture = [&](const std::vector<Channel>& modes, bool encoded) {
        if (modes.empty()) return;
        const auto keyOf = [&](PipelineKey key) {
            return encoded ? throughGBuffer(std::move(key), inputs) : key;
        };
        const LightBatch last = addEarlierBatches(
            passes, inputs,
            [&](Pass& pass, const LightBatch& batch, const auto&) {
                pass.depthTest(frame.depth);
                addShadedDraws(pass, passes, inputs, frame, batch, [&](const DrawItem& item) {
                    return keyOf(forwardBatchKey(inputs, item, batch));
                });
            },
            SumsBy::attachments, inputs.layers);
        for (const CaptureGroup& group : captureGroups(modes, inputs.lit_format, maxCaptured(inputs))) {
            const ImageRef lit = addCaptureBackground(passes, inputs, frame.depth, group);
            Pass& pass = passes.draw("capture").depthTest(frame.depth);
            for (CapturedImage image :
                 addCaptureImages(passes, pass, group, lit, inputs.samples, request.every_sample)) {
                image.through_gbuffer = encoded;
                images.push_back(image);
            }
            addShadedDraws(pass, passes, inputs, frame, last, [&](const DrawItem& item) {
                return keyOf(forwardCaptureKey(inputs, item, group, last));
            });
            addTransparentCapture(passes, inputs, frame.depth, images);
        }
    };
    capture(request.modes, false);
    capture(request.through_gbuffer, true);
    return images;
}

}  // namespace diptych
