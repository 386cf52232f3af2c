// SPDX-License-Identifier: MIT
#include "compare/viewer/drawing_thread.h"

#include "compare/explain/pixel_words.h"
#include "compare/files/frame_exr.h"
#include "compare/render/frame_facts.h"
#include "compare/render/path_plan.h"
#include "compare/render/renderer.h"
#include "compare/render/shown_scene.h"
#include "compare/report/frame_files.h"
#include "compare/verdict/pair_reports.h"
#include "compare/viewer/facts.h"
#include "compare/viewer/picture_cost.h"
#include "compare/viewer/pictures.h"
#include "compare/viewer/reference_thread.h"
#include "shared/frame/made_channels.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <numeric>
#include <span>
#include <thread>
#include <utility>
#include <vector>

namespace diptych::viewer {
namespace {

using Clock = std::chrono::steady_clock;

constexpr auto lit = static_cast<int>(gpu::DEBUG_lit), depthMode = static_cast<int>(gpu::DEBUG_depth),
               ids = static_cast<int>(gpu::DEBUG_material_id);

// Target for rendering both paths while moving, ms. With the host's work that gives about 15 images a
// second, and a key takes effect within two of them.
constexpr double movingMs = 40;
constexpr int leastShadowSize = 256;  // texels, while moving
// A still image that takes longer is preceded by a smaller one.
constexpr double patienceMs = 250;
// Interval between updates of the reference.
constexpr std::chrono::milliseconds referencePause{200};
// Number of consecutive recoveries from a lost device before giving up until the next request.
constexpr int mostRecoveries = 3;

double msSince(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

// Aborts work that is no longer needed.
struct Superseded {};

std::vector<int> everyChannel() {
    std::vector<int> modes;
    for (const DebugMode& mode : debugModes()) modes.push_back(mode.number);
    return modes;
}

// While moving, unlit pixels count as background, because timed pipelines write only light. The depth
// becomes 1 or 0, for coverage().
void guessBackground(Frame& frame) {
    const Image& light = frame.channels.at(lit);
    Image near(light.width, light.height, 1);
    for (std::size_t i = 0; i < light.pixels(); ++i)
        near.pixel(i)[0] =
            std::any_of(light.pixel(i), light.pixel(i) + light.components, [](float v) { return v != 0; })
                ? 1.0f
                : 0.0f;
    frame.channels[depthMode] = std::move(near);
}

}  // namespace

struct DrawingThread::State {
    explicit State(DrawingOptions o)
        : options(std::move(o)),
          reference([this] {
              {
                  const std::lock_guard lock(mutex);
                  more_of_reference = true;
              }
              signal.notify_all();
          }),
          progress(
              [this](const std::string&, double fraction, const std::string& step) { at(fraction, step); }),
          comparing(
              [this](const std::string&, double fraction, const std::string& step) { note(fraction, step); }),
          thread([this] { run(); }) {}
    ~State() {
        {
            const std::lock_guard lock(mutex);
            stopping = true;
        }
        signal.notify_all();
        thread.join();
    }

    // ---- shared with the interface, under `mutex` -----------------------------------------------------

    const DrawingOptions options;
    mutable std::mutex mutex;
    std::condition_variable signal;
    bool stopping = false;
    std::optional<Order> wanted;
    std::optional<std::filesystem::path> save_to;
    std::string saved;
    std::shared_ptr<const Shown> shown;
    std::shared_ptr<const Judged> judged;
    std::shared_ptr<const Breakdown> breakdown;
    std::shared_ptr<const SceneFacts> facts;
    Status status;
    bool waiting = false;
    std::string device_name;
    std::uint64_t validation_messages = 0;
    std::string first_validation_message;

    // ---- used by the drawing thread alone -------------------------------------------------------------

