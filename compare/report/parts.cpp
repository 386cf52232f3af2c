// SPDX-License-Identifier: MIT
#include "compare/report/parts.h"

#include "compare/files/diptych_files.h"
#include "compare/files/frame_json.h"
#include "compare/output/policy.h"
#include "compare/output/writers.h"
#include "compare/page/emitted.h"
#include "compare/report/document.h"
#include "compare/report/encoder.h"
#include "compare/report/exposure_line.h"
#include "compare/report/json.h"
#include "compare/report/report.h"
#include "shared/frame/debug_modes.h"
#include "shared/image/atomic_file.h"
#include "shared/text/fail.h"
#include "shared/text/input_file.h"
#include "shared/text/json.h"
#include "shared/text/json_at.h"
#include "shared/text/json_text.h"
#include "shared/text/named.h"
#include "shared/text/one_line.h"
#include "shared/text/open_folder.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <iterator>
#include <set>
#include <stdexcept>
#include <utility>

namespace diptych {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

using JsonValue = JsonAt<nlohmann::json>;

constexpr const char* partFile = "part.json";
constexpr int partSchema = 2;  // 2: sections fit this version's style and scripts
// As for readPartText().
constexpr const char* partTexts[] = {"part-frames.json", "part-comparisons.json", "part-truth.json",
                                     "part-junit.xml"};

// Limit for counts of pixels, checks and tests: sums stay exact in 64 bits and in a double.
constexpr std::uint64_t max_counted = std::uint64_t(1) << 48;

std::string partText(const Json& json) {
    return jsonText(json, 1) + "\n";
}

// Feature names are views of static strings; names from a file are interned to live as long.
std::string_view kept(const std::string& name) {
    static std::set<std::string> names;
    return *names.insert(name).first;
}

constexpr const char* summarySettings[] = {"camera", "time", "size", "gbuffer"};

Json summaryOf(const Frame& frame) {
    Json settings = Json::object();
    for (const char* option : summarySettings) settings[option] = frame.settings.valueOf(option);
    return {{"name", frame.name},   {"scene", frame.scene},          {"camera", frame.camera.name},
            {"settings", settings}, {"device", frame.origin.device}, {"notes", frame.notes}};
}

Frame frameFrom(const JsonValue& json) {
    Frame frame;
    frame.name = json.at("name").text();
    frame.scene = json.at("scene").text();
    frame.camera.name = json.at("camera").text();
    frame.origin.device = json.at("device").text();
    for (const char* option : summarySettings)
        frame.settings.set(option, json.at("settings").at(option).text());
    frame.notes = json.at("notes").texts();
    return frame;
}

constexpr Verdict verdicts[] = {Verdict::pass, Verdict::fail, Verdict::forward_only, Verdict::deferred_only,
                                Verdict::informative};

Json summaryOf(const Comparison& comparison) {
    Json channels = Json::array(), checks = Json::array();
    for (const ChannelDiff& channel : comparison.channels)
        channels.push_back({channel.mode->channel, nameOf(channel.verdict), channel.reason, channel.warning});
    for (const FeatureChecks& feature : comparison.visual_checks)
        checks.push_back({feature.feature, feature.found});
    return {{"frames", {comparison.baseline, comparison.test}},
            {"failures", comparison.failures},
            {"notes", comparison.notes},
            {"emptiness", comparison.emptiness},
            {"channels", channels},
            {"checks", checks}};
}

Verdict verdictFrom(const JsonValue& json) {
    const auto found = std::ranges::find(verdicts, json.text(), [](Verdict v) { return nameOf(v); });
    if (found == std::end(verdicts)) json.fail("is not a verdict");
    return *found;
}

Comparison comparisonFrom(const JsonValue& json, std::size_t frames) {
    Comparison comparison;
    comparison.baseline = json.at("frames")[0].index(frames);
    comparison.test = json.at("frames")[1].index(frames);
    comparison.failures = json.at("failures").texts();
    comparison.notes = json.at("notes").texts();
    comparison.emptiness = json.at("emptiness").text();
    for (const JsonValue& c : json.at("channels").each()) {
        ChannelDiff& channel = comparison.channels.emplace_back();
        channel.mode = &debugModeFrom(c[0]);
        channel.verdict = verdictFrom(c[1]);
        channel.reason = c[2].text();
        channel.warning = c[3].text();
    }
    for (const JsonValue& check : json.at("checks").each())
        comparison.visual_checks.push_back(
            {kept(check[0].text()), check[1].whole<std::uint64_t>(0, max_counted), {}});
    return comparison;
}

ReportDevice deviceFrom(const JsonValue& json) {
    return {json.at("name").text(), json.at("driver").text(), json.at("type").text()};
}

Json jsonOf(const ReportPart& part) {
    const Report& report = part.report;
    Json frames = Json::array(), comparisons = Json::array(), closer = Json::array();
    Json rows = Json::array(), exposures = Json::array();
    for (const Frame& frame : report.frames) frames.push_back(summaryOf(frame));
    for (const Comparison& comparison : report.comparisons) comparisons.push_back(summaryOf(comparison));
    for (const CloserPath& of : report.closer_paths)
        closer.push_back({of.reference, of.paths[0], of.paths[1]});
    for (const IndexRow& row : part.rows) rows.push_back(jsonOf(row));
    for (const Exposure& exposure : part.exposures) exposures.push_back({exposure.factor, exposure.because});
    return {{"schema", partSchema},
            {"software", softwareName},
            {"device", jsonOf(report.device)},
            {"against", jsonOf(report.against)},
            {"frames", frames},
            {"comparisons", comparisons},
            {"closer", closer},
            {"compare_ms", report.diff_ms},
            {"encode_ms", part.encode_ms},
            {"tables", part.tables},
            {"closer_tables", part.closer_tables},
            {"closer_boxes", part.closer_boxes},
            {"rows", rows},
            {"exposures", exposures},
            {"sections", part.sections},
            {"files", part.files},
            {"junit", {part.junit.tests, part.junit.failures, part.junit.seconds}}};
}

// Checks file names of the part: unique, in the scene's folder, and of one of the kinds.
std::vector<std::string> namesFrom(const JsonValue& json, const std::string& scene_folder,
                                   std::set<std::string>& taken, std::initializer_list<const char*> endings) {
    for (const JsonValue& value : json.each()) {
        const std::string& name = value.text();
        if (!isDiptychFileName(name) || !name.starts_with(scene_folder))
            value.fail(
                fmt::format("\"{}\" is not a file in the report folder \"{}\"", oneLine(name), scene_folder));
        if (!taken.insert(name).second) value.fail(fmt::format("\"{}\" is listed twice", name));
        if (std::ranges::none_of(endings, [&](const char* ending) { return name.ends_with(ending); }))
            value.fail(fmt::format("\"{}\" is of a kind that a report does not list here", name));
    }
    return json.texts();
}

// Checks that the list has `count` elements, one for each `of`.
template <class List>
void checkCount(const JsonValue& json, const char* key, const List& list, std::size_t count, const char* of) {
    if (list.size() != count)
        json.at(key).fail(fmt::format("has {} elements, but there are {} {}", list.size(), count, of));
}

// Checks every index and everything that belongs to a comparison; joining parts relies on it.
ReportPart partFrom(const JsonValue& json, const std::string& scene_folder) {
    ReportPart part;
    part.scene_folder = scene_folder;
    if (json.at("schema").number() != partSchema)
        json.at("schema").fail("is that of another version of Diptych; compare the scene again");
    Report& report = part.report;
    report.device = deviceFrom(json.at("device"));
    report.against = deviceFrom(json.at("against"));
    for (const JsonValue& frame : json.at("frames").each()) report.frames.push_back(frameFrom(frame));
    const std::size_t frames = report.frames.size();
    for (const JsonValue& comparison : json.at("comparisons").each())
        report.comparisons.push_back(comparisonFrom(comparison, frames));
    for (const JsonValue& closer : json.at("closer").each()) {
        CloserPath& of = report.closer_paths.emplace_back();
        of.reference = closer[0].index(frames);
        of.paths = {closer[1].index(frames), closer[2].index(frames)};
    }
    report.diff_ms = json.at("compare_ms").number();
    part.encode_ms = json.at("encode_ms").number();
    part.tables = json.at("tables").texts();
    part.closer_tables = json.at("closer_tables").texts();
    part.closer_boxes = json.at("closer_boxes").texts();
    for (const JsonValue& row : json.at("rows").each()) part.rows.push_back(indexRowFrom(row));
    for (const JsonValue& exposure : json.at("exposures").each()) {
        Exposure& of = part.exposures.emplace_back();
        of.factor = exposure[0].number();
        of.because = exposure[1].text();
    }
    const std::vector<std::string> texts = part.texts();
    std::set<std::string> taken(texts.begin(), texts.end());
    part.sections = namesFrom(json.at("sections"), scene_folder, taken, {".section.js"});
    part.files = namesFrom(json.at("files"), scene_folder, taken, {".png", ".exr", ".values.js"});
    part.junit.tests = json.at("junit")[0].whole<std::size_t>(0, max_counted);
    part.junit.failures = json.at("junit")[1].whole<std::size_t>(0, max_counted);
    part.junit.seconds = json.at("junit")[2].number();
    const std::size_t comparisons = report.comparisons.size(), closer = report.closer_paths.size();
    checkCount(json, "tables", part.tables, comparisons, "comparisons");
    checkCount(json, "rows", part.rows, comparisons, "comparisons");
    checkCount(json, "exposures", part.exposures, comparisons, "comparisons");
    checkCount(json, "sections", part.sections, comparisons, "comparisons");
    checkCount(json, "closer_tables", part.closer_tables, closer, "paths compared with a reference");
    checkCount(json, "closer_boxes", part.closer_boxes, closer, "paths compared with a reference");
    return part;
}

void makeFolders(const fs::path& root, const std::vector<std::string>& files) {
    for (const std::string& name : files) {
        const fs::path folder = (root / name).parent_path();
        if (!OpenFolder::made(folder).isOpen()) throw std::runtime_error(writingFailed(folder, errno));
    }
}

// Checks that all files of the part exist and are valid, so that joining cannot fail on them later.
void checkFiles(const fs::path& root, const ReportPart& part) {
    for (const std::vector<std::string>& names : {part.files, part.sections})
        for (const std::string& name : names)
            named((root / name).string(), [&] {
                // The joined page runs these scripts, so they must be data.
                if (name.ends_with(".js") && !isDataScript(textBelow(root, name, json_bytes)))
                    fail("is a script that contains more than data");
                return InputFile(root, name).size();
            });
    for (const std::string& name : part.sections) {
        const std::string html = sectionIn(root, name);
        named((root / name).string(), [&] { page::checkMarkup(html); });
    }
    for (const std::string& box : part.closer_boxes)
        named((root / part.texts().front()).string() + ": closer_boxes", [&] { page::checkMarkup(box); });
    for (std::size_t i = 0; i < std::size(partTexts); ++i) {
        const std::string name = part.scene_folder + partTexts[i];
        const std::string inner = readPartText(root, part, i);
        named((root / name).string(), [&] {
            if (name.ends_with(".json"))
                checkJson("[" + inner + "]");
            else
                page::checkSuites(inner);
        });
    }
}

}  // namespace

