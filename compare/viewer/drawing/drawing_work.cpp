// SPDX-License-Identifier: MIT
#include "compare/viewer/drawing/drawing_work.h"

#include "compare/frames/frame_properties.h"
#include "compare/output/writers.h"
#include "compare/render/path_plan.h"
#include "compare/run/progress.h"
#include "compare/verdict/pair_reports.h"
#include "compare/viewer/drawing/image_cost.h"
#include "compare/viewer/drawing/images.h"
#include "compare/viewer/drawing/left_panel.h"
#include "compare/viewer/drawing/pair_renderer.h"
#include "compare/viewer/drawing/properties.h"
#include "compare/viewer/drawing/screenshot.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <exception>
#include <mutex>
#include <tuple>
#include <utility>
#include <vector>

namespace diptych::viewer {
namespace {

using Clock = std::chrono::steady_clock;

// Target for rendering both paths while moving, ms. With the host's work that gives about 15 images a
// second, and a key takes effect within two of them.
constexpr double movingMs = 40;
// A still image that takes longer is preceded by a smaller one.
constexpr double patienceMs = 250;
// Number of consecutive recoveries from a lost device before giving up until the next request.
constexpr int maxRecoveries = 3;

// Aborts work that is no longer needed.
struct Superseded {};

// A request's steps in order, in one class and so in one long file: each goes on from what those before it
// left.
class DrawingWork {
public:
    DrawingWork(const DrawingOptions& options, Mailbox& box)
        : options_(options),
          box_(box),
          progress_(
              [this](const std::string&, double fraction, const std::string& step) { at(fraction, step); }),
          comparing_(
              [this](const std::string&, double fraction, const std::string& step) { note(fraction, step); }),
          pair_(options.device, progress_, comparing_),
          left_(box) {}

    void run() {
        yieldToInterface();
        while (next()) {
            try {
                work();
                countMessages();
                recoveries_ = 0;
            } catch (const Superseded&) {
            } catch (const std::bad_alloc&) {
                fail("out of memory; try a smaller size");
            } catch (const std::exception& error) {
                if (!recovered(error.what())) fail(error.what());
            }
        }
    }

private:
    // ---- what to do next ------------------------------------------------------------------------------

    // Waits for work; false: stop.
    bool next() {
        std::unique_lock lock(box_.mutex);
        for (;;) {
            if (box_.stopping) return false;
            if (box_.wanted && box_.wanted->id != request_.id) {
                request_ = *box_.wanted;
                both_ = ofBothPaths(request_.subject);
            }
            if (box_.save_to || (request_.id != 0 && hasWork())) {
                box_.waiting = false;
                return true;
            }
            // A reference in progress is part of the request.
            box_.waiting = !drawsReference();
            box_.status.doing.clear();
            if (left_.hasMore(request_)) {
                // Shows partial references at intervals.
                box_.signal.wait_until(lock, left_.nextUpdate());
            } else {
                box_.wake();
                box_.signal.wait(lock);
            }
        }
    }

    bool drawsReference() const {
        return request_.view_options.against == Against::reference && !request_.moving &&
               drawn_request_ == request_.id && failed_request_ != request_.id && left_.referenceDone() < 1;
    }
    bool hasWork() const {
        if (failed_request_ == request_.id) return false;
        if (drawn_request_ != request_.id) return true;
        if (request_.moving) return false;
        return left_.isUpdateDue(request_) || wantsTimes() || wantsVerdict() || wantsBreakdown();
    }
    // Not while the reference uses all cores.
    bool wantsTimes() const { return timed_ != both_ && !drawsReference(); }
    // The baseline of the verdict: the reference once it is finished.
    Against evaluatedAgainst() const {
        return request_.view_options.against == Against::reference && left_.referenceDone() < 1
                   ? Against::paths
                   : request_.view_options.against;
    }
    bool wantsVerdict() const { return evaluated_of_ != both_ || evaluated_against_ != evaluatedAgainst(); }
    bool wantsBreakdown() const {
        return request_.pixel && broken_down_ != std::pair(both_, *request_.pixel);
    }

    // One step; the most urgent first.
    void work() {
        if (const auto folder = takeSave()) return write(*folder);
        left_.stopUnneeded(request_);
        readScene();
        needRenderer();
        if (drawn_request_ != request_.id) {
            if (!request_.moving) drawSmallerFirst();
            return draw();
        }
        if (left_.isUpdateDue(request_)) return draw();
        if (wantsBreakdown()) return breakDown();
        if (wantsTimes()) return time();
        if (wantsVerdict()) return evaluate();
    }

    // ---- progress and errors --------------------------------------------------------------------------

