// SPDX-License-Identifier: MIT
// Comparison of folder contents, and the tool with injected faults (preload/faults.cpp).
#pragma once

#include "tests/tool/run.h"

#include <cerrno>
#include <map>
#include <string>

namespace diptych {

inline constexpr int manyCalls =
    5000;  // more than any command of these tests makes: a sweep that reaches it hangs
inline constexpr int faultStride = 6;  // tests one row in six of every table of calls; a full run tests all

// All files, folders and links below a folder, by path, with their contents.
using Contents = std::map<std::string, std::string>;

inline Contents contentsBelow(const fs::path& folder) {
    Contents all;
    if (!fs::exists(folder)) return all;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
        all[entry.path().lexically_relative(folder).string()] =
            entry.is_regular_file() ? contentsOf(entry.path()) : "(folder)";
    return all;
}

inline void replaceBy(const fs::path& folder, const fs::path& saved) {
    fs::remove_all(folder);
    fs::copy(saved, folder, fs::copy_options::recursive);
}

// Names that exist only during writing.
inline bool isLeftover(const std::string& path) {
    return path.find(".tmp") != path.npos || path.find(".diptych.put") != path.npos;
}

inline std::vector<std::string> leftoversIn(const fs::path& folder) {
    std::vector<std::string> found;
    for (const auto& [path, text] : contentsBelow(folder))
        if (isLeftover(path)) found.push_back(path);
    return found;
}

struct Fault {
    std::string in;         // the kind of call
    std::string what;       // the fault: an errno, a VkResult, "kill"
    bool from = false;      // every later call fails, too
    std::size_t bytes = 0;  // minimum size of allocations
};

struct Faulted : Ran {
    std::string seen;  // the call that failed; empty: never reached
};

#ifdef DIPTYCH_FAULTS
inline Faulted runFaulted(const Folder& scratch, const std::string& arguments, const Fault& fault, int at,
                          const std::string& program = DIPTYCH_PROGRAM) {
    const fs::path seen = scratch / ".seen";
    fs::remove(seen);
    const std::string command =
        "env LD_PRELOAD='" DIPTYCH_FAULTS "' FAULT_IN=" + fault.in + " FAULT_DO=" + fault.what +
        " FAULT_AT=" + std::to_string(at) + (fault.from ? " FAULT_FROM=1" : "") +
        " FAULT_BYTES=" + std::to_string(fault.bytes) + " FAULT_SEEN='" + seen.string() + "' FAULT_UNDER='" +
        scratch.path().string() + "' '" + program + "' " + arguments;
    Faulted ran{runShell(scratch, command, scratch.path()), contentsOf(seen)};
    fs::remove(seen);
    return ran;
}
#endif

}  // namespace diptych
