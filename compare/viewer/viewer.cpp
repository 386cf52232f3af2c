// SPDX-License-Identifier: MIT
#include "compare/viewer/viewer.h"

#include "compare/files/our_files.h"
#include "compare/viewer/actions.h"
#include "compare/viewer/canvas.h"
#include "compare/viewer/drawing_thread.h"
#include "compare/viewer/fly_camera.h"
#include "compare/viewer/fonts.h"
#include "compare/viewer/interface.h"
#include "compare/viewer/keys.h"
#include "compare/viewer/latencies.h"
#include "compare/viewer/presenter.h"
#include "compare/viewer/scene_watch.h"
#include "compare/viewer/window.h"
#include "compare/viewer/zoom_flight.h"
#include "shared/frame/debug_modes.h"

#include <vulkan/vulkan_core.h>

#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <numbers>
#include <stdexcept>
#include <utility>
#include <vector>

namespace diptych::viewer {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int defaultWidth = 1280, defaultHeight = 760;  // of the window, at scale 1
// Interval between frames of the interface, s: 60 frames a second while something moves, at most 125.
constexpr double movingPause = 1.0 / 60, leastPause = 1.0 / 125, idlePause = 0.25;
// A view is still once nothing has moved for this time, s.
constexpr double stillAfter = 0.15, resizedAfter = 0.3;
constexpr double watchPause = 0.3;  // s
// Window pixels per image pixel: for Z, which shows values, and for a pixel in its surroundings.
constexpr double zoomed = 80, flown = 32;
constexpr double least_zoom = 1, most_zoom = 128;
constexpr double wipeReach = 7;    // window pixels around the wipe's line where the cursor grabs it
constexpr int mostPresenters = 3;  // number of consecutive recreations after lost devices

double secondsBetween(Clock::time_point from, Clock::time_point to) {
    return std::chrono::duration<double>(to - from).count();
}

// Dear ImGui's context and its event source.
struct ImGuiContextOf {
    explicit ImGuiContextOf(GLFWwindow* window) {
        IMGUI_CHECKVERSION();
        ImGui::CreateContext();
        ImGui::GetIO().IniFilename = nullptr;
        ImGui_ImplGlfw_InitForVulkan(window, false);
    }
    ~ImGuiContextOf() {
        ImGui_ImplGlfw_Shutdown();
        ImGui::DestroyContext();
    }
    ImGuiContextOf(const ImGuiContextOf&) = delete;
    ImGuiContextOf& operator=(const ImGuiContextOf&) = delete;
};

void setScale(double scale) {
    ImGui::GetStyle() = ImGuiStyle();
    ImGui::StyleColorsDark();
    ImGui::GetStyle().WindowRounding = 0;
    ImGui::GetStyle().WindowBorderSize = 0;
    ImGui::GetStyle().Colors[ImGuiCol_WindowBg] = {0.11f, 0.11f, 0.125f, 1};
    ImGui::GetStyle().ScaleAllSizes(static_cast<float>(scale));
    loadFonts(scale);
}

enum class Drag { none, look, wipe, picture };

class Viewer {
public:
    explicit Viewer(const ViewerOptions& options)
        : options_(options),
          window_(defaultWidth, defaultHeight, "Diptych"),
          imgui_(window_.handle()),
          drawing_({options.device, options.compare, Window::wake}) {
        state_.subject = options.subject;
        if (state_.subject.settings.path == Path::reference) state_.subject.settings.path = drawn_paths[1];
        state_.look = options.look;
        state_.stored = options.look.file;
        // Without --baseline, which the interface chooses.
        const std::vector<std::string>& words = options.compare.words;
        for (std::size_t i = 0; i < words.size(); ++i)
            if (words[i] == "--baseline")
                ++i;
            else
                state_.counted.push_back(words[i]);
        state_.follow = !options.size_given;
        state_.edited = state_.subject.settings;
        state_.rig = state_.subject.settings.lights;
        if (options.pixel) {
            state_.pixel = options.pixel;
            state_.open = Tab::pixel;
            state_.canvas.zoom = flown * window_.contentScale();
            state_.canvas.centre_x = options.pixel->x + 0.5;
            state_.canvas.centre_y = options.pixel->y + 0.5;
        }
        scale_ = window_.contentScale();
        setScale(scale_);
        makePresenter();
        watch_.watch(state_.subject.scene, otherFiles());
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
        latencies_.sayFrames();
        ViewerResult result{drawing_.validationMessages() + log_.messages, drawing_.firstValidationMessage()};
        if (result.first_validation_message.empty()) result.first_validation_message = log_.first;
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
            return std::max(0.001, (isMoving() ? movingPause : leastPause) - since);
        return idlePause;
    }

