// SPDX-License-Identifier: MIT
#include "compare/viewer/viewer.h"

#include "compare/viewer/drawing/canvas.h"
#include "compare/viewer/drawing/drawing_thread.h"
#include "compare/viewer/interface/actions.h"
#include "compare/viewer/interface/keys.h"
#include "compare/viewer/latencies.h"
#include "compare/viewer/scene_watch.h"
#include "compare/viewer/window/fly_camera.h"
#include "compare/viewer/window/mouse.h"
#include "compare/viewer/window/screen.h"
#include "compare/viewer/window/window.h"
#include "compare/viewer/window/zoom_flight.h"

#include <GLFW/glfw3.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <utility>
#include <vector>

namespace diptych::viewer {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int defaultWidth = 1280, defaultHeight = 760;  // of the window, at scale 1
// Interval between frames of the interface, s: 60 frames a second while something moves, at most 125.
constexpr double movingPause = 1.0 / 60, minPause = 1.0 / 125, idlePause = 0.25;
// A view is still once nothing has moved for this time, s.
constexpr double stillAfter = 0.15, resizedAfter = 0.3;
constexpr double watchPause = 0.3;  // s

double secondsBetween(Clock::time_point from, Clock::time_point to) {
    return std::chrono::duration<double>(to - from).count();
}

// The loop and its events, in one class and so in one long file: nearly every function reads and changes the
// same state.
class Viewer {
public:
    explicit Viewer(const ViewerOptions& options)
        : options_(options),
          window_(defaultWidth, defaultHeight, "Diptych"),
          screen_(window_, options.device.validate, [this](const std::string& line) { log(line); }),
          drawing_({options.device, options.compare, Window::wake}) {
        state_.subject = options.subject;
        if (isReference(state_.subject.settings.path)) state_.subject.settings.path = drawn_paths[1];
        state_.view_options = options.view_options;
        state_.stored = options.view_options.file;
        // Without --baseline, which the interface chooses.
        const std::vector<std::string>& words = options.compare.words;
        for (std::size_t i = 0; i < words.size(); ++i)
            if (words[i] == "--baseline")
                ++i;
            else
                state_.counted.push_back(words[i]);
        state_.follow = !options.size_requested;
        state_.edited = state_.subject.settings;
        state_.rig = state_.subject.settings.lights;
        if (options.pixel) {
            state_.pixel = options.pixel;
            state_.open = Tab::pixel;
            state_.canvas.zoom = surroundingsZoom * window_.contentScale();
            state_.canvas.centre_x = options.pixel->x + 0.5;
            state_.canvas.centre_y = options.pixel->y + 0.5;
        }
        watch_.watch(state_.subject.scene, state_.subject.settings);
    }

    ViewerResult run() {
        while (!quit_) {
            const Input input = window_.poll(pause());
            if (input.closed) break;
            const Clock::time_point start = Clock::now();
            window_.size(width_, height_);
            const bool news = takeNews();
            now_ = secondsBetween(begun_, start);
            if (width_ == 0 || height_ == 0) {  // minimised
                last_ = now_;
                handleDropped(input);
                continue;
            }
            handle(input);
            ask();
            if (input.any || news || isMoving()) frames_left_ = 3;
            if (frames_left_ > 0) {
                --frames_left_;
                frame();
                latencies_.frame(1000 * secondsBetween(start, Clock::now()));
            }
            last_ = now_;
        }
        latencies_.reportFrames();
        ViewerResult result{drawing_.validationMessages() + screen_.log().messages,
                            drawing_.firstValidationMessage()};
        if (result.first_validation_message.empty()) result.first_validation_message = screen_.log().first;
        return result;
    }

private:
    // ---- time -----------------------------------------------------------------------------------------

    bool isMoving() const {
        return now_ < moving_until_ || state_.playing || flight_.isFlying() || isHeldMoving();
    }

    double pause() const {
        const double since = secondsBetween(begun_, Clock::now()) - last_;
        if (isMoving() || frames_left_ > 0)
            return std::max(0.001, (isMoving() ? movingPause : minPause) - since);
        return idlePause;
    }

    void log(const std::string& line) const {
        if (options_.log) options_.log(line);
    }
    void tell(const std::string& message) {
        state_.message = message;
        state_.message_until = ImGui::GetTime() + 6;
        frames_left_ = 3;
        log(message);
    }

    // ---- results of the drawing thread ----------------------------------------------------------------

