// SPDX-License-Identifier: MIT
#include "compare/viewer/drawing/drawing_thread.h"

#include "compare/viewer/drawing/drawing_work.h"
#include "compare/viewer/drawing/mailbox.h"

#include <mutex>
#include <thread>
#include <utility>

namespace diptych::viewer {

struct DrawingThread::State {
    explicit State(DrawingOptions o)
        : options(std::move(o)), mailbox(options.wake), thread([this] { runDrawing(options, mailbox); }) {}
    ~State() {
        mailbox.request([&] { mailbox.stopping = true; });
        thread.join();
    }

    const DrawingOptions options;
    Mailbox mailbox;
    std::thread thread;
};

DrawingThread::DrawingThread(DrawingOptions options) : state_(std::make_unique<State>(std::move(options))) {}
DrawingThread::~DrawingThread() = default;

std::uint64_t DrawingThread::ask(DrawRequest request) {
    Mailbox& mailbox = state_->mailbox;
    std::uint64_t id = 0;
    mailbox.request([&] {
        id = request.id = mailbox.wanted ? mailbox.wanted->id + 1 : 1;
        mailbox.wanted = std::move(request);
        mailbox.waiting = false;
    });
    return id;
}

void DrawingThread::save(const std::filesystem::path& folder) {
    Mailbox& mailbox = state_->mailbox;
    mailbox.request([&] {
        mailbox.save_to = folder;
        mailbox.waiting = false;
    });
}

std::string DrawingThread::saved() {
    const std::lock_guard lock(state_->mailbox.mutex);
    return std::exchange(state_->mailbox.saved, {});
}

std::shared_ptr<const DrawnView> DrawingThread::shown() const {
    return state_->mailbox.get(&Mailbox::shown);
}
std::shared_ptr<const EvaluatedPair> DrawingThread::evaluated() const {
    return state_->mailbox.get(&Mailbox::evaluated);
}
std::shared_ptr<const Breakdown> DrawingThread::breakdown() const {
    return state_->mailbox.get(&Mailbox::breakdown);
}
std::shared_ptr<const SceneProperties> DrawingThread::properties() const {
    return state_->mailbox.get(&Mailbox::properties);
}
Status DrawingThread::status() const {
    return state_->mailbox.get(&Mailbox::status);
}
bool DrawingThread::idle() const {
    return state_->mailbox.get(&Mailbox::waiting);
}
std::string DrawingThread::device() const {
    return state_->mailbox.get(&Mailbox::device_name);
}
std::uint64_t DrawingThread::validationMessages() const {
    return state_->mailbox.get(&Mailbox::validation_messages);
}
std::string DrawingThread::firstValidationMessage() const {
    return state_->mailbox.get(&Mailbox::first_validation_message);
}

}  // namespace diptych::viewer
