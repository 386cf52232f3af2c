// SPDX-License-Identifier: MIT
#include "compare/cli/audit_opening.h"

#include "compare/cli/commands.h"
#include "compare/render/host_memory.h"
#include "compare/run/print.h"
#include "shared/contract/debug_mode.h"

#include <cstdio>
#include <vector>

namespace diptych::cli {

AuditOpening::AuditOpening(const Options& options, const Settings& settings, const char* folder,
                           const char* what, const char* manifest)
    : options_(options),
      folder_(outputFolder(options, folder, what, manifest)),
      progress_(progressOutput(options)),
      device_(deviceOptions(options)),
      stage_(progress_, options.scenes.front()),
      scene_(loadShown(options.scenes.front(), settings, stage_.part(0, 0.02))),
      subject_(audit::makeSubject(scene_, settings)),
      audited_{options.scenes.front(), settings.camera.empty() ? subject_.view_name : settings.camera,
               settings, reportDevice(device_), scene_.notes} {
    say(options, "on " + device_.info().name);
    // An audit keeps up to six reference Frames at a time.
    const std::vector<Settings> references(6, referenceSettings(settings));
    RenderOptions drawing;
    drawing.channels = {Channel::lit, Channel::material_id};
    SceneViews views(scene_);
    checkHostMemory(views, references, drawing, device_.profile().software);
}

void AuditOpening::print(const std::string& words) {
    if (options_.json || options_.quiet || std::ferror(stdout)) return;
    progress_.wipe();
    printColored(options_, words);
    flushText();
}

}  // namespace diptych::cli