    // Takes new results; false if there are none.
    bool takeNews() {
        Contents next = contents_;
        next.shown = drawing_.shown();
        next.evaluated = drawing_.evaluated();
        next.breakdown = drawing_.breakdown();
        next.properties = drawing_.properties();
        next.status = drawing_.status();
        next.idle = drawing_.idle();
        const bool images = next.shown != contents_.shown;
        const bool news = images || next.evaluated != contents_.evaluated ||
                          next.breakdown != contents_.breakdown || next.properties != contents_.properties ||
                          next.status.doing != contents_.status.doing ||
                          std::abs(next.status.fraction - contents_.status.fraction) > 0.005 ||
                          next.status.error != contents_.status.error || next.idle != contents_.idle;
        if (next.status.error != contents_.status.error && !next.status.error.empty()) log(next.status.error);
        if (next.idle && request_.id != reported_idle_) {
            reported_idle_ = request_.id;
            log("still: all is drawn");
        }
        contents_ = std::move(next);
        if (contents_.properties) state_.loaded = contents_.properties->scene;
        if (images) takeImages();
        if (const std::string saved = drawing_.saved(); !saved.empty()) tell(saved);
        return news;
    }

    void takeImages() {
        const DrawnView& shown = *contents_.shown;
        for (std::size_t i = 0; i < 2; ++i) histories_.at(isWhole(shown)).at(i).add(shown.paths[i]);
        const std::string& asked = state_.subject.settings.camera;
        if (shown.request.subject.settings.camera == asked && asked != own_camera_ &&
            shown.request.subject.scene == state_.subject.scene) {
            camera_.take(shown.camera);
            own_camera_ = asked;
        }
    }

    // ---- requests -------------------------------------------------------------------------------------

    // Changes both the rendered Settings and those in the settings panel.
    template <class Change>
    void change(const Change& change) {
        change(state_.subject.settings);
        change(state_.edited);
    }

    void ask() {
        if (fitToCanvas(canvasNow(), state_) && request_.id != 0)
            moving_until_ = std::max(moving_until_, now_ + resizedAfter);
        // Repeated changes, as from a slider, count as movement.
        if (request_.subject != state_.subject) {
            if (now_ - changed_ < resizedAfter) moving_until_ = std::max(moving_until_, now_ + stillAfter);
            changed_ = now_;
        }
        const bool moving = now_ < moving_until_ || state_.playing || isHeldMoving();
        if (request_.id != 0 && request_.subject == state_.subject &&
            request_.view_options == state_.view_options && request_.moving == moving &&
            request_.pixel == state_.pixel)
            return;
        request_.subject = state_.subject;
        request_.view_options = state_.view_options;
        request_.moving = moving;
        request_.pixel = state_.pixel;
        request_.id = drawing_.ask(request_);
        latencies_.asked(request_.id);
    }

    void readAgain() {
        ++state_.subject.reading;
        watch_.watch(state_.subject.scene, state_.subject.settings);
    }

    // ---- input ----------------------------------------------------------------------------------------

    static bool isKeyDown(int key, void* of) { return static_cast<const Window*>(of)->isDown(key); }
    bool isHeld(Action action) const {
        return viewer::isHeld(action, isKeyDown, const_cast<Window*>(&window_)) ||
               (action == Action::sink && window_.isDown(GLFW_KEY_RIGHT_CONTROL));
    }
    bool isHeldMoving() const {
        if (ImGui::GetIO().WantTextInput || !camera_.canMove()) return false;
        return std::ranges::any_of(std::array{Action::forward, Action::left, Action::back, Action::right,
                                              Action::rise, Action::sink},
                                   [&](Action action) { return isHeld(action); });
    }

    void handle(const Input& input) {
        handleDropped(input);
        handleRequests();
        const ImGuiIO& io = ImGui::GetIO();
        for (const KeyDown& key : input.keys) press(key, io.WantTextInput);
        // Dear ImGui reports the previous frame, so only windows that may cover the images are asked
        // about.
        const bool covered = state_.help || ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopup);
        mouse_.handle(input, canvasNow(), screen_.scale(), covered && io.WantCaptureMouse);
        move();
        flight_.move(now_, state_.canvas);
        play();
        state_.canvas.other = !io.WantTextInput && isHeld(Action::flicker);
        if (options_.watch && now_ - watched_ > watchPause) {
            watched_ = now_;
            if (watch_.changed()) {
                tell("read again: a file has changed");
                readAgain();
            }
        }
        screen_.followScale();
    }

    void handleRequests() {
        InterfaceState::Requests requests = std::exchange(state_.requests, {});
        if (!requests.copy.empty()) {
            window_.copy(requests.copy);
            tell("copied: " + requests.copy);
        }
        if (requests.reload) readAgain();
        if (requests.flight)
            flight_.begin(now_, state_.canvas, canvasNow(), state_.subject.settings.size,
                          requests.flight->pixel, requests.flight->zoom * screen_.scale());
        if (requests.camera) {
            change([&](Settings& s) { s.camera = *requests.camera; });
            own_camera_ = "none taken yet";
        }
    }