    Order order;   // the current request
    Subject both;  // the same, independent of the right panel's path
    std::atomic<bool> more_of_reference{false};
    std::optional<Device> device;
    std::shared_ptr<PipelineSet> pipelines;
    std::shared_ptr<const Scene> scene;
    std::string scene_error;        // why the last requested scene is not shown
    std::optional<Subject> loaded;  // scene, reading and environment that were loaded, or failed to load
    std::unique_ptr<SceneViews> views;
    std::unique_ptr<Renderer> renderer;
    // Deferred, forward+, of `drawn`; those of a verdict point into its report.
    std::array<std::shared_ptr<const Frame>, 2> frames;
    std::optional<Subject> drawn;  // still and at full size
    std::vector<int> drawn_channels;
    std::optional<std::uint64_t> shown_order, failed_order;
    std::optional<Subject> timed, judged_of;
    Against judged_against = Against::paths;
    std::optional<std::pair<Subject, PixelPlace>> broken_down;
    std::optional<std::pair<std::filesystem::path, std::shared_ptr<const Frame>>> stored;
    std::array<PathFacts, 2> paths;
    PictureCost cost;                  // of moving images, once their pipelines exist
    std::size_t compiled = 0;          // number of pipelines after the last image
    std::optional<Exposure> exposure;  // of the last still image
    Look exposure_of;
    Clock::time_point reference_shown{};
    int recoveries = 0;
    std::uint64_t of_lost_devices = 0;  // messages of the validation layers
    bool loading = false;
    std::shared_ptr<const Scene> reference_scene;  // the reference's scene
    ReferenceThread reference;
    Progress progress;   // throws Superseded if the work is no longer needed
    Progress comparing;  // of parallel work and of reading a scene, which always finish
    std::thread thread;

    // ---- the loop -------------------------------------------------------------------------------------

    void run() {
        yieldToInterface();
        while (next()) {
            try {
                work();
                countMessages();
                recoveries = 0;
            } catch (const Superseded&) {
            } catch (const std::bad_alloc&) {
                fail("out of memory; try a smaller size");
            } catch (const std::exception& error) {
                if (!recovered(error.what())) fail(error.what());
            }
        }
        reference.stop();
        dropRenderer();
        device.reset();
    }

    // Waits for work; false: stop.
    bool next() {
        std::unique_lock lock(mutex);
        for (;;) {
            if (stopping) return false;
            if (wanted && wanted->number != order.number) {
                order = *wanted;
                both = ofBothPaths(order.subject);
            }
            if (save_to || (order.number != 0 && hasWork())) {
                waiting = false;
                return true;
            }
            // A reference in progress is part of the request.
            waiting = !drawsReference();
            status.doing.clear();
            if (more_of_reference && order.look.against == Against::reference && !order.moving) {
                // Shows partial references at intervals.
                signal.wait_until(lock, reference_shown + referencePause);
            } else {
                options.wake();
                signal.wait(lock);
            }
        }
    }

    bool drawsReference() const {
        return order.look.against == Against::reference && !order.moving && shown_order == order.number &&
               failed_order != order.number && reference.done() < 1;
    }
    bool hasWork() const {
        if (failed_order == order.number) return false;
        if (shown_order != order.number) return true;
        if (order.moving) return false;
        return wantsReferenceShown() || wantsTimes() || wantsVerdict() || wantsBreakdown();
    }
    bool wantsReferenceShown() const {
        return order.look.against == Against::reference && more_of_reference &&
               (reference.done() >= 1 || Clock::now() >= reference_shown + referencePause);
    }
    // Whether the reference in progress belongs to this view.
    bool wantsReference() const {
        return order.look.against == Against::reference && !order.moving &&
               reference.settings() == referenceSettings(order.subject.settings);
    }
    // Not while the reference uses all cores.
    bool wantsTimes() const { return timed != both && !drawsReference(); }
    // The baseline of the verdict: the reference once it is finished.
    Against judgedAgainst() const {
        return order.look.against == Against::reference && reference.done() < 1 ? Against::paths
                                                                                : order.look.against;
    }
    bool wantsVerdict() const { return judged_of != both || judged_against != judgedAgainst(); }
    bool wantsBreakdown() const { return order.pixel && broken_down != std::pair(both, *order.pixel); }