    void heed() const {
        const std::lock_guard lock(box_.mutex);
        if (box_.stopping || (box_.wanted && box_.wanted->id != request_.id)) throw Superseded();
    }
    void at(double fraction, const std::string& step) {
        heed();
        note(fraction, step);
    }
    void note(double fraction, const std::string& step) {
        box_.publish([&] {
            box_.status.fraction = fraction;
            box_.status.doing = step;
        });
    }
    Stage stage(const char* what) { return {progress_, what}; }

    void fail(const std::string& why) {
        failed_request_ = request_.id;
        box_.publish([&] {
            box_.status.error = why;
            box_.status.doing.clear();
            box_.status.loading = false;
        });
    }

    // Counts validation messages of all devices so far.
    void countMessages() {
        const Device* device = pair_.device();
        if (!device || device->validationMessages() == 0) return;
        box_.count(of_lost_devices_ + device->validationMessages(), device->firstValidationMessage());
    }

    // Drops a lost device; false if there was no loss, or too many.
    bool recovered(const std::string& why) {
        const bool lost = why.find("lost") != std::string::npos;
        if (!lost || ++recoveries_ > maxRecoveries) return false;
        countMessages();
        of_lost_devices_ = box_.validation_messages;
        pair_.dropDevice();
        const std::lock_guard lock(box_.mutex);
        box_.status.error = why + "; restarting the device";
        return true;
    }

    // ---- scene and device -----------------------------------------------------------------------------

    // If a scene cannot be read, the previous one stays.
    void readScene() {
        if (!pair_.isLoaded(request_.subject)) {
            const std::lock_guard lock(box_.mutex);
            box_.status.loading = true;
        }
        if (!pair_.load(request_.subject)) return;
        left_.stopReference();
        auto known = std::make_shared<SceneProperties>(propertiesOf(*pair_.scene(), request_.subject.scene));
        {
            const std::lock_guard lock(box_.mutex);
            box_.properties = std::move(known);
            box_.status.loading = false;
            box_.status.error.clear();
        }
        drawn_.reset();
        evaluated_of_.reset();
        paths_ = {};
    }

    void needRenderer() {
        if (pair_.startDevice()) {
            const std::lock_guard lock(box_.mutex);
            box_.device_name = pair_.device()->info().name;
        }
        if (!pair_.upload()) return;
        drawn_.reset();
        timed_.reset();
    }

    // ---- images ---------------------------------------------------------------------------------------

    // Both paths' Settings at the request's size.
    std::array<Settings, 2> fullSettings() const {
        const Size& size = request_.subject.settings.size;
        return {settingsOf(request_.subject, drawn_paths[0], size),
                settingsOf(request_.subject, drawn_paths[1], size)};
    }

    void takeProperties(const std::array<const Frame*, 2>& of, bool timed_too) {
        for (std::size_t i = 0; i < 2; ++i) viewer::takeProperties(*of.at(i), timed_too, paths_.at(i));
    }

    // Shows a smaller image first if a still one takes long.
    void drawSmallerFirst() {
        const Size full = request_.subject.settings.size;
        if (drawn_ == both_) return;
        if (cost_.known() && cost_.of(double(full.width) * full.height) < patienceMs) return;
        drawAt(movingSize(full, movingMs, cost_), true);
    }

    void draw() {
        const Size& full = request_.subject.settings.size;
        drawAt(request_.moving ? movingSize(full, movingMs, cost_) : full, request_.moving);
    }

    bool has(const std::vector<Channel>& channels) const {
        return std::ranges::all_of(
            channels, [&](Channel mode) { return std::ranges::count(drawn_channels_, mode) > 0; });
    }

    void drawAt(const Size& size, bool passing) {
        const auto start = Clock::now();
        if (options_.before_image) options_.before_image();
        pair_.views().clear();  // views of intermediate cameras are not needed again
        const Channel mode = request_.view_options.channel();
        std::array<Frame, 2> passed;
        const bool known = !passing && drawn_ == both_ && has({mode});
        if (passing)
            passed = mode == Channel::lit ? pair_.drawLit(request_.subject, size)
                                          : pair_.drawChannels(request_.subject, size, {mode}, true);
        else if (!known) {
            std::array<Frame, 2> whole = pair_.drawChannels(request_.subject, size, {mode}, false);
            for (std::size_t i = 0; i < 2; ++i)
                frames_.at(i) = std::make_shared<const Frame>(std::move(whole.at(i)));
            drawn_ = both_;
            drawn_channels_ = {mode, Channel::lit, Channel::material_id, Channel::depth};
        }
        const std::array<const Frame*, 2> now{passing ? &passed[0] : frames_[0].get(),
                                              passing ? &passed[1] : frames_[1].get()};
        if (!known) {
            // The first frame of each pipeline includes compilation, so it is ignored. Like timed frames,
            // this excludes the host's own work.
            const double frames_ms = now[0]->time.median + now[1]->time.median;
            if (passing && compiled_ == pair_.renderer().pipelines())
                cost_.add(double(size.width) * size.height, frames_ms > 0 ? frames_ms : msSince(start));
            compiled_ = pair_.renderer().pipelines();
            takeProperties(now, passing && mode == Channel::lit);
        }
        show(now, size, passing, start);
    }

