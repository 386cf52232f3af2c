// SPDX-License-Identifier: MIT
#include "compare/explain/explained.h"

#include "compare/explain/html.h"
#include "compare/explain/pictures.h"
#include "compare/page/text.h"
#include "shared/text/json_text.h"

#include <fmt/format.h>

#include <memory>

namespace diptych {

Explained explainedOf(const Explanation& explanation, const ExplainedPictures& of, const Image8& shown) {
    Explained explained;
    explained.words = inShort(explanation);
    explained.json = jsonText(toJson(explanation, of), -1);
    if (!explanation.causes.empty()) explained.map = dominantPicture(explanation, shown);
    // Without the maps of single causes, which the report does not show.
    const auto kept = std::make_shared<Explanation>(explanation);
    for (Cause& cause : kept->causes) cause.map = Image();
    kept->unexplained_map = Image();
    explained.html = [kept, of](const std::string& map) {
        return explanationSection(
            *kept, of, [&](const std::string& name) { return name == dominantFile ? map : std::string(); });
    };
    return explained;
}

Explained notExplained(const std::string& because) {
    return {"differences in lit cannot be explained: " + because,
            jsonText(nlohmann::json{{"not_explained", because}}, -1),
            {},
            [because](const std::string&) {
                return fmt::format("<p class=\"soft\">Differences in lit cannot be explained: {}</p>\n",
                                   page::markup(because));
            }};
}

}  // namespace diptych
