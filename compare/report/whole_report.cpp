// SPDX-License-Identifier: MIT
#include "compare/report/whole_report.h"

#include "compare/files/diptych_files.h"
#include "compare/files/output.h"
#include "compare/files/output_folder.h"
#include "compare/report/document.h"
#include "compare/report/json.h"
#include "compare/report/report.h"
#include "compare/report/titles.h"
#include "shared/image/atomic_file.h"

#include <algorithm>
#include <cstdio>
#include <functional>
#include <iterator>
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

// The parts' devices, in order of first use. joinedOf() has taken what the parts' comparisons hold, not their
// number.
std::vector<DrawnOn> devicesOf(const WholeReport& whole) {
    std::vector<DrawnOn> devices;
    for (const LocatedPart& located : whole.parts) {
        const ReportDevice& device = located.part.report.device;
        auto at = std::ranges::find_if(devices, [&](const DrawnOn& one) {
            return one.device.name == device.name && one.device.driver == device.driver &&
                   one.device.type == device.type;
        });
        if (at == devices.end()) at = devices.insert(at, {device});
        at->comparisons += located.part.report.comparisons.size();
        at->compare_ms += located.part.report.diff_ms;
        at->encode_ms += located.part.encode_ms;
    }
    return devices;
}

ReportLayout layoutOf(const WholeReport& whole, const ReportPart& all, const ReportOptions& options) {
    ReportLayout layout;
    layout.single_file = options.single_file;
    layout.keep = options.keep;
    layout.folder = folderOfAll(all.report);
    layout.order = failingFirst(all.report);
    layout.sections = all.sections;
    if (!options.single_file) layout.exr = all.files;  // order does not matter: files() lists them
    for (std::size_t i = 0; i < layout.sections.size(); ++i) layout.ids.push_back(std::to_string(i));
    if (whole.shard.empty()) {
        const std::size_t inPage = options.single_file ? layout.order.size() : comparisonsInPage;
        for (std::size_t at = 0; at < std::min(layout.order.size(), inPage); ++at)
            layout.sections[layout.order[at]].clear();
    } else {
        for (const LocatedPart& located : whole.parts)
            for (const std::string& name : located.part.texts()) layout.exr.push_back(name);
        layout.exr.emplace_back(shardManifest);
    }
    return layout;
}

// `all` and `layout` outlive the result.
std::function<std::string(std::size_t)> sectionsOf(const WholeReport& whole, const ReportPart& all,
                                                   const ReportLayout& layout) {
    std::vector<fs::path> roots;
    for (const LocatedPart& located : whole.parts)
        roots.insert(roots.end(), located.part.sections.size(), located.root);
    return [&all, &layout, roots = std::move(roots)](std::size_t index) {
        std::string text = sectionIn(roots[index], all.sections[index]);
        replaceAll(text, indexPlaceholder, layout.ids[index]);
        replaceAll(text, titleLater, page::markup(sectionTitle(all.report, layout, index)));
        return text;
    };
}

// Links or copies those of the parts' files that the report lists.
void copyFiles(const WholeReport& whole, const std::vector<std::string>& files, const OutputFolder& folder) {
    const std::set<std::string> listed(files.begin(), files.end());
    for (const LocatedPart& located : whole.parts)
        for (const std::vector<std::string>& names :
             {located.part.files, located.part.sections, located.part.texts()})
            for (const std::string& name : names)
                if (listed.contains(name))
                    (located.written_here ? linkOrCopy : copyBelow)(located.root, name, folder / name);
}

}  // namespace

ReportPart joinedOf(WholeReport& whole) {
    ReportPart all;
    Report& joined = all.report;
    for (LocatedPart& located : whole.parts) {
        ReportPart& part = located.part;
        const auto move = [](auto& from, auto& to) { std::ranges::move(from, std::back_inserter(to)); };
        move(part.tables, all.tables);
        move(part.closer_tables, all.closer_tables);
        move(part.closer_boxes, all.closer_boxes);
        move(part.rows, all.rows);
        move(part.exposures, all.exposures);
        std::ranges::copy(part.sections, std::back_inserter(all.sections));
        std::ranges::copy(part.files, std::back_inserter(all.files));
        all.junit += part.junit;
        Report& report = part.report;
        if (joined.device.name.empty()) joined.device = report.device;
        if (joined.against.name.empty()) joined.against = report.against;
        const std::size_t first = joined.frames.size();
        for (Comparison& comparison : report.comparisons) {
            comparison.baseline += first;
            comparison.test += first;
        }
        for (CloserPath& closer : report.closer_paths) {
            closer.reference += first;
            for (std::size_t& path : closer.paths) path += first;
        }
        move(report.frames, joined.frames);
        move(report.comparisons, joined.comparisons);
        move(report.closer_paths, joined.closer_paths);
    }
    joined.errors = whole.errors;
    return all;
}

void writeWhole(const WholeReport& whole, const ReportPart& all, const fs::path& path,
                const ReportOptions& options) {
    constexpr const char* manifest = "report.json";
    const ReportLayout layout = layoutOf(whole, all, options);
    const ReportTexts texts{options.since, devicesOf(whole), all.rows, all.closer_boxes,
                            sectionsOf(whole, all, layout)};
    // Reads one text of each part, one after the other.
    const auto each = [&](std::size_t text, const auto& give) {
        for (const LocatedPart& located : whole.parts) give(readPartText(located.root, located.part, text));
    };

    OutputFolder folder(path);
    const std::vector<std::string> files = layout.files();
    folder.makeFolders(files);
    copyFiles(whole, files, folder);
    const auto write = [&](const std::string& name, const std::function<void(const JsonSink&)>& make) {
        AtomicFile file(folder / name);
        make([&](std::string_view text) { std::fwrite(text.data(), 1, text.size(), file.stream()); });
        file.commit();
    };
    write(manifest, [&](const JsonSink& sink) {
        writeReportJson(all.report, &layout, texts.devices, options.since.get(), each, sink);
    });
    write("junit.xml", [&](const JsonSink& sink) {
        writeJunit(
            all.report, all.junit,
            [&](const JsonSink& add) {
                each(junitText, [&](std::string suites) {
                    replaceAll(suites, folderLater, junitFolder(path));
                    add(suites);
                });
            },
            sink);
    });
    if (!whole.shard.empty()) writeFile(folder / shardManifest, whole.shard);
    writeFile(folder / "index.html", reportHtml(all.report, layout, texts));
    folder.put(files, [&] { return replaceable(path, manifest, options.force); });
}

std::string tableOf(const ReportPart& joined, bool all) {
    std::string out;
    for (std::size_t i = 0; i < joined.tables.size(); ++i)
        if (all || !joined.report.comparisons[i].passed()) out += joined.tables[i];
    if (all)
        for (const std::string& text : joined.closer_tables) out += text;
    return out + tableEnd(joined.report);
}

}  // namespace diptych