    void say(const std::string& line) const {
        if (options_.say) options_.say(line);
    }
    void tell(const std::string& message) {
        state_.message = message;
        state_.message_until = ImGui::GetTime() + 6;
        frames_left_ = 3;
        say(message);
    }

    // ---- results of the drawing thread ----------------------------------------------------------------

    // Takes new results; false if there are none.
    bool takeNews() {
        Contents next = contents_;
        next.shown = drawing_.shown();
        next.judged = drawing_.judged();
        next.breakdown = drawing_.breakdown();
        next.facts = drawing_.facts();
        next.status = drawing_.status();
        next.idle = drawing_.idle();
        const bool pictures = next.shown != contents_.shown;
        const bool news = pictures || next.judged != contents_.judged ||
                          next.breakdown != contents_.breakdown || next.facts != contents_.facts ||
                          next.status.doing != contents_.status.doing ||
                          std::abs(next.status.fraction - contents_.status.fraction) > 0.005 ||
                          next.status.error != contents_.status.error || next.idle != contents_.idle;
        if (next.status.error != contents_.status.error && !next.status.error.empty()) say(next.status.error);
        if (next.idle && order_.number != said_still_) {
            said_still_ = order_.number;
            say("still: all is drawn");
        }
        contents_ = std::move(next);
        if (contents_.facts) state_.loaded = contents_.facts->scene;
        if (pictures) takePictures();
        if (const std::string saved = drawing_.saved(); !saved.empty()) tell(saved);
        return news;
    }

