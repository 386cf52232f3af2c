// SPDX-License-Identifier: MIT
#include "compare/audit/relations.h"

namespace diptych::audit {

namespace {

void drawAgain(Related&, const Subject&) {}

void assignAs(Related& related, Assignment wanted, Assignment otherwise) {
    Settings& settings = related.changed.settings;
    settings.assign = settings.assign == wanted ? otherwise : wanted;
}
void assignEvery(Related& related, const Subject&) {
    assignAs(related, Assignment::every, Assignment::clustered);
}
void assignTiled(Related& related, const Subject&) {
    assignAs(related, Assignment::tiled, Assignment::every);
}

std::string lacksLists(const Subject& subject) {
    if (subject.given.settings.assign == Assignment::every) return "--assign every has no lists";
    return lacksPerObject(subject);
}
void fillOtherwise(Related& related, const Subject&) {
    related.own_base = true;
    related.base.settings.set("light-kernel", "scatter");
    related.changed.settings.set("light-kernel", "gather");
}

void drawPrepass(Related& related, const Subject&) {
    related.own_base = true;
    related.base.settings.prepass = Switch::off;
    related.changed.settings.prepass = Switch::on;
}

void drawAll(Related& related, const Subject&) {
    related.own_base = true;
    related.base.settings.cull = true;
    related.changed.settings.cull = false;
}

void shadeInCompute(Related& related, const Subject&) {
    related.own_base = true;
    related.base.settings.lighting = Lighting::fragment;
    related.changed.settings.lighting = Lighting::compute;
}

std::string lacksStillness(const Subject& subject) {
    return subject.moves ? "something in the scene is animated" : "";
}
void waitAWhile(Related& related, const Subject&) {
    related.changed.settings.time += 10;
}

}  // namespace

std::vector<Relation> settingRelations() {
    return {{.name = "repeated",
             .changes = "the same scene is uploaded and drawn again",
             .because = "rendering is deterministic",
             .lacks = lacksNone,
             .change = drawAgain,
             .same_pipelines = true},
            {.name = "assign_every",
             .changes = "every pixel evaluates every light instead of its light list (or the reverse)",
             .because = "a light outside a list adds 0, and lists keep the order of the lights",
             .lacks = lacksPerObject,
             .change = assignEvery,
             .of_settings = true},
            {.name = "assign_tiled",
             .changes = "light lists are made per tile instead (or every light, if they already are)",
             .because = "a light outside a list adds 0, and lists keep the order of the lights",
             .lacks = lacksPerObject,
             .change = assignTiled,
             .of_settings = true},
            {.name = "light_kernel",
             .changes = "light lists are built per tile instead of per light",
             .because = "both ways fill the same lists in the same order",
             .lacks = lacksLists,
             .change = fillOtherwise,
             .of_settings = true},
            {.name = "prepass",
             .changes = "a depth pre-pass is drawn first",
             .because = "hidden surfaces are not shaded, and visible ones are shaded the same way",
             .lacks = lacksNone,
             .change = drawPrepass,
             .of_settings = true},
            {.name = "cull",
             .changes = "culling is off: triangles that cannot be visible are drawn too",
             .because = "they cover no sample",
             .lacks = lacksNone,
             .change = drawAll,
             .same_pipelines = true,
             .of_settings = true},
            {.name = "lighting",
             .changes = "a compute shader lights the G-buffer instead of a full-screen triangle",
             .because = "both shade each pixel with the same code",
             .lacks = lacksNone,
             .change = shadeInCompute,
             .of_settings = true},
            {.name = "still_time",
             .changes = "the time is 10 s later in a scene without animation",
             .because = "nothing in the scene moves",
             .lacks = lacksStillness,
             .change = waitAWhile,
             .same_pipelines = true}};
}

}  // namespace diptych::audit