    // One step; the most urgent first.
    void work() {
        if (const auto folder = takeSave()) return write(*folder);
        if (reference.done() < 1 && !wantsReference()) reference.stop();
        readScene();
        needRenderer();
        if (shown_order != order.number) {
            if (!order.moving) drawSmallerFirst();
            return draw(order.subject.settings.size);
        }
        if (wantsReferenceShown()) return draw(order.subject.settings.size);
        if (wantsBreakdown()) return breakDown();
        if (wantsTimes()) return time();
        if (wantsVerdict()) return judge();
    }

    bool isSuperseded() const {
        const std::lock_guard lock(mutex);
        return stopping || (wanted && wanted->number != order.number);
    }
    void heed() const {
        if (isSuperseded()) throw Superseded();
    }
    void at(double fraction, const std::string& step) {
        heed();
        note(fraction, step);
    }
    void note(double fraction, const std::string& step) {
        {
            const std::lock_guard lock(mutex);
            status.fraction = fraction;
            status.doing = step;
        }
        options.wake();
    }
    Stage stage(const char* what) { return {progress, what}; }

    void fail(const std::string& why) {
        failed_order = order.number;
        {
            const std::lock_guard lock(mutex);
            status.error = why;
            status.doing.clear();
            status.loading = false;
        }
        options.wake();
    }

    // ---- device and scene -----------------------------------------------------------------------------

    void dropRenderer() {
        renderer.reset();
        views.reset();
        pipelines.reset();
    }

    // Counts validation messages of all devices so far.
    void countMessages() {
        if (!device || device->validationMessages() == 0) return;
        const std::lock_guard lock(mutex);
        if (validation_messages == 0) first_validation_message = device->firstValidationMessage();
        validation_messages = of_lost_devices + device->validationMessages();
    }

    void needDevice() {
        if (device) return;
        at(0, "starting the device");
        device.emplace(options.device);
        const std::lock_guard lock(mutex);
        device_name = device->info().name;
    }

    void needRenderer() {
        needDevice();
        if (renderer) return;
        at(0, "upload");
        pipelines = makePipelineSet(*device);
        views = std::make_unique<SceneViews>(*scene);
        renderer = std::make_unique<Renderer>(*device, *views, pipelines);
        drawn.reset();
        timed.reset();
    }

    // Recreates a lost device; false if there was no loss, or too many.
    bool recovered(const std::string& why) {
        const bool lost = why.find("lost") != std::string::npos;
        if (!lost || ++recoveries > mostRecoveries) return false;
        countMessages();
        of_lost_devices = validation_messages;
        dropRenderer();
        device.reset();
        const std::lock_guard lock(mutex);
        status.error = why + "; restarting the device";
        return true;
    }

    bool isLoaded(const Subject& subject) const {
        return loaded && loaded->scene == subject.scene && loaded->reading == subject.reading &&
               loaded->settings.env == subject.settings.env &&
               loaded->settings.variant == subject.settings.variant;
    }

    // If a scene cannot be read, the previous one stays.
    void readScene() {
        if (isLoaded(order.subject)) {
            if (!scene) throw std::runtime_error(scene_error);
            return;
        }
        {
            const std::lock_guard lock(mutex);
            status.loading = true;
        }
        const Subject asked = order.subject;
        std::shared_ptr<const Scene> read;
        try {
            read = std::make_shared<const Scene>(
                loadShown(asked.scene, asked.settings, Stage(comparing, "load")));
        } catch (const std::runtime_error& error) {
            loaded = asked;
            scene_error = error.what();
            throw;
        }
        scene_error.clear();
        reference.stop();
        dropRenderer();
        scene = std::move(read);
        loaded = asked;
        auto known = std::make_shared<SceneFacts>(factsOf(*scene, asked.scene));
        {
            const std::lock_guard lock(mutex);
            facts = std::move(known);
            status.loading = false;
            status.error.clear();
        }
        drawn.reset();
        judged_of.reset();
        paths = {};
    }

    // ---- images ---------------------------------------------------------------------------------------

    Settings settingsOf(Path path, const Size& size) const {
        const Size& full = order.subject.settings.size;
        Settings settings = order.subject.sides.of(withoutReference(order.subject.settings), path);
        settings.size = size;
        // The cost of shadow maps does not depend on the image size, so they shrink with it.
        settings.shadow_size = std::max(std::min(settings.shadow_size, leastShadowSize),
                                        settings.shadow_size * size.width / std::max(1, full.width));
        if (const auto problem = settings.problem()) throw std::runtime_error(*problem);
        return settings;
    }

