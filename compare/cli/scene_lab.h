// SPDX-License-Identifier: MIT
// Candidates of a choice, drawn and timed on a device.
#pragma once

#include "compare/choose/search.h"
#include "compare/render/renderer.h"
#include "compare/tradeoff/measure.h"

#include <cstddef>
#include <cstdint>
#include <list>
#include <map>
#include <span>
#include <utility>
#include <vector>

namespace diptych::cli {

// Of one scene, from every camera of the reference frames: errors are of all their pixels together, times the
// mean over them, memory that of the camera that takes most; passes are those of the first camera.
class SceneLab final : public choose::Lab {
public:
    // `figure`: of tradeoff::errorFigures. The renderer and the references must outlive it.
    SceneLab(Renderer& renderer, const tradeoff::ReferenceFrames& references, std::size_t figure,
             const RenderOptions& options)
        : renderer_(renderer), references_(references), figure_(figure), options_(options) {}

    choose::Judged judge(const Settings& settings) override;
    std::vector<double> time(std::span<const Settings> frames, std::span<const std::size_t> order) override;
    // Drops the frames that it keeps: each has images of its own.
    void release() {
        drawn_.clear();
        judged_.clear();
    }
    std::vector<PassTime> profile(const Settings& settings) override;

private:
    std::size_t cameras() const { return references_.frames.size(); }
    bool isOfReferenceSize(const Settings& settings) const;
    choose::Judged judgeCaptured(const Settings& settings);
    // Of a picture from one of the cameras; FLIP of what was judged before is known by its pixels.
    tradeoff::FrameErrors errorsOf(std::size_t camera, const Image& lit);

    struct Drawn {
        Settings settings;
        PreparedFrames frames;
        bool made_pipelines, is_drawn = false;
    };
    // Makes frames of Settings with their cameras unless they are there, so that what was judged is timed
    // without being made anew. Of the others the latest are kept, mostKept for each camera.
    void prepare(std::span<const Settings> seen);
    Drawn& prepared(const Settings& seen);
    PreparedFrames& drawn(const Settings& seen);  // that were prepared, drawn once at least
    // That were prepared, and whose next frame, which the caller draws, is like all others.
    Drawn& readyForTimes(const Settings& seen);

    Renderer& renderer_;
    const tradeoff::ReferenceFrames& references_;
    std::size_t figure_;
    RenderOptions options_;
    std::list<Drawn> drawn_;
    // By camera and picture; only of FLIP, as other figures hold every pixel.
    std::map<std::pair<std::size_t, std::uint64_t>, tradeoff::FrameErrors> judged_;
};

}  // namespace diptych::cli