std::vector<std::string> ReportPart::texts() const {
    std::vector<std::string> names{scene_folder + partFile};
    for (const char* name : partTexts) names.push_back(scene_folder + name);
    return names;
}

ReportPart writePart(const Report& report, const fs::path& root, const ReportOptions& options) {
    ReportPart part;
    part.scene_folder = options.scene_folder.value();
    const auto start = std::chrono::steady_clock::now();
    ReportLayout layout = layoutOf(report, options);
    makeFolders(root, layout.files());
    makeFolders(root, layout.sections);
    makeFolders(root, part.texts());
    encode(report, layout, root, options.progress);
    layout.encode_ms = part.encode_ms = msSince(start);
    const ReportTexts texts = textsOf(report, layout);
    part.report.device = report.device;
    part.report.against = report.against;
    part.report.diff_ms = report.diff_ms;
    part.rows = texts.rows;
    part.closer_boxes = texts.closer_boxes;
    part.sections = layout.sections;
    ReportLayout images = layout;
    images.sections.clear();
    if (!layout.single_file) {
        part.files = images.files();
        std::erase_if(part.files, [](const std::string& name) {
            return name.find('/') == name.npos &&
                   (name == "index.html" || name == "junit.xml" || name == "report.json");
        });
    }
    const ReportLayout named = onDisk(layout);
    for (std::size_t i = 0; i < report.comparisons.size(); ++i) {
        writeFile(root / layout.sections[i], sectionScript(report, layout, i));
        part.junit += junitSuite(report, named, std::string(folderLater), i);
        part.tables.push_back(inText(comparisonBlocks(report, nullptr, i)));
        part.exposures.push_back(exposureOf(report, report.comparisons[i], options.image));
    }
    for (std::size_t i = 0; i < report.closer_paths.size(); ++i)
        part.closer_tables.push_back(inText(closerPathBlocks(report, nullptr, i, true)));
    for (std::size_t i = 0; i < std::size(partTexts); ++i)
        writeFile(root / (part.scene_folder + partTexts[i]),
                  i == junitText ? part.junit.xml : arrayText(report, &layout, i));
    // Serializes the full report and reads it back, so that both ways give the same result.
    ReportPart whole = part;
    whole.report = report;
    const Json json = jsonOf(whole);
    writeFile(root / (part.scene_folder + partFile), partText(json));
    const nlohmann::json written = json;
    return partFrom(JsonValue(written), part.scene_folder);
}

bool isPartThere(const fs::path& root, const std::string& scene_folder) {
    return isDiptychManifest(root / (scene_folder + partFile));
}

ReportPart readPart(const fs::path& root, const std::string& scene_folder) {
    const std::string name = scene_folder + partFile;
    ReportPart part = named((root / name).string(), [&] {
        return partFrom(JsonValue(parseJson(textBelow(root, name, json_bytes))), scene_folder);
    });
    checkFiles(root, part);
    return part;
}

std::string readPartText(const fs::path& root, const ReportPart& part, std::size_t text) {
    const std::string name = part.scene_folder + partTexts[text];
    return named((root / name).string(), [&] { return textBelow(root, name, json_bytes); });
}

std::string sectionIn(const fs::path& root, const std::string& script) {
    return named((root / script).string(), [&]() -> std::string {
        const std::string text = textBelow(root, script, json_bytes);
        const std::size_t open = text.find('('), close = text.rfind(')');
        if (open >= close || close == text.npos) fail("is not a report section");
        const nlohmann::json words = parseJson("[" + text.substr(open + 1, close - open - 1) + "]");
        if (words.size() != 2 || words[0] != script || !words[1].is_string()) fail("is not a report section");
        return words[1];
    });
}

}  // namespace diptych
