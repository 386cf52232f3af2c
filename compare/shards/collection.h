// SPDX-License-Identifier: MIT
// Compares the scenes of a shard one after the other.
#pragma once

#include "compare/experiment/comparison.h"
#include "compare/explain/explanations.h"
#include "compare/files/checkpoint_folder.h"
#include "compare/report/parts.h"
#include "compare/report/report_options.h"
#include "compare/report/whole_report.h"
#include "compare/shards/scene_items.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace diptych::shards {

// The inputs of a collection.
struct CollectionQuestion {
    std::vector<Settings> settings;  // all cameras, times and paths
    experiment::Compared compared;
    CompareOptions compare;
    RenderOptions drawing;
    ExplanationQuestion explanation;
    ReportOptions report;
    std::filesystem::path folder;                           // of the output
    nlohmann::ordered_json key;                             // of kept parts
    std::function<void(const std::string&)> note;           // a line for the user
    std::function<void(const std::string&)> log_verbose{};  // with -v
};

// Parts that an interrupted run left, of scenes whose files are unchanged. `note` gets a line for each
// damaged part, and one with the number of the others.
std::map<const Item*, ReportPart> keptParts(const CheckpointFolder& checkpoints, const SceneItems& items,
                                            const std::function<void(const std::string&)>& note);

// Keeps a report part beside the output after each scene. A scene that cannot be read or rendered is an
// error of the report.
class Collection {
public:
    // Opens the kept parts; throws if they are of another device. The arguments must outlive the object.
    // `other`: the second device; nullptr: none.
    Collection(const CollectionQuestion& question, const SceneItems& items, Device& device, Device* other,
               Progress& progress);

    const std::filesystem::path& checkpointedIn() const { return checkpoints_.path(); }
    // Compares scenes without a kept part. The next scene loads while one is compared.
    void compareAll();
    WholeReport whole();                      // moves the parts; without WholeReport::shard
    void remove() { checkpoints_.remove(); }  // call when the report is written

private:
    void checkDevice();
    void attempt(const Item* item, const std::function<void()>& work);
    void checkHeaders();
    ReportPart compareOne(const Item& item, const Scene& scene, const Stage& stage);

    const CollectionQuestion& question_;
    const SceneItems& items_;
    Progress& progress_;
    CheckpointFolder checkpoints_;
    experiment::Devices devices_;
    std::map<const Item*, ReportPart> parts_;
    std::multimap<const Item*, SceneError> errors_;  // of the scene or of external renderers
};

}  // namespace diptych::shards
