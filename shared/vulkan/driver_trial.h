// SPDX-License-Identifier: MIT
// Drivers that are opened by other variables of the environment than the user's, and may end the process.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace diptych {

// Sets variables of the environment, and sets them back. While no other thread reads it.
class EnvironmentVariables {
public:
    explicit EnvironmentVariables(const std::vector<std::pair<std::string, std::string>>& values);
    ~EnvironmentVariables();
    EnvironmentVariables(const EnvironmentVariables&) = delete;
    EnvironmentVariables& operator=(const EnvironmentVariables&) = delete;

private:
    std::vector<std::pair<std::string, std::optional<std::string>>> before_;
};

// Discards everything written to standard error while it lives.
class QuietStandardError {
public:
    QuietStandardError();
    ~QuietStandardError();
    QuietStandardError(const QuietStandardError&) = delete;
    QuietStandardError& operator=(const QuietStandardError&) = delete;

private:
    int before_;
};

struct DriverTrial {
    bool crashed = false;  // the child ended before `act` did
    std::string said;      // what `act` returned, or the message of its exception
};
// Calls `act` in a child process, whose standard error goes nowhere.
DriverTrial tryInChild(const std::function<std::string()>& act);

// The driver files of Mesa's RADV: among those of VK_DRIVER_FILES, otherwise in the loader's usual folders.
std::vector<std::string> radvFiles();

}  // namespace diptych
