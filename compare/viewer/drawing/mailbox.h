// SPDX-License-Identifier: MIT
// The interface's requests and the drawing thread's results, behind one mutex.
#pragma once

#include "compare/viewer/drawing/result.h"

#include <condition_variable>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

namespace diptych::viewer {

struct Mailbox {
    explicit Mailbox(std::function<void()> w) : wake(std::move(w)) {}

    const std::function<void()> wake;  // wakes the interface: there is a new result

    mutable std::mutex mutex;        // of everything below
    std::condition_variable signal;  // wakes the drawing thread

    bool stopping = false;
    std::optional<DrawRequest> wanted;
    std::optional<std::filesystem::path> save_to;

    bool waiting = false;  // the request is complete
    std::string saved;
    std::shared_ptr<const DrawnView> shown;
    std::shared_ptr<const EvaluatedPair> evaluated;
    std::shared_ptr<const Breakdown> breakdown;
    std::shared_ptr<const SceneProperties> properties;
    Status status;
    std::string device_name;
    std::uint64_t validation_messages = 0;
    std::string first_validation_message;

    // Changes members and wakes the drawing thread.
    template <class Change>
    void request(const Change& change) {
        {
            const std::lock_guard lock(mutex);
            change();
        }
        signal.notify_all();
    }
    // Changes members and wakes the interface.
    template <class Change>
    void publish(const Change& change) {
        {
            const std::lock_guard lock(mutex);
            change();
        }
        wake();
    }
    // Sets the number of validation messages so far; keeps the first one.
    void count(std::uint64_t messages, const std::string& first) {
        const std::lock_guard lock(mutex);
        if (validation_messages == 0 && messages > 0) first_validation_message = first;
        validation_messages = messages;
    }
    // A copy of the member.
    template <class Value>
    Value get(Value Mailbox::*member) const {
        const std::lock_guard lock(mutex);
        return this->*member;
    }
};

}  // namespace diptych::viewer
