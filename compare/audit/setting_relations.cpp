// SPDX-License-Identifier: MIT
#include "compare/audit/relations.h"

namespace diptych::audit {

namespace {

void assignAs(Related& related, Assignment wanted, Assignment otherwise) {
    Settings& settings = related.changed.settings;
    settings.assign = settings.assign == wanted ? otherwise : wanted;
}
std::string lacksLists(const Subject& subject) {
    return subject.original.settings.assign == Assignment::every ? "--assign every has no lists" : "";
}

// Draws the two images with these values of an option.
void compareValues(Related& related, const char* option, const char* base, const char* changed) {
    related.own_base = true;
    related.base.settings.set(option, base);
    related.changed.settings.set(option, changed);
}

}  // namespace

std::vector<Relation> settingRelations() {
    return {
        {.name = "repeated",
         .changes = "the same scene is uploaded and drawn again",
         .because = "rendering is deterministic",
         .change = [](Related&, const Subject&) {},
         .same_pipelines = true},
        {.name = "assign_every",
         .changes = "every pixel evaluates every light instead of its light list (or the reverse)",
         .because = "a light outside a list adds 0, and lists keep the order of the lights",
         .lacks = {lacksPerObject},
         .change = [](Related& related,
                      const Subject&) { assignAs(related, Assignment::every, Assignment::clustered); },
         .of_settings = true},
        {.name = "assign_tiled",
         .changes = "light lists are made per tile instead (or every light, if they already are)",
         .because = "a light outside a list adds 0, and lists keep the order of the lights",
         .lacks = {lacksPerObject},
         .change = [](Related& related,
                      const Subject&) { assignAs(related, Assignment::tiled, Assignment::every); },
         .of_settings = true},
        {.name = "light_kernel",
         .changes = "light lists are built per tile instead of per light",
         .because = "both ways fill the same lists in the same order",
         .lacks = {lacksLists, lacksPerObject},
         .change = [](Related& related,
                      const Subject&) { compareValues(related, "light-kernel", "scatter", "gather"); },
         .of_settings = true},
        {.name = "prepass",
         .changes = "a depth pre-pass is drawn first",
         .because = "hidden surfaces are not shaded, and visible ones are shaded the same way",
         .change = [](Related& related, const Subject&) { compareValues(related, "prepass", "off", "on"); },
         .of_settings = true},
        {.name = "cull",
         .changes = "culling is off: triangles that cannot be visible are drawn too",
         .because = "they cover no sample",
         .change = [](Related& related, const Subject&) { compareValues(related, "cull", "on", "off"); },
         .same_pipelines = true,
         .of_settings = true},
        {.name = "lighting",
         .changes = "a compute shader lights the G-buffer instead of a full-screen triangle",
         .because = "both shade each pixel with the same code",
         .change = [](Related& related,
                      const Subject&) { compareValues(related, "lighting", "fragment", "compute"); },
         .of_settings = true},
        {.name = "still_time",
         .changes = "the time is 10 s later in a scene without animation",
         .because = "nothing in the scene moves",
         .lacks = {[](const Subject& subject) -> std::string {
             return subject.moves ? "something in the scene is animated" : "";
         }},
         .change = [](Related& related, const Subject&) { related.changed.settings.time += 10; },
         .same_pipelines = true},
    };
}

}  // namespace diptych::audit
