// SPDX-License-Identifier: MIT
#include "compare/render/path_plan.h"

#include "compare/render/frame_facts.h"
#include "compare/render/prepared_view.h"

#include <fmt/format.h>

namespace diptych {

std::vector<PathPlan> planPaths(Device& device, SceneViews& views, const std::vector<Settings>& settings) {
    SharedResources shared(device, views.scene());
    std::vector<PathPlan> plans;
    for (const Settings& s : settings) {
        checkSize(device, s.size);
        // A path's pipelines are counted as if it were alone, whichever of them another has made.
        shared.pipelines.clear();
        const PreparedView view(device, shared, views.at(viewRequest(s)), s);
        const PathFunctions& path = functionsOf(s.path);
        PassList passes(device, 1, 1);
        path.add(passes, view.inputs);
        passes.allocate();
        PathPlan plan{std::string(nameOf(s.path)),
                      passes.names(),
                      path.bytesPerPixel(view.inputs),
                      passes.sharedBytes(),
                      {}};
        for (const std::string& note : view.notes) plan.notes.push_back(note);
        plan.notes.push_back(fmt::format("{} draws in view, {} culled, {} pipelines", view.draws.items.size(),
                                         view.draws.culled, shared.pipelines.count()));
        plans.push_back(std::move(plan));
    }
    return plans;
}

}  // namespace diptych
