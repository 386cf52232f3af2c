// SPDX-License-Identifier: MIT
// Tests drivers in a modified environment and a child process, because they may crash.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace diptych {

// Sets environment variables and restores them. Not thread-safe.
class EnvironmentVariables {
public:
    explicit EnvironmentVariables(const std::vector<std::pair<std::string, std::string>>& values);
    ~EnvironmentVariables();
    EnvironmentVariables(const EnvironmentVariables&) = delete;
    EnvironmentVariables& operator=(const EnvironmentVariables&) = delete;

private:
    std::vector<std::pair<std::string, std::optional<std::string>>> before_;
};

// Discards everything written to standard error during its lifetime.
class QuietStandardError {
public:
    QuietStandardError();
    ~QuietStandardError();
    QuietStandardError(const QuietStandardError&) = delete;
    QuietStandardError& operator=(const QuietStandardError&) = delete;

private:
    int before_;
};

struct DriverProbe {
    bool crashed = false;  // the child ended before `act` returned
    std::string output;    // result of `act`, or the message of its exception
};
// Calls `act` in a child process with standard error discarded.
DriverProbe probeInChild(const std::function<std::string()>& act);

// Driver files of Mesa's RADV: among those of VK_DRIVER_FILES, otherwise in the loader's default folders.
std::vector<std::string> radvFiles();

}  // namespace diptych