    void takePictures() {
        const Shown& shown = *contents_.shown;
        for (std::size_t i = 0; i < 2; ++i) histories_.at(isWhole(shown)).at(i).add(shown.paths[i]);
        const std::string& asked = state_.subject.settings.camera;
        if (shown.order.subject.settings.camera == asked && asked != own_camera_ &&
            shown.order.subject.scene == state_.subject.scene) {
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
        const CanvasRect canvas = canvasOf(state_, width_, height_, scale_);
        if (state_.follow) {
            const bool halves =
                state_.canvas.layout == Layout::side_by_side && state_.look.difference == Difference::none;
            const Size size{std::max(1, halves ? (canvas.width - 2) / 2 : canvas.width),
                            std::max(1, canvas.height)};
            if (size != state_.subject.settings.size) {
                if (order_.number != 0) moving_until_ = std::max(moving_until_, now_ + resizedAfter);
                change([&](Settings& s) { s.size = size; });
            }
        }
        if (state_.pixel && (state_.pixel->x >= state_.subject.settings.size.width ||
                             state_.pixel->y >= state_.subject.settings.size.height))
            state_.pixel.reset();
        // Repeated changes, as from a slider, count as movement.
        if (order_.subject != state_.subject) {
            if (now_ - changed_ < resizedAfter) moving_until_ = std::max(moving_until_, now_ + stillAfter);
            changed_ = now_;
        }
        const bool moving = now_ < moving_until_ || state_.playing || isHeldMoving();
        if (order_.number != 0 && order_.subject == state_.subject && order_.look == state_.look &&
            order_.moving == moving && order_.pixel == state_.pixel)
            return;
        order_.subject = state_.subject;
        order_.look = state_.look;
        order_.moving = moving;
        order_.pixel = state_.pixel;
        order_.number = drawing_.ask(order_);
        latencies_.asked(order_.number);
    }

    std::vector<std::filesystem::path> otherFiles() const {
        std::vector<std::filesystem::path> files;
        const Settings& settings = state_.subject.settings;
        if (settings.env != "none" && settings.env != "scene") files.emplace_back(settings.env);
        if (settings.lights.ends_with(".json")) files.emplace_back(settings.lights);
        return files;
    }

    void readAgain() {
        ++state_.subject.reading;
        watch_.watch(state_.subject.scene, otherFiles());
    }

    void openScene(const std::string& scene) {
        state_.subject.scene = scene;
        change([](Settings& s) {
            s.camera.clear();
            s.time = 0;
            s.animation.clear();
            s.variant.clear();
        });
        own_camera_ = "none taken yet";
        state_.pixel.reset();
        state_.canvas.zoom = 0;
        readAgain();
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
        handleMouse(input, covered && io.WantCaptureMouse);
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
        if (const double scale = window_.contentScale(); scale != scale_) {
            scale_ = scale;
            setScale(scale);
            makePresenter();  // with fonts of that size
        }
    }

    void handleRequests() {
        InterfaceState::Requests requests = std::exchange(state_.requests, {});
        if (!requests.copy.empty()) {
            window_.copy(requests.copy);
            tell("copied: " + requests.copy);
        }
        if (requests.reload) readAgain();
        if (requests.worst) flyTo(requests.worst->second);
        if (requests.camera) {
            change([&](Settings& s) { s.camera = *requests.camera; });
            own_camera_ = "none taken yet";
        }
    }

    void handleDropped(const Input& input) {
        for (const std::filesystem::path& file : input.dropped) {
            std::string ending = file.extension().string();
            std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return std::tolower(c); });
            if (ending == ".gltf" || ending == ".glb") {
                openScene(file.string());
            } else if (ending == ".exr" && isOurPicture(file)) {
                state_.stored = state_.look.file = file;
                state_.look.against = Against::file;
                tell("left: " + file.string());
            } else if (ending == ".hdr" || ending == ".exr") {
                change([&](Settings& s) { s.env = file.string(); });
                tell("environment: " + file.string());
            } else {
                tell(fmt::format("{}: not a .gltf, .glb, .exr or .hdr file", file.string()));
            }
        }
    }

    // `typing`: a text field has the focus and takes all other keys.
    void press(const KeyDown& key, bool typing) {
        const std::optional<KeyPress> found = actionOf(key.key, key.control);
        if (!found || (typing && found->action != Action::quit && found->action != Action::leave)) return;
        latencies_.pressed(nameOfKey(found->action), order_.number);
        act(*found, key.shift);
    }

    static std::string_view nameOfKey(Action action) {
        for (const KeyBinding& binding : keyBindings())
            if (binding.action == action) return binding.name;
        return {};
    }

    void act(const KeyPress& pressed, bool shift) {
        if (const auto message = actOnState(pressed, shift, contents_, state_)) {
            if (!message->empty()) tell(*message);
            return;
        }
        switch (pressed.action) {
            case Action::zoom:
                if (state_.canvas.zoom > 0)
                    state_.canvas.zoom = 0;
                else
                    flyTo(contents_.under ? contents_.under->pixel
                                          : PixelPlace{state_.subject.settings.size.width / 2,
                                                       state_.subject.settings.size.height / 2},
                          zoomed);
                break;
            case Action::worst_pixel:
                worstPixel();
                break;
            case Action::next_camera:
                nextCamera();
                break;
            case Action::screenshot:
                drawing_.save(options_.out.empty() ? "." : options_.out);
                tell("writing both paths, all channels");
                break;
            case Action::reload:
                readAgain();
                break;
            case Action::copy_command:
                state_.requests.copy = renderCommand(state_);
                handleRequests();
                break;
            case Action::full_screen:
                window_.toggleFullScreen();
                break;
            case Action::leave:
                leave();
                break;
            case Action::quit:
                quit_ = true;
                break;
            default:  // held keys
                if (pressed.action != Action::flicker && !camera_.canMove() && contents_.shown)
                    tell("this camera is orthographic and cannot move: press N for another camera");
        }
    }