    // Views of intermediate cameras are not needed again.
    void forgetViews() { views->clear(); }

    // Renders lit alone by the timed pipelines: nothing is compiled for it, and little is read back.
    std::array<Frame, 2> drawLit(const Size& size) {
        const std::array settings{settingsOf(drawn_paths[0], size), settingsOf(drawn_paths[1], size)};
        PreparedFrames prepared = renderer->prepare(settings);
        std::array<Frame, 2> result;
        for (std::size_t i = 0; i < 2; ++i) {
            Frame& frame = result.at(i);
            frame = prepared.described(i);
            frame.passes = prepared.profile(i);
            frame.time.median =
                std::accumulate(frame.passes.begin(), frame.passes.end(), 0.0,
                                [](double sum, const PassTime& pass) { return sum + pass.ms; });
            frame.channels[lit] = prepared.lit(i);
            if (auto repaired = repairNonfinite(frame.channels[lit]); !repaired.empty()) {
                frame.counters.nonfinite_pixels = repaired.size();
                frame.repaired[lit] = std::move(repaired);
            }
            prepared.readCounters(i, frame.counters);
            guessBackground(frame);
        }
        return result;
    }

    RenderOptions channelOptions(std::vector<int> channels) {
        RenderOptions render;
        render.channels = std::move(channels);
        for (const int helper : {lit, ids, depthMode})
            if (std::ranges::count(render.channels, helper) == 0) render.channels.push_back(helper);
        render.runs = 0;
        return render;
    }

    // A moving image always finishes; otherwise the next request would abort every one.
    std::array<Frame, 2> drawChannels(const Size& size, const std::vector<int>& channels, bool passing) {
        RenderOptions render = channelOptions(channels);
        std::array<Frame, 2> result;
        for (std::size_t i = 0; i < 2; ++i) {
            render.progress = Stage(passing ? comparing : progress, "draw")
                                  .part(0.5 * static_cast<double>(i), 0.5 * static_cast<double>(i + 1));
            result.at(i) = renderer->draw(settingsOf(drawn_paths.at(i), size), render);
        }
        return result;
    }

    void takeFacts(const std::array<const Frame*, 2>& of, bool timed_too) {
        for (std::size_t i = 0; i < 2; ++i) viewer::takeFacts(*of.at(i), timed_too, paths.at(i));
    }

    // Shows a smaller image first if a still one takes long.
    void drawSmallerFirst() {
        const Size full = order.subject.settings.size;
        if (drawn == both) return;
        if (cost.known() && cost.of(double(full.width) * full.height) < patienceMs) return;
        const Size small = movingSize(full, movingMs, cost);
        drawAt(small, true);
    }

    void draw(const Size& full) {
        if (order.moving) return drawAt(movingSize(full, movingMs, cost), true);
        drawAt(full, false);
    }

    bool has(const std::vector<int>& channels) const {
        return std::ranges::all_of(channels,
                                   [&](int mode) { return std::ranges::count(drawn_channels, mode) > 0; });
    }

    void drawAt(const Size& size, bool passing) {
        const auto start = Clock::now();
        if (options.before_picture) options.before_picture();
        forgetViews();
        const int mode = order.look.channel();
        std::array<Frame, 2> passed;
        const bool known = !passing && drawn == both && has({mode});
        if (passing)
            passed = mode == lit ? drawLit(size) : drawChannels(size, {mode}, true);
        else if (!known) {
            std::array<Frame, 2> whole = drawChannels(size, {mode}, false);
            for (std::size_t i = 0; i < 2; ++i)
                frames.at(i) = std::make_shared<const Frame>(std::move(whole.at(i)));
            drawn = both;
            drawn_channels = {mode, lit, ids, depthMode};
        }
        const std::array<const Frame*, 2> now{passing ? &passed[0] : frames[0].get(),
                                              passing ? &passed[1] : frames[1].get()};
        if (!known) {
            // The first frame of each pipeline includes compilation, so it is ignored. Like timed frames,
            // this excludes the host's own work.
            const double frames_ms = now[0]->time.median + now[1]->time.median;
            if (passing && compiled == renderer->pipelines())
                cost.add(double(size.width) * size.height, frames_ms > 0 ? frames_ms : msSince(start));
            compiled = renderer->pipelines();
            takeFacts(now, passing && mode == lit);
        }
        show(now, size, passing, start);
    }

