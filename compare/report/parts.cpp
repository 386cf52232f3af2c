// SPDX-License-Identifier: MIT
#include "compare/report/parts.h"

#include "compare/files/our_files.h"
#include "compare/files/output.h"
#include "compare/files/output_folder.h"
#include "compare/report/encoder.h"
#include "compare/report/exposure_line.h"
#include "compare/report/html.h"
#include "compare/report/json.h"
#include "compare/report/report.h"
#include "compare/report/titles.h"
#include "shared/frame/debug_modes.h"
#include "shared/image/atomic_file.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <iterator>
#include <set>
#include <stdexcept>
#include <utility>

namespace diptych {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* partFile = "part.json";
// Arrays of report.json and the suites of junit.xml, as they stand there.
constexpr const char* partTexts[] = {"part-frames.json", "part-comparisons.json", "part-truth.json",
                                     "part-junit.xml"};

std::string partText(const Json& json) {
    return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

// Names of features are the program's own and live as long as it does; those of a file must, too.
std::string_view kept(const std::string& name) {
    static std::set<std::string> names;
    return *names.insert(name).first;
}

Json summaryOf(const Frame& frame) {
    Json settings = Json::object();
    for (const char* option : {"camera", "time", "size", "gbuffer"})
        settings[option] = frame.settings.valueOf(option);
    return {{"name", frame.name},   {"scene", frame.scene},          {"camera", frame.camera.name},
            {"settings", settings}, {"device", frame.origin.device}, {"notes", frame.notes}};
}

Frame frameFrom(const nlohmann::json& json) {
    Frame frame;
    frame.name = json.at("name");
    frame.scene = json.at("scene");
    frame.camera.name = json.at("camera");
    frame.origin.device = json.at("device");
    for (const auto& [option, value] : json.at("settings").items())
        frame.settings.set(option, value.get<std::string>());
    frame.notes = json.at("notes").get<std::vector<std::string>>();
    return frame;
}

constexpr Verdict verdicts[] = {Verdict::pass, Verdict::fail, Verdict::forward_only, Verdict::deferred_only};

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

Comparison comparisonFrom(const nlohmann::json& json) {
    Comparison comparison;
    comparison.baseline = json.at("frames").at(0);
    comparison.test = json.at("frames").at(1);
    comparison.failures = json.at("failures").get<std::vector<std::string>>();
    comparison.notes = json.at("notes").get<std::vector<std::string>>();
    comparison.emptiness = json.at("emptiness");
    for (const auto& c : json.at("channels")) {
        ChannelDiff& channel = comparison.channels.emplace_back();
        channel.mode = &debugMode(c.at(0).get<int>());
        for (const Verdict verdict : verdicts)
            if (nameOf(verdict) == c.at(1).get<std::string>()) channel.verdict = verdict;
        channel.reason = c.at(2);
        channel.warning = c.at(3);
    }
    for (const auto& check : json.at("checks"))
        comparison.visual_checks.push_back({kept(check.at(0).get<std::string>()), check.at(1), {}});
    return comparison;
}

ReportDevice deviceFrom(const nlohmann::json& json) {
    return {json.at("name"), json.at("driver"), json.at("type")};
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

ReportPart partFrom(const nlohmann::json& json) {
    ReportPart part;
    Report& report = part.report;
    report.device = deviceFrom(json.at("device"));
    report.against = deviceFrom(json.at("against"));
    for (const auto& frame : json.at("frames")) report.frames.push_back(frameFrom(frame));
    for (const auto& comparison : json.at("comparisons"))
        report.comparisons.push_back(comparisonFrom(comparison));
    for (const auto& closer : json.at("closer")) {
        CloserPath& of = report.closer_paths.emplace_back();
        of.reference = closer.at(0);
        of.paths = {closer.at(1).get<std::size_t>(), closer.at(2).get<std::size_t>()};
    }
    report.diff_ms = json.at("compare_ms");
    part.encode_ms = json.at("encode_ms");
    const auto strings = [&](const char* key) { return json.at(key).get<std::vector<std::string>>(); };
    part.tables = strings("tables");
    part.closer_tables = strings("closer_tables");
    part.closer_boxes = strings("closer_boxes");
    for (const auto& row : json.at("rows")) part.rows.push_back(indexRowFromJson(row));
    for (const auto& exposure : json.at("exposures")) {
        Exposure& of = part.exposures.emplace_back();
        of.factor = exposure.at(0);
        of.because = exposure.at(1);
    }
    part.sections = strings("sections");
    part.files = strings("files");
    part.junit.tests = json.at("junit").at(0);
    part.junit.failures = json.at("junit").at(1);
    part.junit.seconds = json.at("junit").at(2);
    return part;
}

std::string readText(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    std::string text(std::istreambuf_iterator<char>(stream), {});
    if (!stream.is_open()) throw std::runtime_error(fmt::format("{}: cannot be read", file.string()));
    return text;
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

// The section that a part's script holds.
std::string sectionIn(const fs::path& script) {
    const std::string text = readText(script);
    const std::size_t open = text.find('('), close = text.rfind(')');
    const nlohmann::json words =
        open < close && close != text.npos
            ? nlohmann::json::parse("[" + text.substr(open + 1, close - open - 1) + "]", nullptr, false)
            : nlohmann::json();
    if (!words.is_array() || words.size() != 2 || !words[1].is_string())
        throw std::runtime_error(fmt::format("{}: is no section of a report", script.string()));
    return words[1];
}

// The parts' devices, in their order.
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
    layout.exr = std::move(files);  // whatever there is: files() lists it
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
    // The summary is written from the report itself and read back, so that both ways give the same.
    ReportPart whole = part;
    whole.report = report;
    const Json json = jsonOf(whole);
    writeFile(root / (part.scene_folder + partFile), partText(json));
    ReportPart read = partFrom(json);
    read.scene_folder = part.scene_folder;
    return read;
}

bool isPartThere(const fs::path& root, const std::string& scene_folder) {
    return isOurManifest(root / (scene_folder + partFile));
}

ReportPart readPart(const fs::path& root, const std::string& scene_folder) {
    const fs::path file = root / (scene_folder + partFile);
    try {
        ReportPart part = partFrom(nlohmann::json::parse(readText(file)));
        part.scene_folder = scene_folder;
        return part;
    } catch (const nlohmann::json::exception&) {
        throw std::runtime_error(
            fmt::format("{}: is no part of a report, or of another version", file.string()));
    }
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
        std::string text = sectionIn(places[index].part->root / places[index].section);
        replaceAll(text, numberLater, layout.ids[index]);
        replaceAll(text, titleLater, sectionTitle(summary, layout, index));
        return text;
    };
    // A text of each part, one after the other; `inner`: as it stands in there.
    const auto each = [&](std::size_t text, const std::function<void(std::string)>& give) {
        for (const PlacedPart& placed : whole.parts)
            give(readText(placed.root / (placed.part.scene_folder + partTexts[text])));
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
                if (listed.contains(name)) linkOrCopy(placed.root / name, folder / name);
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