    void leave() {
        flight_.stop();
        if (state_.help)
            state_.help = false;
        else if (state_.canvas.zoom > 0)
            state_.canvas.zoom = 0;
        else if (state_.pixel)
            state_.pixel.reset();
        else if (window_.isFullScreen())
            window_.toggleFullScreen();
    }

    void nextCamera() {
        const std::size_t count = contents_.facts ? contents_.facts->cameras.size() : 0;
        const std::string& now = state_.subject.settings.camera;
        std::size_t next = 0;
        if (now.empty() && count > 1)
            next = 1;  // the first is the current one
        else if (!now.empty() && now.find('=') == now.npos)
            next = (static_cast<std::size_t>(std::atoi(now.c_str())) + 1) % std::max<std::size_t>(count, 1);
        const std::string words = count == 0 ? "" : std::to_string(next);
        change([&](Settings& s) { s.camera = words; });
        own_camera_ = "none taken yet";
        tell(count == 0 ? "the default view: this scene has no camera"
                        : fmt::format("camera {} {}", next, contents_.facts->cameras[next]));
    }

    void worstPixel() {
        if (!contents_.judged || contents_.judged->subject != ofBothPaths(state_.subject))
            return tell("no verdict for this view yet");
        for (const Comparison& comparison : contents_.judged->report.comparisons)
            for (const ChannelDiff& channel : comparison.channels)
                if (channel.mode->number == state_.look.channel() && channel.stats.worst_x >= 0)
                    return flyTo({channel.stats.worst_x, channel.stats.worst_y});
        tell(fmt::format("no pixel of {} differs", debugMode(state_.look.channel()).name));
    }

    // ---- moving ---------------------------------------------------------------------------------------

    void moved() {
        moving_until_ = now_ + stillAfter;
        own_camera_ = camera_.words();
        change([&](Settings& s) { s.camera = own_camera_; });
    }

    void move() {
        if (!isHeldMoving()) {
            held_ = false;
            return;
        }
        const double seconds = std::min(now_ - last_, 0.1),
                     by = state_.speed * camera_.reach() * std::min(seconds, held_ ? 1.0 : movingPause);
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
        const double duration = contents_.facts ? contents_.facts->duration : 0;
        if (!(duration > 0)) {
            state_.playing = false;
            return;
        }
        const double time = std::fmod(state_.subject.settings.time + std::min(now_ - last_, 0.25), duration);
        change([&](Settings& s) { s.time = time; });
    }

    void flyTo(const PixelPlace& pixel, std::optional<double> wanted = {}) {
        flight_.begin(now_, state_.canvas, canvasOf(state_, width_, height_, scale_),
                      state_.subject.settings.size, pixel, wanted.value_or(flown) * scale_);
    }

    double wipePlace(const CanvasRect& canvas) const {
        return canvas.x + static_cast<double>(std::lround(state_.canvas.wipe * canvas.width));
    }

    void handleMouse(const Input& input, bool taken) {
        const CanvasRect canvas = canvasOf(state_, width_, height_, scale_);
        const std::vector<PanelPlace> places = placesNow(canvas);
        for (const Input::Button& button : input.buttons) {
            if (!button.down) {
                if (button.button != GLFW_MOUSE_BUTTON_LEFT) continue;
                // A quick drag begins and ends between two frames.
                drag(canvas, places, button.x, button.y);
                drag_ = Drag::none;
                continue;
            }
            if (taken || !canvas.contains(button.x, button.y)) continue;
            if (button.button == GLFW_MOUSE_BUTTON_RIGHT) {
                if (const auto under = pixelUnder(places, state_.subject.settings.size, button.x, button.y)) {
                    state_.pixel = under->pixel;
                    state_.open = Tab::pixel;
                    contents_.under = under;
                    say("pixel " + underWords(contents_));
                }
            } else if (button.button == GLFW_MOUSE_BUTTON_LEFT) {
                const bool wipes = state_.canvas.layout == Layout::wipe &&
                                   state_.look.difference == Difference::none &&
                                   std::abs(button.x - wipePlace(canvas)) <= wipeReach * scale_;
                drag_ = wipes ? Drag::wipe : state_.canvas.zoom > 0 ? Drag::picture : Drag::look;
                pivot_ = pivotAt(places, button.x, button.y);
                cursor_x_ = button.x;
                cursor_y_ = button.y;
            }
        }
        drag(canvas, places, input.x, input.y);
        if (input.wheel != 0 && !taken && canvas.contains(input.x, input.y)) wheel(input, places);
        contents_.under = canvas.contains(input.x, input.y) && !taken
                              ? pixelUnder(places, state_.subject.settings.size, input.x, input.y)
                              : std::nullopt;
    }

