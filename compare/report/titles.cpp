// SPDX-License-Identifier: MIT
#include "compare/report/titles.h"

#include "shared/text/counted.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <set>

namespace diptych {
bool hasMultiplePairs(const Report& report) {
    return !report.closer_paths.empty() || std::ranges::any_of(report.frames, [](const Frame& f) {
        return !f.origin.file.empty() || !f.origin.device.empty();
    });
}

std::string pairTitle(const Report& report, const Comparison& comparison) {
    return fmt::format("{} against {}", report.test(comparison).name, report.baseline(comparison).name);
}

bool namesTime(const Report& report, const Frame& frame) {
    return frame.settings.time != 0 || std::ranges::any_of(report.comparisons, [&](const Comparison& other) {
               return report.test(other).settings.time != frame.settings.time;
           });
}

std::string viewTitle(const Report& report, const Frame& frame) {
    const std::string camera = page::cameraTitle(frame);
    return namesTime(report, frame) ? fmt::format("{}, {} s", camera, frame.settings.time) : camera;
}

std::string folderOfAll(const Report& report) {
    std::vector<std::string> paths;
    const bool files = report.device.name.empty();  // diff renders nothing
    for (const Frame& frame : report.frames) paths.push_back(files ? frame.origin.file : frame.scene);
    return page::commonFolder(paths);
}

std::vector<std::size_t> failingFirst(const Report& report) {
    std::vector<std::size_t> order(report.comparisons.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, {}, [&](std::size_t i) { return report.comparisons[i].passed(); });
    return order;
}

std::vector<const ChannelDiff*> failuresFirst(const Comparison& comparison) {
    std::vector<const ChannelDiff*> channels;
    for (const ChannelDiff& channel : comparison.channels) channels.push_back(&channel);
    const auto rank = [](const ChannelDiff* c) {
        return c->verdict == Verdict::fail          ? 0
               : c->verdict == Verdict::informative ? 1
               : c->verdict == Verdict::pass        ? 2
                                                    : 3;
    };
    std::ranges::stable_sort(channels, {}, rank);
    return channels;
}

std::vector<const ChannelDiff*> leadingChannels(const Comparison& comparison) {
    std::vector<const ChannelDiff*> leading;
    const ChannelDiff *lit = nullptr, *first = nullptr;
    for (const ChannelDiff* channel : failuresFirst(comparison)) {
        if (channel->verdict == Verdict::fail) leading.push_back(channel);
        if (isCompared(channel->verdict) && channel->mode->name == "lit") lit = channel;
        if (isCompared(channel->verdict) && !first) first = channel;
    }
    if (!lit && leading.empty()) lit = first;
    if (lit && std::ranges::count(leading, lit) == 0)
        leading.insert(leading.begin() + std::min<std::ptrdiff_t>(std::ssize(leading), 1), lit);
    return leading;
}

std::vector<std::string> notesOf(const Report& report, const Comparison& comparison) {
    std::vector<std::string> notes;
    for (const auto* source :
         {&comparison.notes, &report.baseline(comparison).notes, &report.test(comparison).notes})
        for (const std::string& note : *source)
            if (std::ranges::count(notes, note) == 0) notes.push_back(note);
    return notes;
}

std::string checksLine(const Comparison& comparison) {
    std::uint64_t count = 0;
    std::vector<std::string> features;
    for (const FeatureChecks& feature : comparison.visual_checks) {
        count += feature.found;
        features.push_back(fmt::format("{} {}", feature.feature, feature.found));
    }
    if (count == 0) return {};
    return fmt::format("{} to check by eye: {}", counted(count, "place"), fmt::join(features, ", "));
}

std::string viewLabel(const Report& report, const Comparison& comparison) {
    const Frame& frame = report.baseline(comparison);
    const bool several = std::ranges::any_of(report.comparisons, [&](const Comparison& other) {
        return report.baseline(other).scene == frame.scene &&
               viewTitle(report, report.baseline(other)) != viewTitle(report, frame);
    });
    return several ? fmt::format("{}, {}", frame.scene, viewTitle(report, frame)) : frame.scene;
}

std::string withoutNumbers(const std::string& text) {
    std::string result;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const auto digit = [&](std::size_t k) { return k < text.size() && text[k] >= '0' && text[k] <= '9'; };
        const bool more = i > 0 && text[i] == '.' && digit(i - 1) && digit(i + 1);
        if (!digit(i) && !more)
            result += text[i];
        else if (!result.ends_with('#'))
            result += '#';
    }
    return result;
}

std::vector<GroupedNote> groupedNotes(const Report& report) {
    std::vector<GroupedNote> grouped;
    std::vector<std::map<std::string, std::string>> texts;  // of each group, by scene
    std::map<std::string, std::vector<std::size_t>> alike;  // groups with equal text apart from numbers
    for (const Comparison& comparison : report.comparisons)
        for (const std::string& note : notesOf(report, comparison)) {
            const std::string& scene = report.baseline(comparison).scene;
            // Two texts of one scene stay two notes.
            std::vector<std::size_t>& groups = alike[withoutNumbers(note)];
            const auto groupOf = [&](bool same) {
                const auto found = std::ranges::find_if(groups, [&](std::size_t i) {
                    return (!same || grouped[i].text == note) &&
                           (!texts[i].contains(scene) || texts[i].at(scene) == note);
                });
                return found == groups.end() ? grouped.size() : *found;
            };
            std::size_t at = groupOf(true);
            if (at == grouped.size()) at = groupOf(false);
            if (at == grouped.size()) {
                groups.push_back(at);
                grouped.push_back({note, {}});
                texts.emplace_back();
            }
            GroupedNote& group = grouped[at];
            group.varies = group.varies || group.text != note;
            if (texts[at].emplace(scene, note).second) group.scenes.push_back(scene);
        }
    return grouped;
}

