// SPDX-License-Identifier: MIT
#include "compare/report/parts.h"

#include "compare/files/our_files.h"
#include "compare/files/output.h"
#include "compare/files/output_folder.h"
#include "compare/report/encoder.h"
#include "compare/report/exposure_line.h"
#include "compare/report/html.h"
#include "compare/report/json.h"
#include "compare/report/policy.h"
#include "compare/report/report.h"
#include "compare/report/titles.h"
#include "shared/frame/debug_modes.h"
#include "shared/image/atomic_file.h"
#include "shared/text/fail.h"
#include "shared/text/input_file.h"
#include "shared/text/json.h"
#include "shared/text/json_at.h"
#include "shared/text/json_text.h"
#include "shared/text/named.h"
#include "shared/text/one_line.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <iterator>
#include <set>
#include <stdexcept>
#include <utility>

namespace diptych {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

using Place = JsonAt<nlohmann::json>;

constexpr const char* partFile = "part.json";
// Arrays of report.json and suites of junit.xml, in their final form.
constexpr const char* partTexts[] = {"part-frames.json", "part-comparisons.json", "part-truth.json",
                                     "part-junit.xml"};

// Limit for counts of pixels, checks and tests: sums stay exact in 64 bits and in a double.
constexpr std::uint64_t most_counted = std::uint64_t(1) << 48;

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

Frame frameFrom(const Place& json) {
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
        channels.push_back({channel.mode->number, nameOf(channel.verdict), channel.reason, channel.warning});
    for (const FeatureChecks& feature : comparison.visual_checks)
        checks.push_back({feature.feature, feature.found});
    return {{"frames", {comparison.baseline, comparison.test}},
            {"failures", comparison.failures},
            {"notes", comparison.notes},
            {"emptiness", comparison.emptiness},
            {"channels", channels},
            {"checks", checks}};
}

Verdict verdictFrom(const Place& json) {
    const auto found = std::ranges::find(verdicts, json.text(), [](Verdict v) { return nameOf(v); });
    if (found == std::end(verdicts)) json.fail("is not a verdict");
    return *found;
}

Comparison comparisonFrom(const Place& json, std::size_t frames) {
    Comparison comparison;
    comparison.baseline = json.at("frames")[0].index(frames);
    comparison.test = json.at("frames")[1].index(frames);
    comparison.failures = json.at("failures").texts();
    comparison.notes = json.at("notes").texts();
    comparison.emptiness = json.at("emptiness").text();
    for (const Place& c : json.at("channels").each()) {
        ChannelDiff& channel = comparison.channels.emplace_back();
        channel.mode = &debugModeFrom(c[0]);
        channel.verdict = verdictFrom(c[1]);
        channel.reason = c[2].text();
        channel.warning = c[3].text();
    }
    for (const Place& check : json.at("checks").each())
        comparison.visual_checks.push_back(
            {kept(check[0].text()), check[1].whole<std::uint64_t>(0, most_counted), {}});
    return comparison;
}

ReportDevice deviceFrom(const Place& json) {
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
    return {{"schema", 1},
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

// Checks file names of the part: unique, in one of our own formats, and in the scene's folder.
std::vector<std::string> namesFrom(const Place& json, const std::string& scene_folder,
                                   std::set<std::string>& taken) {
    for (const Place& place : json.each()) {
        const std::string& name = place.text();
        if (!isOurName(name) || !name.starts_with(scene_folder))
            place.fail(
                fmt::format("\"{}\" is not a file in the report folder \"{}\"", oneLine(name), scene_folder));
        if (!taken.insert(name).second) place.fail(fmt::format("\"{}\" is listed twice", name));
    }
    return json.texts();
}

// Checks that the list has `count` elements, one for each `of`.
template <class List>
void checkCount(const Place& json, const char* key, const List& list, std::size_t count, const char* of) {
    if (list.size() != count)
        json.at(key).fail(fmt::format("has {} elements, but there are {} {}", list.size(), count, of));
}

// Checks every index and everything that belongs to a comparison; joining parts relies on it.
ReportPart partFrom(const Place& json, const std::string& scene_folder) {
    ReportPart part;
    part.scene_folder = scene_folder;
    Report& report = part.report;
    report.device = deviceFrom(json.at("device"));
    report.against = deviceFrom(json.at("against"));
    for (const Place& frame : json.at("frames").each()) report.frames.push_back(frameFrom(frame));
    const std::size_t frames = report.frames.size();
    for (const Place& comparison : json.at("comparisons").each())
        report.comparisons.push_back(comparisonFrom(comparison, frames));
    for (const Place& closer : json.at("closer").each()) {
        CloserPath& of = report.closer_paths.emplace_back();
        of.reference = closer[0].index(frames);
        of.paths = {closer[1].index(frames), closer[2].index(frames)};
    }
    report.diff_ms = json.at("compare_ms").number();
    part.encode_ms = json.at("encode_ms").number();
    part.tables = json.at("tables").texts();
    part.closer_tables = json.at("closer_tables").texts();
    part.closer_boxes = json.at("closer_boxes").texts();
    for (const Place& row : json.at("rows").each()) part.rows.push_back(indexRowFrom(row));
    for (const Place& exposure : json.at("exposures").each()) {
        Exposure& of = part.exposures.emplace_back();
        of.factor = exposure[0].number();
        of.because = exposure[1].text();
    }
    const std::vector<std::string> texts = part.texts();
    std::set<std::string> taken(texts.begin(), texts.end());
    part.sections = namesFrom(json.at("sections"), scene_folder, taken);
    part.files = namesFrom(json.at("files"), scene_folder, taken);
    part.junit.tests = json.at("junit")[0].whole<std::size_t>(0, most_counted);
    part.junit.failures = json.at("junit")[1].whole<std::size_t>(0, most_counted);
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

std::string readText(const fs::path& root, const std::string& name) {
    return named((root / name).string(), [&] { return textBelow(root, name, json_bytes); });
}

void makeFolders(const fs::path& root, const std::vector<std::string>& files) {
    for (const std::string& name : files) {
        std::error_code error;
        const fs::path folder = (root / name).parent_path();
        fs::create_directories(folder, error);
        if (error) throw std::runtime_error(fmt::format("{}: {}", folder.string(), error.message()));
    }
}

void replaceAll(std::string& text, std::string_view what, const std::string& by) {
    for (std::size_t at = text.find(what); at != text.npos; at = text.find(what, at + by.size()))
        text.replace(at, what.size(), by);
}

// The section inside a part's script.
std::string sectionIn(const fs::path& root, const std::string& script) {
    return named((root / script).string(), [&]() -> std::string {
        const std::string text = textBelow(root, script, json_bytes);
        const std::size_t open = text.find('('), close = text.rfind(')');
        if (open >= close || close == text.npos) fail("is not a report section");
        const nlohmann::json words = parseJson("[" + text.substr(open + 1, close - open - 1) + "]");
        if (words.size() != 2 || !words[1].is_string()) fail("is not a report section");
        return words[1];
    });
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
    for (const std::string& name : part.sections) sectionIn(root, name);
    for (const char* text : partTexts) {
        const std::string name = part.scene_folder + text;
        const std::string inner = readText(root, name);
        if (name.ends_with(".json")) named((root / name).string(), [&] { checkJson("[" + inner + "]"); });
    }
}

// The parts' devices, in order of first use.
std::vector<DrawnOn> devicesOf(const WholeReport& whole) {
    std::vector<DrawnOn> devices;
    for (const PlacedPart& placed : whole.parts) {
        const ReportDevice& device = placed.part.report.device;
        auto at = std::ranges::find_if(devices, [&](const DrawnOn& one) {
            return one.device.name == device.name && one.device.driver == device.driver &&
                   one.device.type == device.type;
        });
        if (at == devices.end()) at = devices.insert(at, {device});
        at->comparisons += placed.part.report.comparisons.size();
        at->compare_ms += placed.part.report.diff_ms;
        at->encode_ms += placed.part.encode_ms;
    }
    return devices;
}

ReportLayout layoutOf(const WholeReport& whole, const Report& summary, const ReportOptions& options) {
    ReportLayout layout;
    layout.single_file = options.single_file;
    layout.keep = options.keep;
    layout.folder = folderOfAll(summary);
    layout.order = failingFirst(summary);
    std::vector<std::string> files;
    for (const PlacedPart& placed : whole.parts) {
        const ReportPart& part = placed.part;
        layout.sections.insert(layout.sections.end(), part.sections.begin(), part.sections.end());
        if (!options.single_file) files.insert(files.end(), part.files.begin(), part.files.end());
    }
    for (std::size_t i = 0; i < layout.sections.size(); ++i) layout.ids.push_back(std::to_string(i));
    if (whole.shard.empty()) {
        const std::size_t inPage = options.single_file ? layout.order.size() : comparisonsInPage;
        for (std::size_t at = 0; at < std::min(layout.order.size(), inPage); ++at)
            layout.sections[layout.order[at]].clear();
    } else {
        for (const PlacedPart& placed : whole.parts)
            for (const std::string& name : placed.part.texts()) files.push_back(name);
        files.emplace_back(shardManifest);
    }
    layout.exr = std::move(files);  // order does not matter: files() lists them
    return layout;
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
    layout.encode_ms = part.encode_ms =
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    const ReportTexts texts = textsOf(report, layout);
    part.report.device = report.device;
    part.report.against = report.against;
    part.report.diff_ms = report.diff_ms;
    part.rows = texts.rows;
    part.closer_boxes = texts.closer_boxes;
    part.sections = layout.sections;
    ReportLayout pictures = layout;
    pictures.sections.clear();
    if (!layout.single_file) {
        part.files = pictures.files();
        std::erase_if(part.files, [](const std::string& name) {
            return name.find('/') == name.npos &&
                   (name == "index.html" || name == "junit.xml" || name == "report.json");
        });
    }
    std::string junit;
    const ReportLayout named = onDisk(layout);
    for (std::size_t i = 0; i < report.comparisons.size(); ++i) {
        writeFile(root / layout.sections[i], sectionScript(report, layout, i));
        const JunitSuite suite = junitSuite(report, named, std::string(folderLater), i);
        junit += suite.xml;
        part.junit.tests += suite.tests;
        part.junit.failures += suite.failures;
        part.junit.seconds += suite.seconds;
        part.tables.push_back(comparisonTable(report, report.comparisons[i]));
        part.exposures.push_back(exposureOf(report, report.comparisons[i], options.picture));
    }
    for (const CloserPath& closer : report.closer_paths)
        part.closer_tables.push_back(closerTable(report, closer, true));
    const std::string texts_of_part[] = {innerJson(framesJson(report, &layout)),
                                         innerJson(comparisonsJson(report)), innerJson(truthJson(report)),
                                         junit};
    for (std::size_t i = 0; i < std::size(partTexts); ++i)
        writeFile(root / (part.scene_folder + partTexts[i]), texts_of_part[i]);
    // Serializes the full report and reads it back, so that both ways give the same result.
    ReportPart whole = part;
    whole.report = report;
    const Json json = jsonOf(whole);
    writeFile(root / (part.scene_folder + partFile), partText(json));
    const nlohmann::json written = json;
    return partFrom(Place(written), part.scene_folder);
}

bool isPartThere(const fs::path& root, const std::string& scene_folder) {
    return isOurManifest(root / (scene_folder + partFile));
}

ReportPart readPart(const fs::path& root, const std::string& scene_folder) {
    const std::string name = scene_folder + partFile;
    ReportPart part = named((root / name).string(), [&] {
        return partFrom(Place(parseJson(textBelow(root, name, json_bytes))), scene_folder);
    });
    checkFiles(root, part);
    return part;
}

std::vector<IndexRow> rowsOf(const WholeReport& whole) {
    std::vector<IndexRow> rows;
    for (const PlacedPart& placed : whole.parts)
        rows.insert(rows.end(), placed.part.rows.begin(), placed.part.rows.end());
    return rows;
}

Report summaryOf(const WholeReport& whole) {
    Report all;
    for (const PlacedPart& placed : whole.parts) {
        const Report& report = placed.part.report;
        if (all.device.name.empty()) all.device = report.device;
        if (all.against.name.empty()) all.against = report.against;
        const std::size_t first = all.frames.size();
        all.frames.insert(all.frames.end(), report.frames.begin(), report.frames.end());
        for (Comparison comparison : report.comparisons) {
            comparison.baseline += first;
            comparison.test += first;
            all.comparisons.push_back(std::move(comparison));
        }
        for (CloserPath closer : report.closer_paths) {
            closer.reference += first;
            for (std::size_t& path : closer.paths) path += first;
            all.closer_paths.push_back(std::move(closer));
        }
    }
    all.errors = whole.errors;
    return all;
}

void writeWhole(const WholeReport& whole, const Report& summary, const fs::path& path,
                const ReportOptions& options) {
    constexpr const char* manifest = "report.json";
    const ReportLayout layout = layoutOf(whole, summary, options);
    const std::vector<DrawnOn> devices = devicesOf(whole);
    struct Place {
        const PlacedPart* part;
        std::string section;
    };
    std::vector<Place> places;
    ReportTexts texts;
    JunitSuite totals;
    texts.devices = devices;
    texts.rows = rowsOf(whole);
    texts.since = options.since;
    for (const PlacedPart& placed : whole.parts) {
        const ReportPart& part = placed.part;
        texts.closer_boxes.insert(texts.closer_boxes.end(), part.closer_boxes.begin(),
                                  part.closer_boxes.end());
        for (const std::string& section : part.sections) places.push_back({&placed, section});
        totals.tests += part.junit.tests;
        totals.failures += part.junit.failures;
        totals.seconds += part.junit.seconds;
    }
    texts.section = [&](std::size_t index) {
        std::string text = sectionIn(places[index].part->root, places[index].section);
        replaceAll(text, numberLater, layout.ids[index]);
        replaceAll(text, titleLater, sectionTitle(summary, layout, index));
        return text;
    };
    // Reads one text of each part, one after the other.
    const auto each = [&](std::size_t text, const std::function<void(std::string)>& give) {
        for (const PlacedPart& placed : whole.parts)
            give(readText(placed.root, placed.part.scene_folder + partTexts[text]));
    };
    const auto array = [&](std::size_t text) {
        return
            [&each, text](const JsonSink& add) { each(text, [&](const std::string& inner) { add(inner); }); };
    };

    OutputFolder folder(path);
    const std::vector<std::string> files = layout.files();
    folder.makeFolders(files);
    const std::set<std::string> listed(files.begin(), files.end());
    for (const PlacedPart& placed : whole.parts)
        for (const std::vector<std::string>& names :
             {placed.part.files, placed.part.sections, placed.part.texts()})
            for (const std::string& name : names)
                if (listed.contains(name))
                    (placed.kept ? linkOrCopy : copyBelow)(placed.root, name, folder / name);
    const auto write = [&](const std::string& name, const std::function<void(const JsonSink&)>& make) {
        AtomicFile file(folder / name);
        make([&](std::string_view text) { std::fwrite(text.data(), 1, text.size(), file.stream()); });
        file.commit();
    };
    write(manifest, [&](const JsonSink& sink) {
        writeReportJson(summary, &layout, devices, options.since.get(), {array(0), array(1), array(2)}, sink);
    });
    write("junit.xml", [&](const JsonSink& sink) {
        writeJunit(
            summary, totals,
            [&](const JsonSink& add) {
                each(3, [&](std::string suites) {
                    replaceAll(suites, folderLater, junitFolder(path));
                    add(suites);
                });
            },
            sink);
    });
    if (!whole.shard.empty()) writeFile(folder / shardManifest, whole.shard);
    writeFile(folder / "index.html", reportHtml(summary, layout, texts));
    folder.put(files, [&] {
        checkReplaceable({OutputKind::folder, path}, manifest, options.force);
        return manifestFiles(path, manifest);
    });
}

std::string wholeTable(const WholeReport& whole, const Report& summary, bool all) {
    std::string out;
    for (const PlacedPart& placed : whole.parts)
        for (std::size_t i = 0; i < placed.part.tables.size(); ++i)
            if (all || !placed.part.report.comparisons[i].passed()) out += placed.part.tables[i];
    if (all)
        for (const PlacedPart& placed : whole.parts)
            for (const std::string& text : placed.part.closer_tables) out += text;
    return out + tableEnd(summary);
}

std::string wholeExposureLine(const WholeReport& whole) {
    std::vector<Exposure> exposures;
    for (const PlacedPart& placed : whole.parts)
        exposures.insert(exposures.end(), placed.part.exposures.begin(), placed.part.exposures.end());
    return exposureLine(exposures);
}

}  // namespace diptych
