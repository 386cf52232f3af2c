// SPDX-License-Identifier: MIT
// Renders requests in the background, so that the interface never waits: the scene, both paths' images,
// their times, the verdict, a pixel breakdown and the reference, the most urgent first.
#pragma once

#include "compare/viewer/drawing/drawing_options.h"
#include "compare/viewer/drawing/result.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

namespace diptych::viewer {

// The interface's side. Every function returns at once; call them from one thread.
class DrawingThread {
public:
    explicit DrawingThread(DrawingOptions options);
    ~DrawingThread();  // waits for the current frame
    DrawingThread(const DrawingThread&) = delete;
    DrawingThread& operator=(const DrawingThread&) = delete;

    // Replaces the request. Work for an earlier request that is no longer needed stops at its next step.
    // Returns the id given to the request.
    std::uint64_t ask(DrawRequest request);

    // Writes the visible channel of both paths as PNG and all channels as EXR, NAME.deferred.png and so
    // on, for the last request. Never overwrites files.
    void save(const std::filesystem::path& folder);
    std::string saved();  // one line, once: files written by save(), or its error; empty: nothing new

    std::shared_ptr<const DrawnView> shown() const;  // nullptr before the first image
    std::shared_ptr<const EvaluatedPair> evaluated() const;
    std::shared_ptr<const Breakdown> breakdown() const;
    std::shared_ptr<const SceneProperties> properties() const;  // of the loaded scene; nullptr: none
    Status status() const;
    bool idle() const;  // the request is complete
    std::string device() const;
    // Number of validation-layer messages from all devices so far.
    std::uint64_t validationMessages() const;
    std::string firstValidationMessage() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace diptych::viewer