    // The left panel's Frame; nullptr if that is the other path's.
    std::shared_ptr<const Frame> leftFrame(bool passing, const Frame& under, Shown& into) {
        if (order.look.against == Against::file) return storedFrame();
        if (order.look.against != Against::reference || passing) return nullptr;
        Settings wanted_settings = referenceSettings(order.subject.settings);
        if (const auto problem = wanted_settings.problem()) throw std::runtime_error(*problem);
        if (reference.settings() != wanted_settings || reference_scene != scene) {
            reference_scene = scene;
            std::optional<Frame> surfaces;
            if (wanted_settings.reference_mode == ReferenceMode::surface) {
                RenderOptions capture;
                capture.channels =
                    reference::surfaceChannels(views->at(viewRequest(wanted_settings)).needs.layers);
                capture.runs = 0;
                capture.progress = stage("the reference's surfaces");
                surfaces = renderer->draw(surfaceSettings(wanted_settings), capture);
            }
            reference.begin(scene, wanted_settings, std::move(surfaces));
        }
        more_of_reference = false;
        reference_shown = Clock::now();
        if (const std::string error = reference.error(); !error.empty()) throw std::runtime_error(error);
        into.reference_done = reference.done();
        return reference.frame({lit, ids, depthMode, order.look.channel()}, &under.channels.at(lit));
    }

    std::shared_ptr<const Frame> storedFrame() {
        if (!stored || stored->first != order.look.file)
            stored.emplace(order.look.file, std::make_shared<const Frame>(frameFromExr(order.look.file)));
        return stored->second;
    }

    void show(const std::array<const Frame*, 2>& now, const Size& size, bool passing,
              Clock::time_point start) {
        auto next = std::make_shared<Shown>();
        next->order = order;
        next->size = size;
        const std::size_t right = order.subject.settings.path == drawn_paths[0] ? 0 : 1;
        const std::shared_ptr<const Frame> left = leftFrame(passing, *now.at(right), *next);
        const Frame& baseline = left ? *left : *now.at(1 - right);
        // Recomputing the exposure for every smaller image would flicker.
        if (!passing || !exposure || exposure_of.picture().exposure != order.look.exposure ||
            exposure_of.ev100 != order.look.ev100 || exposure_of.tonemap != order.look.tonemap) {
            exposure = exposureOf(*now.at(1 - right), *now.at(right), order.look);
            exposure_of = order.look;
        }
        makePictures(baseline, *now.at(right), order.look, *exposure, *next);
        if (left && next->reference_done < 1 && order.look.against == Against::reference)
            next->panels[0].name = fmt::format("reference, {:.0f} % drawn over {}",
                                               100 * next->reference_done, next->panels[1].name);
        const SceneView& view = views->at(viewRequest(now.at(right)->settings));
        next->camera = cameraOf(view.view);
        next->view = view.view;
        next->lights = view.lights;
        next->plan = planLines(view, order.subject.settings);
        if (!passing) next->depth = now.at(right)->channels.at(depthMode);
        next->paths = paths;
        next->made_in_ms = msSince(start);
        {
            const std::lock_guard lock(mutex);
            shown = std::move(next);
            status.error = scene_error;  // until a scene is read
        }
        if (!passing || order.moving) shown_order = order.number;
        options.wake();
    }

    // ---- results beside a still image -----------------------------------------------------------------