std::string errorText(const SceneError& error) {
    return error.message.starts_with(error.scene) ? error.message
                                                  : fmt::format("{}: {}", error.scene, error.message);
}

std::string listed(const std::vector<std::string>& names, std::size_t max) {
    if (names.size() <= max) return fmt::format("{}", fmt::join(names, ", "));
    return fmt::format("{} and {} more",
                       fmt::join(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(max), ", "),
                       names.size() - max);
}

namespace {

void addOnce(std::vector<std::string>& words, const std::string& word) {
    if (std::ranges::count(words, word) == 0) words.push_back(word);
}

// Maximum number of scenes named in a line; the rest are counted.
constexpr std::size_t scenesNamed = 8;

std::string errorsText(const Report& report) {
    std::vector<std::string> scenes;
    bool images = false;  // an external renderer's image failed, not the scene
    for (const SceneError& error : report.errors) {
        images = images || !error.renderer.empty();
        scenes.push_back(error.renderer.empty() ? error.scene
                                                : fmt::format("{} of {}", error.scene, error.renderer));
    }
    const bool files = report.device.name.empty();  // diff renders nothing
    return fmt::format("{} could not be {}: {}",
                       counted(scenes.size(), files || images ? "picture" : "scene"),
                       files ? "compared" : "rendered", listed(scenes, scenesNamed));
}

// viewLabel(), and the pair if the view has several: "Box.glb b.exr/deferred".
std::string pairLabel(const Report& report, const Comparison& comparison) {
    const std::string location = viewLabel(report, comparison);
    if (!hasMultiplePairs(report) || report.device.name.empty()) return location;  // diff names files
    return fmt::format("{} {}/{}", location, report.baseline(comparison).name, report.test(comparison).name);
}

// A warning that belongs to a verdict about nearly empty images.
std::string hardlyAnything(const Report& report) {
    std::vector<std::string> labels, why;
    for (const Comparison& comparison : report.comparisons) {
        if (comparison.emptiness.empty()) continue;
        addOnce(labels, viewLabel(report, comparison));
        addOnce(why, comparison.emptiness);
    }
    if (why.empty()) return {};
    if (report.comparisons.size() > 1) return fmt::format(", but {}: {}", listed(labels, 3), listed(why, 1));
    return ", but " + why.front();
}

}  // namespace

std::string verdictLine(const Report& report) {
    std::size_t compared = 0, informative = 0, alone_on_a_side = 0, failing = 0;
    std::vector<std::string> others, channels, labels;
    for (const Comparison& comparison : report.comparisons) {
        for (const std::string& failure : comparison.failures) addOnce(others, failure);
        for (const ChannelDiff& channel : comparison.channels) {
            ++(channel.verdict == Verdict::informative ? informative
               : isCompared(channel.verdict)           ? compared
                                                       : alone_on_a_side);
            if (channel.verdict == Verdict::fail) addOnce(channels, std::string(channel.mode->name));
        }
        failing += !comparison.passed();
        if (!comparison.passed()) addOnce(labels, pairLabel(report, comparison));
    }
    const std::string errors = report.errors.empty() ? "" : fmt::format("ERROR: {}; ", errorsText(report));
    const std::size_t all = report.comparisons.size();
    std::vector<std::string> unpaired;
    for (const SceneError& failure : report.failures) unpaired.push_back(errorText(failure));
    const std::string alone = listed(unpaired, scenesNamed);
    if (failing == 0 && !alone.empty())
        return fmt::format("{}FAIL: {}{}", errors, alone, hardlyAnything(report));
    if (failing == 0)
        return fmt::format(
            "{}pass: {}{} within tolerance{}{}{}", errors,
            compared == 1 ? "the one compared channel" : fmt::format("all {} compared channels", compared),
            (all == 1 ? "" : fmt::format(" of {} comparisons", all)) + (compared == 1 ? " is" : " are"),
            informative == 0 ? ""
                             : fmt::format("; {} of light not counted: the paths' Settings differ",
                                           counted(informative, "channel")),
            alone_on_a_side == 0 ? "" : fmt::format(" ({} more exist on one side only)", alone_on_a_side),
            hardlyAnything(report));
    // A single comparison gets one sentence; several are counted, with the details in parentheses.
    std::string what = others.empty() ? "" : all == 1 ? listed(others, 1) : others.front();
    if (!channels.empty())
        what += fmt::format("{}{} beyond tolerance", what.empty() ? "" : "; ", fmt::join(channels, ", "));
    if (!alone.empty()) what += "; " + alone;
    what += hardlyAnything(report);
    if (all == 1) return fmt::format("{}FAIL: {}", errors, what);
    const std::string more =
        others.size() > 1 ? fmt::format(", and {} more", others.size() - 1) : std::string();
    return fmt::format("{}FAIL: {} of {} comparisons failed: {} ({}){}", errors, failing, all,
                       listed(labels, scenesNamed), what, more);
}

std::vector<std::pair<std::string, std::string>> notesWithScenes(const Report& report,
                                                                 const std::string& folder) {
    std::set<std::string> all;
    for (const Comparison& comparison : report.comparisons) all.insert(report.baseline(comparison).scene);
    std::vector<std::pair<std::string, std::string>> notes;
    for (const GroupedNote& note : groupedNotes(report)) {
        std::vector<std::string> names;
        for (const std::string& scene : note.scenes) names.push_back(page::inFolder(scene, folder));
        std::string about;
        if (all.size() > 1)
            about = names.size() == all.size() ? fmt::format("{} scenes", all.size()) : listed(names, 3);
        notes.emplace_back(about + (note.varies ? ", with different numbers" : ""), note.text);
    }
    return notes;
}

}  // namespace diptych
