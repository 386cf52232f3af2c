// SPDX-License-Identifier: MIT
#include "compare/tradeoff/row.h"

namespace diptych::tradeoff {

using Json = nlohmann::ordered_json;

Json jsonOf(const TradeoffRow& row) {
    Json json = experiment::jsonOf(row);
    json["drawing_ms"] = row.drawing_ms;
    json["picture"] = row.picture;
    json["error_picture"] = row.errors_map;
    return json;
}

TradeoffRow tradeoffRowFrom(const Json& given) {
    const JsonAt<Json> json(given);
    return {experiment::rowFrom(json), json.at("drawing_ms").number(), json.at("picture").text(),
            json.at("error_picture").text()};
}

}  // namespace diptych::tradeoff
