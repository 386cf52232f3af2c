// SPDX-License-Identifier: MIT
// Draws what the interface asks for, so that the interface never waits: the scene, both paths' pictures,
// their times, the verdict, a pixel's story and the reference, each as soon as nothing more urgent is asked
// for.
#pragma once

#include "compare/verdict/comparison.h"
#include "compare/viewer/shown.h"
#include "shared/vulkan/device.h"

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace diptych::viewer {

struct DrawingOptions {
    DeviceOptions device;
    CompareOptions compare;  // rules and pixels of the verdict
    // Called from another thread whenever there is something new to show.
    std::function<void()> wake;
    // For tests: called before each picture; what it throws is taken for the device's.
    std::function<void()> before_picture{};
};

// The interface's side. Every function returns at once and may be called from one thread.
class DrawingThread {
public:
    explicit DrawingThread(DrawingOptions options);
    ~DrawingThread();  // waits for the frame that is being drawn
    DrawingThread(const DrawingThread&) = delete;
    DrawingThread& operator=(const DrawingThread&) = delete;

    // What is wanted from now on. Work for an earlier order that nobody wants any more ends at its next step.
    // An order is numbered here; the number is returned.
    std::uint64_t ask(Order order);

    // Writes the shown channel of both paths as PNG and all channels as EXR, NAME.deferred.png and so on, of
    // the order asked for last; writes nothing over files that are there.
    void save(const std::filesystem::path& folder);
    std::string saved();  // what save() wrote, or why it could not, in one line, once; empty: nothing new

    std::shared_ptr<const Shown> shown() const;  // nullptr before the first picture
    std::shared_ptr<const Judged> judged() const;
    std::shared_ptr<const Story> story() const;
    std::shared_ptr<const SceneFacts> facts() const;  // of the scene that is loaded; nullptr: none is
    Status status() const;
    bool idle() const;  // all that was asked for is there
    std::string device() const;
    // Messages of the validation layers, of all devices so far.
    std::uint64_t validationMessages() const;
    std::string firstValidationMessage() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace diptych::viewer
