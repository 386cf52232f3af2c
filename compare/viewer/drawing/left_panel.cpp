// SPDX-License-Identifier: MIT
#include "compare/viewer/drawing/left_panel.h"

#include "compare/files/frame_exr.h"
#include "compare/frames/frame_properties.h"
#include "compare/reference/reference.h"

#include <stdexcept>

namespace diptych::viewer {
namespace {

// Interval between updates of the reference.
constexpr std::chrono::milliseconds referencePause{200};

bool showsReference(const DrawRequest& request) {
    return request.view_options.against == Against::reference && !request.moving;
}

}  // namespace

LeftPanel::LeftPanel(Mailbox& mailbox)
    : reference_([this, &mailbox] { mailbox.request([this] { more_ = true; }); }) {}

std::pair<std::shared_ptr<const Frame>, double> LeftPanel::reference(const DrawRequest& request,
                                                                     PairRenderer& pair, const Stage& stage,
                                                                     const Frame& under) {
    Settings wanted = referenceSettings(request.subject.settings);
    if (const auto problem = wanted.problem()) throw std::runtime_error(*problem);
    if (reference_.settings() != wanted || reference_scene_ != pair.scene()) {
        reference_scene_ = pair.scene();
        std::optional<Frame> surfaces;
        if (wanted.reference_mode == ReferenceMode::surface) {
            RenderOptions capture;
            capture.channels =
                diptych::reference::surfaceChannels(pair.views().at(viewRequest(wanted)).needs.layers);
            capture.runs = 0;
            capture.progress = stage;
            surfaces = pair.renderer().draw(surfaceSettings(wanted), capture);
        }
        reference_.begin(reference_scene_, wanted, std::move(surfaces));
    }
    more_ = false;
    reference_shown_ = Clock::now();
    if (const std::string error = reference_.error(); !error.empty()) throw std::runtime_error(error);
    const double done = reference_.done();
    return {
        reference_.frame({Channel::lit, Channel::material_id, Channel::depth, request.view_options.channel()},
                         &under.channels.at(Channel::lit)),
        done};
}

std::shared_ptr<const Frame> LeftPanel::storedFrame(const std::filesystem::path& file) {
    if (!stored_ || stored_->first != file)
        stored_.emplace(file, std::make_shared<const Frame>(frameFromExr(file)));
    return stored_->second;
}

void LeftPanel::stopUnneeded(const DrawRequest& request) {
    if (reference_.done() < 1 &&
        !(showsReference(request) && reference_.settings() == referenceSettings(request.subject.settings)))
        reference_.stop();
}

bool LeftPanel::hasMore(const DrawRequest& request) const {
    return more_ && showsReference(request);
}

LeftPanel::Clock::time_point LeftPanel::nextUpdate() const {
    return reference_shown_ + referencePause;
}

bool LeftPanel::isUpdateDue(const DrawRequest& request) const {
    return hasMore(request) && (reference_.done() >= 1 || Clock::now() >= nextUpdate());
}

}  // namespace diptych::viewer
