// SPDX-License-Identifier: MIT
#include "compare/report/report.h"

#include "compare/files/our_files.h"
#include "compare/files/output.h"
#include "compare/files/output_folder.h"
#include "compare/report/document.h"
#include "compare/report/encoder.h"
#include "compare/report/json.h"
#include "compare/report/layout.h"
#include "shared/image/atomic_file.h"

#include <chrono>

namespace diptych {

std::string againFolder(const std::filesystem::path& folder) {
    const bool slash = !folder.has_filename();
    return (slash ? folder.parent_path() : folder).string() + "-again";
}

std::string writeReport(const Report& report, const std::filesystem::path& path,
                        const ReportOptions& options) {
    constexpr const char* manifest = "report.json";
    const auto earlier = [&] {
        checkReplaceable({OutputKind::folder, path}, manifest, options.force);
        return manifestFiles(path, manifest);
    };
    earlier();
    OutputFolder folder(path);
    const auto start = std::chrono::steady_clock::now();
    ReportLayout layout = layoutOf(report, options);
    folder.makeFolders(layout.files());
    encode(report, layout, folder.path(), options.progress);
    layout.encode_ms =
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();

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

}  // namespace diptych
