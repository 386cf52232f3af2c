// SPDX-License-Identifier: MIT
#include "compare/choose/html.h"
#include "compare/choose/plot.h"
#include "compare/files/our_files.h"
#include "compare/files/output.h"
#include "compare/files/output_folder.h"
#include "shared/image/atomic_file.h"

#include <fmt/format.h>

#include <algorithm>

namespace diptych::choose {

void writeChoice(const Choices& choices, const std::filesystem::path& path, bool force) {
    const auto earlier = [&] {
        checkReplaceable({OutputKind::folder, path}, choiceManifest, force);
        return manifestFiles(path, choiceManifest);
    };
    earlier();
    OutputFolder folder(path);
    std::vector<std::string> files;
    const auto put = [&](const std::string& name, const std::string& text) {
        writeFile(folder / name, text);
        files.push_back(name);
    };
    if (const std::optional<Settings> settings = chosenSettings(choices))
        put("settings.json", toJson(*settings) + "\n");
    for (std::size_t i = 0; i < choices.scenes.size(); ++i) {
        const ChoiceReport& report = choices.scenes[i];
        const std::string number = choices.all ? fmt::format("-{}", i + 1) : "";
        put(fmt::format("front{}.svg", number), choicePlot(report, PlotPlace::file));
        if (choices.all && report.choice.chosen)
            put(fmt::format("settings{}.json", number),
                toJson(report.choice.candidates[*report.choice.chosen].settings) + "\n");
    }
    std::vector<std::string> linked = files;
    linked.emplace_back(choiceManifest);
    put("index.html", choiceHtml(choices, linked));
    files.emplace_back(choiceManifest);
    std::ranges::sort(files);
    nlohmann::ordered_json json = toJson(choices);
    json["software"] = softwareName;
    json["files"] = files;
    writeFile(folder / choiceManifest,
              json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n");
    folder.put(files, earlier);
}

}  // namespace diptych::choose
