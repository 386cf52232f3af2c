// SPDX-License-Identifier: MIT
#include "compare/report/whole_report.h"

#include "compare/files/our_files.h"
#include "compare/files/output.h"
#include "compare/files/output_folder.h"
#include "compare/report/document.h"
#include "compare/report/exposure_line.h"
#include "compare/report/json.h"
#include "compare/report/report.h"
#include "compare/report/titles.h"
#include "shared/image/atomic_file.h"

#include <algorithm>
#include <cstdio>
#include <functional>
#include <set>
#include <string_view>
#include <utility>

namespace diptych {
namespace {

namespace fs = std::filesystem;

void replaceAll(std::string& text, std::string_view what, const std::string& by) {
    for (std::size_t at = text.find(what); at != text.npos; at = text.find(what, at + by.size()))
        text.replace(at, what.size(), by);
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

// `summary` and `layout` outlive the result.
ReportTexts textsOf(const WholeReport& whole, const Report& summary, const ReportLayout& layout) {
    ReportTexts texts;
    texts.rows = rowsOf(whole);
    std::vector<std::pair<fs::path, std::string>> sections;  // root and file
    for (const PlacedPart& placed : whole.parts) {
        const ReportPart& part = placed.part;
        texts.closer_boxes.insert(texts.closer_boxes.end(), part.closer_boxes.begin(),
                                  part.closer_boxes.end());
        for (const std::string& section : part.sections) sections.emplace_back(placed.root, section);
    }
    texts.section = [&summary, &layout, sections = std::move(sections)](std::size_t index) {
        std::string text = sectionIn(sections[index].first, sections[index].second);
        replaceAll(text, numberLater, layout.ids[index]);
        replaceAll(text, titleLater, page::markup(sectionTitle(summary, layout, index)));
        return text;
    };
    return texts;
}

JunitSuite totalsOf(const WholeReport& whole) {
    JunitSuite totals;
    for (const PlacedPart& placed : whole.parts) {
        totals.tests += placed.part.junit.tests;
        totals.failures += placed.part.junit.failures;
        totals.seconds += placed.part.junit.seconds;
    }
    return totals;
}

// Links or copies those of the parts' files that the report lists.
void placeFiles(const WholeReport& whole, const std::vector<std::string>& files, const OutputFolder& folder) {
    const std::set<std::string> listed(files.begin(), files.end());
    for (const PlacedPart& placed : whole.parts)
        for (const std::vector<std::string>& names :
             {placed.part.files, placed.part.sections, placed.part.texts()})
            for (const std::string& name : names)
                if (listed.contains(name))
                    (placed.kept ? linkOrCopy : copyBelow)(placed.root, name, folder / name);
}

}  // namespace

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
    ReportTexts texts = textsOf(whole, summary, layout);
    texts.devices = devices;
    texts.since = options.since;
    // Reads one text of each part, one after the other.
    const auto each = [&](PartText text, const std::function<void(std::string)>& give) {
        for (const PlacedPart& placed : whole.parts) give(readPartText(placed.root, placed.part, text));
    };
    const auto array = [&](PartText text) {
        return
            [&each, text](const JsonSink& add) { each(text, [&](const std::string& inner) { add(inner); }); };
    };

    OutputFolder folder(path);
    const std::vector<std::string> files = layout.files();
    folder.makeFolders(files);
    placeFiles(whole, files, folder);
    const auto write = [&](const std::string& name, const std::function<void(const JsonSink&)>& make) {
        AtomicFile file(folder / name);
        make([&](std::string_view text) { std::fwrite(text.data(), 1, text.size(), file.stream()); });
        file.commit();
    };
    write(manifest, [&](const JsonSink& sink) {
        writeReportJson(summary, &layout, devices, options.since.get(),
                        {array(PartText::frames), array(PartText::comparisons), array(PartText::truth)},
                        sink);
    });
    write("junit.xml", [&](const JsonSink& sink) {
        writeJunit(
            summary, totalsOf(whole),
            [&](const JsonSink& add) {
                each(PartText::junit, [&](std::string suites) {
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