    void handleDropped(const Input& input) {
        for (const std::filesystem::path& file : input.dropped)
            if (const std::string message = openDropped(file, state_); !message.empty()) tell(message);
    }

    // `typing`: a text field has the focus and takes all other keys.
    void press(const KeyDown& key, bool typing) {
        const std::optional<KeyPress> found = actionOf(key.key, key.control);
        if (!found || (typing && found->action != Action::quit && found->action != Action::leave)) return;
        latencies_.pressed(nameOfKey(found->action), request_.id);
        act(*found, key.shift);
    }

    static std::string_view nameOfKey(Action action) {
        for (const KeyBinding& binding : keyBindings())
            if (binding.action == action) return binding.name;
        return {};
    }

    void act(const KeyPress& pressed, bool shift) {
        if (pressed.action == Action::leave) flight_.stop();
        if (const auto message = actOnState(pressed, shift, contents_, state_)) {
            handleRequests();
            if (!message->empty()) tell(*message);
            return;
        }
        switch (pressed.action) {
            case Action::screenshot:
                drawing_.save(options_.out.empty() ? "." : options_.out);
                tell("writing both paths, all channels");
                break;
            case Action::full_screen:
                window_.toggleFullScreen();
                break;
            case Action::leave:
                if (window_.isFullScreen()) window_.toggleFullScreen();
                break;
            case Action::quit:
                quit_ = true;
                break;
            default:  // held keys
                if (pressed.action != Action::flicker && !camera_.canMove() && contents_.shown)
                    tell("this camera is orthographic and cannot move: press N for another camera");
        }
    }

    // ---- moving ---------------------------------------------------------------------------------------

    void moved() {
        moving_until_ = now_ + stillAfter;
        own_camera_ = camera_.describe();
        change([&](Settings& s) { s.camera = own_camera_; });
    }

    void move() {
        if (!isHeldMoving()) {
            held_ = false;
            return;
        }
        const double seconds = std::min(now_ - last_, 0.1), by = state_.speed * camera_.targetDistance() *
                                                                 std::min(seconds, held_ ? 1.0 : movingPause);
        held_ = true;
        const auto axis = [&](Action plus, Action minus) {
            return (isHeld(plus) ? by : 0) - (isHeld(minus) ? by : 0);
        };
        camera_.move({axis(Action::right, Action::left), axis(Action::rise, Action::sink),
                      axis(Action::forward, Action::back)});
        moved();
    }

    void play() {
        if (!state_.playing) return;
        const double duration = contents_.properties ? contents_.properties->duration : 0;
        if (!(duration > 0)) {
            state_.playing = false;
            return;
        }
        const double time = std::fmod(state_.subject.settings.time + std::min(now_ - last_, 0.25), duration);
        change([&](Settings& s) { s.time = time; });
    }

    // ---- drawing the window ---------------------------------------------------------------------------

    CanvasRect canvasNow() const { return canvasOf(state_, width_, height_, screen_.scale()); }

    void frame() {
        contents_.history = &histories_.at(!contents_.shown || isWhole(*contents_.shown));
        contents_.interface_ms = latencies_.percentile();
        contents_.drawn_by = drawing_.device();
        contents_.shown_by = screen_.device();
        const CanvasRect canvas = canvasNow();
        screen_.draw(state_, contents_, canvas, panelRectsOf(canvas, state_));
        window_.setTitle(titleOf(state_, contents_));
        if (contents_.shown) latencies_.seen(*contents_.shown, request_.id);
    }

    const ViewerOptions& options_;
    const Clock::time_point begun_ = Clock::now();
    InterfaceState state_;
    Window window_;
    Screen screen_;
    DrawingThread drawing_;
    Contents contents_;
    std::array<std::array<History, 2>, 2> histories_;  // of reduced images, of full ones
    FlyCamera camera_;
    std::string own_camera_ = "none taken yet";  // --camera text of camera_
    SceneWatch watch_;
    DrawRequest request_;                                         // the latest request
    std::uint64_t reported_idle_ = 0;                             // the last request reported as complete
    double now_ = 0, last_ = 0, moving_until_ = 0, watched_ = 0;  // s since begun_
    double changed_ = -1;                                         // time of the last change of the subject
    int width_ = 0, height_ = 0, frames_left_ = 3;
    bool quit_ = false, held_ = false;
    ZoomFlight flight_;
    Mouse mouse_{state_,
                 contents_,
                 camera_,
                 {[this] { moved(); }, [this](const std::string& line) { log(line); },
                  [this](const std::string& line) { tell(line); }}};
    Latencies latencies_{[this](const std::string& line) { log(line); }, begun_};
};

}  // namespace

ViewerResult runViewer(const ViewerOptions& options) {
    return Viewer(options).run();
}

}  // namespace diptych::viewer