    void show(const std::array<const Frame*, 2>& now, const Size& size, bool passing,
              Clock::time_point start) {
        auto next = std::make_shared<DrawnView>();
        next->request = request_;
        next->size = size;
        const ViewOptions& view_options = request_.view_options;
        const std::size_t right = request_.subject.settings.path == drawn_paths[0] ? 0 : 1;
        const Frame &test = *now.at(right), &other = *now.at(1 - right);
        const bool traced = view_options.against == Against::reference && !passing;
        std::shared_ptr<const Frame> left;
        if (traced)
            std::tie(left, next->reference_done) =
                left_.reference(request_, pair_, stage("the reference's surfaces"), test);
        else if (view_options.against == Against::file)
            left = left_.storedFrame(view_options.file);
        // Recomputing the exposure for every smaller image would flicker.
        if (!passing || !exposure_ || exposure_of_.image().exposure != view_options.exposure ||
            exposure_of_.ev100 != view_options.ev100 || exposure_of_.tonemap != view_options.tonemap) {
            exposure_ = exposureOf(other, test, view_options);
            exposure_of_ = view_options;
        }
        makeImages(left ? *left : other, test, view_options, *exposure_, *next);
        if (traced && next->reference_done < 1)
            next->panels[0].name = fmt::format("reference, {:.0f} % drawn over {}",
                                               100 * next->reference_done, next->panels[1].name);
        const SceneView& view = pair_.views().at(viewRequest(test.settings));
        next->camera = cameraOf(view.view);
        next->view = view.view;
        next->lights = view.lights;
        next->plan = planLines(view, request_.subject.settings);
        if (!passing) next->depth = test.channels.at(Channel::depth);
        next->paths = paths_;
        next->made_in_ms = msSince(start);
        if (!passing || request_.moving) drawn_request_ = request_.id;
        box_.publish([&] {
            box_.shown = std::move(next);
            box_.status.error = pair_.sceneError();  // until a scene is read
        });
    }

    // ---- results beside a still image -----------------------------------------------------------------

    // The drawn view, with the current properties of the paths.
    std::shared_ptr<const DrawnView> shownWithProperties() const {
        auto next = std::make_shared<DrawnView>(*box_.shown);
        next->paths = paths_;
        return next;
    }

    void time() {
        const std::array settings = fullSettings();
        RenderOptions render;
        render.runs = 3;
        render.progress = stage("time");
        const std::vector<TimedFrame> times = pair_.renderer().time(settings, render);
        for (std::size_t i = 0; i < 2; ++i) {
            paths_.at(i).ms = times.at(i).time.median;
            paths_.at(i).passes = times.at(i).passes;
            ++paths_.at(i).measurement;
        }
        cost_.add(double(settings[0].size.width) * settings[0].size.height, paths_[0].ms + paths_[1].ms);
        timed_ = both_;
        auto next = shownWithProperties();
        const std::lock_guard lock(box_.mutex);
        box_.shown = std::move(next);
    }

    // Both paths with every channel.
    std::vector<Frame> evaluatedFrames(const std::array<Settings, 2>& settings) {
        RenderOptions render = channelOptions(everyChannel());
        render.requested = everyChannel();
        render = evaluatedOptions(std::move(render), settings,
                                  request_.subject.settings.reference_mode == ReferenceMode::scene, false,
                                  Twice::none);
        std::vector<Frame> pair;
        for (std::size_t i = 0; i < 2; ++i) {
            if (evaluated_of_ == both_ && drawn_ == both_ && has(everyChannel())) {
                pair.push_back(*frames_.at(i));  // only the baseline changed
                continue;
            }
            render.progress =
                stage("verdict").part(0.4 * static_cast<double>(i), 0.4 * static_cast<double>(i + 1));
            pair.push_back(pair_.renderer().draw(settings.at(i), render));
        }
        return pair;
    }

