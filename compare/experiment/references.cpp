// SPDX-License-Identifier: MIT
#include "compare/experiment/references.h"

#include "compare/render/omitted_lights.h"
#include "shared/contract/debug_mode.h"

#include <algorithm>

namespace diptych::experiment {

RenderOptions litOptions(const RenderOptions& options, bool shadows) {
    RenderOptions drawing = options;
    drawing.channels = {Channel::lit, Channel::material_id};
    if (shadows)
        drawing.channels.insert(drawing.channels.end(), {Channel::shadow_visibility, Channel::depth,
                                                         Channel::cascade, Channel::page_residency});
    drawing.requested = drawing.channels;
    drawing.twice = Twice::none;
    drawing.through_gbuffer = false;
    drawing.recheck = false;  // lit is the timed frame's
    return drawing;
}

Settings seenFrom(const Frame& reference, Settings settings) {
    settings.camera = reference.settings.camera;
    return settings;
}

ReferenceFrames drawReferenceFrames(Renderer& renderer, const Settings& requested,
                                    const std::vector<std::string>& cameras, const ImageChoice& choice,
                                    const RenderOptions& options, bool shadows) {
    RenderOptions drawing = litOptions(options, shadows && requested.shadows != Shadows::off);
    drawing.runs = 0;
    drawing.shadow_edges = shadows;
    ReferenceFrames references;
    for (std::size_t i = 0; i < cameras.size(); ++i) {
        const double from = static_cast<double>(i), all = static_cast<double>(cameras.size());
        drawing.progress = options.progress.part(from / all, (from + 1) / all);
        Settings settings = referenceSettings(requested);
        settings.camera = cameras[i];
        references.frames.push_back(renderer.draw(settings, drawing));
        references.errors.push_back(std::make_shared<ErrorsAgainst>(references.frames.back()));
    }
    const Frame& first = references.frames.front();
    references.exposure = exposureFor(choice, &first.channels.at(Channel::lit), coverage(first, first));
    return references;
}

void addNotes(std::vector<std::string>& notes, const ReferenceFrames& references,
              std::span<const Settings> rows, const Requirements& needs) {
    const auto add = [&](const std::vector<std::string>& lines) {
        for (const std::string& line : lines)
            if (std::ranges::count(notes, line) == 0) notes.push_back(line);
    };
    for (const Frame& frame : references.frames) add(frame.notes);
    for (const Path path : drawn_paths)
        if (std::ranges::count(rows, path, &Settings::path) > 0) add(omittedLights(path, needs));
}

}  // namespace diptych::experiment
