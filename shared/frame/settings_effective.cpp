// SPDX-License-Identifier: MIT
// Settings that a path reads, and those that the reference follows.
#include "shared/frame/settings.h"

#include "shared/frame/setting_rows.h"

#include <algorithm>

namespace diptych {
namespace {

const Settings& defaults() {
    static const Settings settings;
    return settings;
}

bool isOfTheReferenceAlone(const Field& field) {
    return field.ignored.reference.empty() &&
           std::ranges::none_of(drawn_paths, [&](Path path) { return field.ignored.of(path).empty(); });
}

std::string_view whyIgnored(const Settings& settings, const Field& field) {
    const bool is_read = field.ignored.unless && field.ignored.unless(settings);
    return is_read ? std::string_view{} : field.ignored.of(settings.path);
}

}  // namespace

std::string_view ignoredBecause(const Settings& settings, std::string_view option) {
    return whyIgnored(settings, settingField(option));
}

Settings effectiveSettings(const Settings& settings) {
    Settings effective = settings;
    Settings::rows([&](const Field& field, auto member) {
        if (!whyIgnored(settings, field).empty()) effective.*member = defaults().*member;
    });
    if (!isReference(settings.path)) return effective;
    for (const Field& field : settingFields())
        if (!field.one_for_reference.empty() && effective.valueOf(field.option) != field.off)
            effective.set(field.option, std::string(field.one_for_reference));
    return effective;
}

Settings referenceSettings(const Settings& settings) {
    Settings reference = settings;
    reference.path = Path::reference;
    return effectiveSettings(reference);
}

Settings withReferenceOf(const Settings& settings, const Settings& reference) {
    Settings result = settings;
    Settings::rows([&](const Field& field, auto member) {
        if (isOfTheReferenceAlone(field)) result.*member = reference.*member;
    });
    return result;
}

Settings withoutReference(const Settings& settings) {
    return withReferenceOf(settings, defaults());
}

Settings surfaceSettings(const Settings& settings) {
    Settings surfaces = withoutReference(referenceSettings(settings));
    for (const Field& field : settingFields())
        if (field.for_surfaces) surfaces.set(field.option, std::string(*field.for_surfaces));
    return surfaces;
}

}  // namespace diptych
