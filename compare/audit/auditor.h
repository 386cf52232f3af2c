// SPDX-License-Identifier: MIT
// An audit of one scene: measures every quantity, reduces its failures and keeps finished steps.
#pragma once

#include "compare/audit/audit.h"
#include "compare/files/checkpoint_folder.h"
#include "compare/run/progress.h"

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace diptych::audit {

// The sweep of quantities that `audit` asks for.
struct AuditQuestion {
    std::vector<std::string> quantities;                   // names; empty: all
    std::vector<std::pair<std::string, double>> required;  // magnitudes that must pass, by quantity
    std::filesystem::path folder;                          // of the output
    bool force = false;                                    // replaces other files there
    std::vector<std::string> words;                        // of a failure's command: the device
    // Whether that command, whose files and output are in `folder`, exits with 1.
    std::function<bool(const std::vector<std::string>& words, const std::filesystem::path& folder)> fails;
};

// Adds the reduced failure of a quantity's first precise series to its failures, and the files to
// `scenes`. It takes the failure nearest to the default magnitude; adds nothing if no series fails. A
// failure's command was tried with files in a temporary folder, and question.fails() returned true (it
// exits with 1). Otherwise there is no command.
void addFailures(QuantityAudit& of, const Subject& subject, Measurer& measurer, const AuditQuestion& question,
                 std::map<std::string, std::string>& scenes);

class Auditor {
public:
    // `question`, `device` and `subject` must outlive the object. Draws the original subject.
    Auditor(const AuditQuestion& question, Audited audited, const Subject& subject, Device& device,
            std::function<void(const std::string&)> onStep);

    bool isRenewed() const { return checkpoint_.isRenewed(); }  // steps of another key were removed
    const Audit& audit() const { return audit_; }
    // `onFinished`: called with each finished quantity.
    void measure(const Stage& stage, const std::function<void(const QuantityAudit&)>& onFinished);
    // Writes the folder, removes the checkpoint and returns audit.json.
    std::string write();

private:
    nlohmann::ordered_json key();
    void measure(const Quantity& quantity, const Stage& stage);
    Step stepAt(const Quantity& quantity, std::span<const Series> series, double magnitude);

    const AuditQuestion& question_;
    const Subject& subject_;
    Audit audit_;
    Measurer measurer_;
    CheckpointFolder checkpoint_;
};

}  // namespace diptych::audit