    Report evaluatedReport(std::vector<Frame> pair, Against against, const CompareOptions& compare) {
        const ReportDevice here = reportDevice(*pair_.device());
        std::vector<ViewFrames> views(1);
        ViewFrames& view = views.front();
        view.needs = pair_.views().at(viewRequest(pair[0].settings)).needs;
        view.frames = std::move(pair);
        if (against == Against::reference) {
            view.frames.insert(view.frames.begin(), *left_.finishedReference());
            for (const Material& material : pair_.scene()->materials) view.materials.push_back(material.name);
        }
        std::optional<Frame> earlier;
        if (against == Against::file) {
            earlier = *left_.storedFrame(request_.view_options.file);
            earlier->requested = view.frames[0].requested;
        }
        return makeReport(std::move(views), here, compare, std::move(earlier));
    }

    void evaluate() {
        const std::array settings = fullSettings();
        std::vector<Frame> pair = evaluatedFrames(settings);
        auto next = std::make_shared<EvaluatedPair>();
        next->subject = both_;
        CompareOptions compare = options_.compare;
        compare.light_differs = lightDifferences(settings[0], settings[1]);
        compare.progress = Stage(comparing_, "verdict").part(0.8, 1);
        heed();
        const Against against = evaluatedAgainst();
        next->report = evaluatedReport(std::move(pair), against, compare);
        evaluated_of_ = both_;
        evaluated_against_ = against;
        // Every channel exists from now on.
        for (std::size_t i = 0; i < 2; ++i)
            for (const Frame& frame : next->report.frames)
                if (frame.settings.path == drawn_paths.at(i))
                    frames_.at(i) = std::shared_ptr<const Frame>(next, &frame);
        drawn_ = both_;
        drawn_channels_ = everyChannel();
        takeProperties({frames_[0].get(), frames_[1].get()}, false);
        auto again = shownWithProperties();
        box_.publish([&] {
            box_.evaluated = std::move(next);
            box_.shown = std::move(again);
        });
    }

    void breakDown() {
        const Settings& settings = request_.subject.settings;
        const std::array both = fullSettings();
        const PixelQuery query{.x = request_.pixel->x,
                               .y = request_.pixel->y,
                               .baseline = both[0],
                               .test = both[1],
                               .reference = referenceSettings(settings),
                               .device = reportDevice(*pair_.device()),
                               .rules = options_.compare.rules,
                               .light_differs = lightDifferences(both[0], both[1]),
                               .progress = stage("this pixel")};
        auto next = std::make_shared<Breakdown>(
            Breakdown{both_, *request_.pixel, pixelBreakdown(pair_.renderer(), pair_.views(), query), {}});
        next->text = inText(blocksOf(next->breakdown));
        broken_down_ = std::pair(both_, *request_.pixel);
        const std::lock_guard lock(box_.mutex);
        box_.breakdown = std::move(next);
    }

    // ---- files ----------------------------------------------------------------------------------------

    std::optional<std::filesystem::path> takeSave() {
        const std::lock_guard lock(box_.mutex);
        return std::exchange(box_.save_to, std::nullopt);
    }

    void write(const std::filesystem::path& folder) {
        std::string line;
        try {
            readScene();
            needRenderer();
            line = fmt::format("written: {}.*, .exr and .png of both paths",
                               writeScreenshot(pair_, request_, folder));
        } catch (const Superseded&) {
            // A newer request comes first.
            const std::lock_guard lock(box_.mutex);
            if (!box_.save_to) box_.save_to = folder;
            throw;
        } catch (const std::exception& error) {
            line = fmt::format("not written: {}", error.what());
        }
        box_.publish([&] { box_.saved = line; });
    }

    const DrawingOptions& options_;
    Mailbox& box_;
    DrawRequest request_;  // the current request
    Subject both_;         // its subject, independent of the right panel's path
    // Deferred, forward+, of `drawn_`; those of a verdict point into its report.
    std::array<std::shared_ptr<const Frame>, 2> frames_;
    std::optional<Subject> drawn_;  // still and at full size
    std::vector<Channel> drawn_channels_;
    std::optional<std::uint64_t> drawn_request_, failed_request_;
    std::optional<Subject> timed_, evaluated_of_;
    Against evaluated_against_ = Against::paths;
    std::optional<std::pair<Subject, PixelPosition>> broken_down_;
    std::array<PathProperties, 2> paths_;
    ImageCost cost_;                    // of moving images, once their pipelines exist
    std::size_t compiled_ = 0;          // number of pipelines after the last image
    std::optional<Exposure> exposure_;  // of the last still image
    ViewOptions exposure_of_;
    int recoveries_ = 0;
    std::uint64_t of_lost_devices_ = 0;  // messages of the validation layers
    Progress progress_;                  // throws Superseded if the work is no longer needed
    Progress comparing_;                 // of parallel work and of reading a scene, which always finish
    PairRenderer pair_;
    LeftPanel left_;
};

}  // namespace

void runDrawing(const DrawingOptions& options, Mailbox& mailbox) {
    DrawingWork(options, mailbox).run();
}

}  // namespace diptych::viewer
