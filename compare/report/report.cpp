// SPDX-License-Identifier: MIT
#include "compare/report/report.h"

#include "compare/files/output.h"
#include "compare/files/output_folder.h"
#include "compare/output/writers.h"
#include "compare/report/document.h"
#include "compare/report/encoder.h"
#include "compare/report/json.h"
#include "compare/report/layout.h"
#include "compare/report/titles.h"
#include "shared/image/atomic_file.h"

#include <fmt/format.h>

#include <chrono>

namespace diptych {

std::string againFolder(const std::filesystem::path& folder) {
    const bool slash = !folder.has_filename();
    return (slash ? folder.parent_path() : folder).string() + "-again";
}

std::string writeReport(const Report& report, const std::filesystem::path& path,
                        const ReportOptions& options) {
    constexpr const char* manifest = "report.json";
    const auto earlier = [&] { return replaceable(path, manifest, options.force); };
    earlier();
    OutputFolder folder(path);
    const auto start = std::chrono::steady_clock::now();
    ReportLayout layout = layoutOf(report, options);
    folder.makeFolders(layout.files());
    encode(report, layout, folder.path(), options.progress);
    layout.encode_ms = msSince(start);

    ReportTexts texts = textsOf(report, layout);
    texts.since = options.since;
    std::string json = reportJson(report, &layout, options.since.get());
    writeFile(folder / manifest, json);
    writeFile(folder / "junit.xml", reportJunit(report, onDisk(layout), path));
    for (std::size_t i = 0; i < layout.sections.size(); ++i)
        if (!layout.sections[i].empty())
            writeFile(folder / layout.sections[i], sectionScript(report, layout, i));
    writeFile(folder / "index.html", reportHtml(report, layout, texts));
    folder.put(layout.files(), earlier);
    return json;
}

std::string tableEnd(const Report& report) {
    std::string out;
    for (const SceneError& failure : report.failures) out += fmt::format("FAIL {}\n", errorText(failure));
    for (const SceneError& error : report.errors) out += fmt::format("ERROR {}\n", errorText(error));
    for (const auto& [about, note] : notesWithScenes(report, ""))
        out += fmt::format("note{}{}: {}\n", about.empty() || about[0] == ',' ? "" : ", ", about, note);
    return out + verdictLine(report) + "\n";
}

std::string reportTable(const Report& report) {
    std::string out;
    for (const std::string& line : report.first_notes) out += line + "\n";
    for (std::size_t i = 0; i < report.comparisons.size(); ++i)
        out += inText(comparisonBlocks(report, nullptr, i));
    for (std::size_t i = 0; i < report.closer_paths.size(); ++i)
        out += inText(closerPathBlocks(report, nullptr, i, report.closer_paths.size() > 1));
    return out + tableEnd(report);
}

}  // namespace diptych