    // The cursor moved.
    void drag(const CanvasRect& canvas, const std::vector<PanelPlace>& places, double x, double y) {
        const double dx = x - cursor_x_, dy = y - cursor_y_;
        cursor_x_ = x;
        cursor_y_ = y;
        if (drag_ != Drag::none && (dx != 0 || dy != 0)) dragged(canvas, places, dx, dy);
    }

    void dragged(const CanvasRect& canvas, const std::vector<PanelPlace>& places, double dx, double dy) {
        switch (drag_) {
            case Drag::none:
                return;
            case Drag::wipe:
                state_.canvas.wipe = std::clamp((cursor_x_ - canvas.x) / canvas.width, 0.0, 1.0);
                return;
            case Drag::picture:
                state_.canvas.centre_x -= dx / state_.canvas.zoom;
                state_.canvas.centre_y -= dy / state_.canvas.zoom;
                return;
            case Drag::look: {
                if (!camera_.canMove() || !contents_.shown || places.empty()) return;
                // As if the image were dragged: its height is the field of view.
                const double tall = state_.subject.settings.size.height * places.front().placement.scale;
                const double angle =
                    contents_.shown->camera.fov_degrees * std::numbers::pi / 180 / std::max(tall, 1.0);
                if (state_.orbiting)
                    camera_.orbit(pivot_, 2 * dx * angle, -2 * dy * angle);
                else
                    camera_.look(dx * angle, -dy * angle);
                moved();
                return;
            }
        }
    }

    void wheel(const Input& input, const std::vector<PanelPlace>& places) {
        if (state_.canvas.zoom > 0) {
            const auto under = pixelUnder(places, state_.subject.settings.size, input.x, input.y);
            const double before = state_.canvas.zoom;
            state_.canvas.zoom =
                std::clamp(std::round(before * std::exp2(0.5 * input.wheel)), least_zoom, most_zoom);
            if (state_.canvas.zoom == before && input.wheel > 0)
                state_.canvas.zoom = std::min(before + 1, most_zoom);
            if (!under || places.empty()) return;
            // The point under the cursor stays there.
            const double x = under->pixel.x + 0.5, y = under->pixel.y + 0.5,
                         ratio = before / state_.canvas.zoom;
            state_.canvas.centre_x = x + (state_.canvas.centre_x - x) * ratio;
            state_.canvas.centre_y = y + (state_.canvas.centre_y - y) * ratio;
            return;
        }
        state_.speed = std::clamp(state_.speed * std::exp2(0.5 * input.wheel), 1e-4, 1e4);
        tell(fmt::format("speed {:.3g} m/s", state_.speed * camera_.reach()));
    }

    // The world position of the pixel, once this view is rendered at full size; else the camera's target.
    glm::dvec3 pivotAt(const std::vector<PanelPlace>& places, double x, double y) const {
        const glm::dvec3 ahead = camera_.eye() + camera_.forward() * camera_.reach();
        const auto under = pixelUnder(places, state_.subject.settings.size, x, y);
        const std::shared_ptr<const Shown>& shown = contents_.shown;
        if (!under || !shown || shown->depth.empty() ||
            ofBothPaths(shown->order.subject) != ofBothPaths(state_.subject))
            return ahead;
        return seenAt(shown->view, shown->depth, under->pixel).value_or(ahead);
    }

