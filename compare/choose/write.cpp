// SPDX-License-Identifier: MIT
#include "compare/choose/html.h"
#include "compare/choose/plot.h"
#include "compare/files/listed_folder.h"
#include "compare/output/writers.h"

#include <fmt/format.h>

#include <optional>

namespace diptych::choose {

void writeChoice(const Choices& choices, const std::filesystem::path& path, bool force) {
    ListedFolder folder(path, choiceManifest, force);
    if (const std::optional<Settings> settings = chosenSettings(choices))
        folder.put("settings.json", toJson(*settings) + "\n");
    for (std::size_t i = 0; i < choices.scenes.size(); ++i) {
        const ChoiceReport& report = choices.scenes[i];
        const std::string number = choices.all ? fmt::format("-{}", i + 1) : "";
        folder.put(fmt::format("front{}.svg", number), choicePlot(report, PlotPlace::file));
        if (choices.all && report.choice.chosen)
            folder.put(fmt::format("settings{}.json", number),
                       toJson(report.choice.candidates[*report.choice.chosen].settings) + "\n");
    }
    folder.put(experiment::rowsFile, inCsv(experiment::rowsTable(allRows(choices))));
    folder.put("index.html", choiceHtml(choices, folder.files()));
    folder.finish(toJson(choices));
}

}  // namespace diptych::choose