    void time() {
        const std::array settings{settingsOf(drawn_paths[0], order.subject.settings.size),
                                  settingsOf(drawn_paths[1], order.subject.settings.size)};
        RenderOptions render;
        render.runs = 3;
        render.progress = stage("time");
        const std::vector<TimedFrame> times = renderer->time(settings, render);
        for (std::size_t i = 0; i < 2; ++i) {
            paths.at(i).ms = times.at(i).time.median;
            paths.at(i).passes = times.at(i).passes;
            ++paths.at(i).measurement;
        }
        cost.add(double(settings[0].size.width) * settings[0].size.height, paths[0].ms + paths[1].ms);
        timed = both;
        auto next = std::make_shared<Shown>(*shown);
        next->paths = paths;
        const std::lock_guard lock(mutex);
        shown = std::move(next);
    }

    // Both paths with every channel.
    std::vector<Frame> judgedFrames(const std::array<Settings, 2>& settings) {
        RenderOptions render = channelOptions(everyChannel());
        render.requested = everyChannel();
        render =
            judgedOptions(std::move(render), settings,
                          order.subject.settings.reference_mode == ReferenceMode::scene, false, Twice::none);
        std::vector<Frame> pair;
        for (std::size_t i = 0; i < 2; ++i) {
            if (judged_of == both && drawn == both && has(everyChannel())) {
                pair.push_back(*frames.at(i));  // only the baseline changed
                continue;
            }
            render.progress =
                stage("verdict").part(0.4 * static_cast<double>(i), 0.4 * static_cast<double>(i + 1));
            pair.push_back(renderer->draw(settings.at(i), render));
        }
        return pair;
    }

    Report judgedReport(std::vector<Frame> pair, Against against, const CompareOptions& compare) {
        const Requirements& needs = views->at(viewRequest(pair[0].settings)).needs;
        const ReportDevice here = reportDevice(*device);
        if (against == Against::reference) {
            std::vector<Frame> three{*reference.frame({}, nullptr)};
            std::ranges::move(pair, std::back_inserter(three));
            std::vector<std::string> materials;
            for (const Material& material : scene->materials) materials.push_back(material.name);
            return makeReferenceReport(std::move(three), {needs, needs, needs}, here, compare, {{}},
                                       {materials});
        }
        if (against == Against::file) {
            Frame baseline = *storedFrame();
            baseline.requested = pair[0].requested;
            return makeBaselineReport(std::move(baseline), std::move(pair), needs, here, compare, {});
        }
        return makeReport(std::move(pair), {needs, needs}, here, compare, {});
    }

    void judge() {
        const Size& size = order.subject.settings.size;
        const std::array settings{settingsOf(drawn_paths[0], size), settingsOf(drawn_paths[1], size)};
        std::vector<Frame> pair = judgedFrames(settings);
        auto next = std::make_shared<Judged>();
        next->subject = both;
        CompareOptions compare = options.compare;
        compare.light_differs = lightDifferences(settings[0], settings[1]);
        compare.progress = Stage(comparing, "verdict").part(0.8, 1);
        heed();
        const Against against = judgedAgainst();
        next->report = judgedReport(std::move(pair), against, compare);
        judged_of = both;
        judged_against = against;
        // Every channel exists from now on.
        for (std::size_t i = 0; i < 2; ++i)
            for (const Frame& frame : next->report.frames)
                if (frame.settings.path == drawn_paths.at(i))
                    frames.at(i) = std::shared_ptr<const Frame>(next, &frame);
        drawn = both;
        drawn_channels = everyChannel();
        takeFacts({frames[0].get(), frames[1].get()}, false);
        auto again = std::make_shared<Shown>(*shown);
        again->paths = paths;
        {
            const std::lock_guard lock(mutex);
            judged = std::move(next);
            shown = std::move(again);
        }
        options.wake();
    }

    void breakDown() {
        const Settings& settings = order.subject.settings;
        PixelQuery query{.x = order.pixel->x,
                         .y = order.pixel->y,
                         .baseline = settingsOf(drawn_paths[0], settings.size),
                         .test = settingsOf(drawn_paths[1], settings.size),
                         .reference = referenceSettings(settings),
                         .device = reportDevice(*device),
                         .rules = options.compare.rules,
                         .light_differs = {},
                         .progress = stage("this pixel")};
        query.light_differs = lightDifferences(query.baseline, query.test);
        auto next = std::make_shared<Breakdown>(
            Breakdown{both, *order.pixel, pixelBreakdown(*renderer, *views, query), {}});
        next->words = inWords(next->breakdown);
        broken_down = std::pair(both, *order.pixel);
        const std::lock_guard lock(mutex);
        breakdown = std::move(next);
    }

