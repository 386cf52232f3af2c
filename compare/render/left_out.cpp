// SPDX-License-Identifier: MIT
#include "compare/render/left_out.h"

#include <fmt/format.h>

#include <algorithm>

namespace diptych {

std::vector<std::string> leftOutLight(Path path, const Requirements& needs) {
    std::vector<std::string> notes;
    if (path == Path::reference) return notes;
    const auto note = [&](const std::string& what, bool one) {
        notes.push_back(fmt::format("{}: not drawn by {} yet: the reference has {}", what, nameOf(path),
                                    one ? "it" : "them"));
    };
    if (needs.sun_discs > 0)
        note(needs.sun_discs == 1 ? "1 sun's disc" : fmt::format("{} suns' discs", needs.sun_discs),
             needs.sun_discs == 1);
    if (!needs.environment.empty()) note("environment " + needs.environment, true);
    return notes;
}

std::vector<std::string> leftOutMotion(Path path, const Requirements& needs) {
    if (path == Path::reference || needs.skinned + needs.morphed == 0) return {};
    return {fmt::format("{}: drawn undeformed by {} yet: the reference poses {} in mode scene",
                        needs.deformedInWords(), nameOf(path),
                        needs.skinned + needs.morphed == 1 ? "it" : "them")};
}

std::optional<std::string> undrawnSetting(std::span<const Settings> paths) {
    const auto isReference = [](const Settings& s) { return s.path == Path::reference; };
    if (paths.empty() || std::ranges::all_of(paths, isReference)) return {};
    const Settings& asked = paths.front();
    if (asked.env == Settings().env) return {};
    return fmt::format(
        "--env {}: neither deferred nor forward_plus draws an environment yet; leave it out, or see it with "
        "render --path reference",
        asked.env);
}

}  // namespace diptych