    // ---- drawing the window ---------------------------------------------------------------------------

    std::vector<PanelPlace> placesNow(const CanvasRect& canvas) const {
        return placesOf(canvas, state_.subject.settings.size, state_.canvas,
                        state_.look.difference != Difference::none);
    }

    void makePresenter() {
        presenter_.reset();
        presenter_ =
            std::make_unique<Presenter>(window_.handle(), options_.device.validate ? &log_ : nullptr);
        composed_ = {};
        contents_.shown_by = presenter_->device();
    }

    void frame() {
        contents_.history = &histories_.at(!contents_.shown || isWhole(*contents_.shown));
        contents_.interface_ms = latencies_.percentile();
        contents_.drawn_by = drawing_.device();
        const CanvasRect canvas = canvasOf(state_, width_, height_, scale_);
        const std::vector<PanelPlace> places = placesNow(canvas);
        presenter_->beginFrame();
        ImGui_ImplGlfw_NewFrame();
        ImGui::NewFrame();
        drawInterface(state_, contents_, canvas, places, scale_);
        ImGui::Render();
        compose(canvas, places);
        if (!presenter_->show(pixels_, ImGui::GetDrawData())) {
            if (++presenters_ > mostPresenters)
                throw std::runtime_error(
                    "view: the device that shows the window was lost several times; try another --device");
            say("the device that shows the window was lost and is started again");
            makePresenter();
        } else {
            presenters_ = 0;
        }
        setTitle();
        if (contents_.shown) latencies_.seen(*contents_.shown, order_.number);
    }

    void setTitle() {
        window_.setTitle(fmt::format("Diptych - {} - {}",
                                     contents_.facts ? contents_.facts->name : state_.subject.scene,
                                     debugMode(state_.look.channel()).name));
    }

    // Identifies the content of the window's pixels.
    struct Composed {
        std::shared_ptr<const Shown> shown;
        CanvasRect canvas;
        CanvasView view;
        bool difference = false;
        bool operator==(const Composed&) const = default;
    };

    void compose(const CanvasRect& canvas, const std::vector<PanelPlace>& places) {
        const Composed now{contents_.shown, canvas, state_.canvas,
                           state_.look.difference != Difference::none};
        if (!now.shown || now == composed_) return;
        composed_ = now;
        pixels_.x = canvas.x;
        pixels_.y = canvas.y;
        pixels_.width = canvas.width;
        pixels_.height = canvas.height;
        pixels_.data = composed(*now.shown, canvas, places, presenter_->isBgr());
        ++pixels_.version;
    }

    const ViewerOptions& options_;
    const Clock::time_point begun_ = Clock::now();
    InterfaceState state_;
    Window window_;
    ImGuiContextOf imgui_;
    ValidationLog log_;
    std::unique_ptr<Presenter> presenter_;
    int presenters_ = 0;
    DrawingThread drawing_;
    Contents contents_;
    std::array<std::array<History, 2>, 2> histories_;  // of reduced images, of full ones
    FlyCamera camera_;
    std::string own_camera_ = "none taken yet";  // --camera text of camera_
    SceneWatch watch_;
    Order order_;                                                 // the latest request
    std::uint64_t said_still_ = 0;                                // the last request reported as complete
    double now_ = 0, last_ = 0, moving_until_ = 0, watched_ = 0;  // s since begun_
    double changed_ = -1;                                         // time of the last change of the subject
    double scale_ = 1;
    int width_ = 0, height_ = 0, frames_left_ = 3;
    bool quit_ = false, held_ = false;
    Drag drag_ = Drag::none;
    glm::dvec3 pivot_{0};
    double cursor_x_ = 0, cursor_y_ = 0;
    ZoomFlight flight_;
    WindowPixels pixels_;
    Composed composed_;
    Latencies latencies_{[this](const std::string& line) { say(line); }, begun_};
};

}  // namespace

ViewerResult runViewer(const ViewerOptions& options) {
    return Viewer(options).run();
}

}  // namespace diptych::viewer