    // ---- files ----------------------------------------------------------------------------------------

    std::optional<std::filesystem::path> takeSave() {
        const std::lock_guard lock(mutex);
        return std::exchange(save_to, std::nullopt);
    }

    void write(const std::filesystem::path& folder) {
        std::string line;
        try {
            readScene();
            needRenderer();
            forgetViews();
            RenderOptions render = channelOptions(everyChannel());
            render.requested = everyChannel();
            std::filesystem::create_directories(folder);
            std::filesystem::path stem;
            for (int number = 1; stem.empty() || std::filesystem::exists(stem.string() + ".deferred.exr");
                 ++number)
                stem = folder / fmt::format("diptych-view-{:04}", number);
            const ReportDevice made = reportDevice(*device);
            const DebugMode& mode = debugMode(order.look.channel());
            for (const Path path : drawn_paths) {
                const Frame frame = renderer->draw(settingsOf(path, order.subject.settings.size), render);
                const std::string name = fmt::format("{}.{}", stem.string(), nameOf(path));
                writeFrame(frame, made, {OutputKind::exr, name + ".exr"}, {&mode}, order.look.picture());
                if (frame.channels.contains(mode.number))
                    writeFrame(frame, made, {OutputKind::png, name + ".png"}, {&mode}, order.look.picture());
            }
            line = fmt::format("written: {}.*, .exr and .png of both paths", stem.string());
        } catch (const Superseded&) {
            // A newer request comes first.
            const std::lock_guard lock(mutex);
            if (!save_to) save_to = folder;
            throw;
        } catch (const std::exception& error) {
            line = fmt::format("not written: {}", error.what());
        }
        {
            const std::lock_guard lock(mutex);
            saved = line;
        }
        options.wake();
    }
};

DrawingThread::DrawingThread(DrawingOptions options) : state_(std::make_unique<State>(std::move(options))) {}
DrawingThread::~DrawingThread() = default;

std::uint64_t DrawingThread::ask(Order order) {
    std::uint64_t number = 0;
    {
        const std::lock_guard lock(state_->mutex);
        number = order.number = state_->wanted ? state_->wanted->number + 1 : 1;
        state_->wanted = std::move(order);
        state_->waiting = false;
    }
    state_->signal.notify_all();
    return number;
}

void DrawingThread::save(const std::filesystem::path& folder) {
    {
        const std::lock_guard lock(state_->mutex);
        state_->save_to = folder;
        state_->waiting = false;
    }
    state_->signal.notify_all();
}

std::string DrawingThread::saved() {
    const std::lock_guard lock(state_->mutex);
    return std::exchange(state_->saved, {});
}

std::shared_ptr<const Shown> DrawingThread::shown() const {
    const std::lock_guard lock(state_->mutex);
    return state_->shown;
}
std::shared_ptr<const Judged> DrawingThread::judged() const {
    const std::lock_guard lock(state_->mutex);
    return state_->judged;
}
std::shared_ptr<const Breakdown> DrawingThread::breakdown() const {
    const std::lock_guard lock(state_->mutex);
    return state_->breakdown;
}
std::shared_ptr<const SceneFacts> DrawingThread::facts() const {
    const std::lock_guard lock(state_->mutex);
    return state_->facts;
}
Status DrawingThread::status() const {
    const std::lock_guard lock(state_->mutex);
    return state_->status;
}
bool DrawingThread::idle() const {
    const std::lock_guard lock(state_->mutex);
    return state_->waiting;
}
std::string DrawingThread::device() const {
    const std::lock_guard lock(state_->mutex);
    return state_->device_name;
}
std::uint64_t DrawingThread::validationMessages() const {
    const std::lock_guard lock(state_->mutex);
    return state_->validation_messages;
}
std::string DrawingThread::firstValidationMessage() const {
    const std::lock_guard lock(state_->mutex);
    return state_->first_validation_message;
}

}  // namespace diptych::viewer
