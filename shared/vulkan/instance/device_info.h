// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace diptych {

// One capability of a device.
struct DeviceProperty {
    std::string what;
    bool there = false;
    bool required = false;
    std::string note;
};

struct DeviceInfo {
    int index = 0;
    std::string name, driver;  // "Mesa 22.3.6 (LLVM 15.0.6)"
    std::string type;          // cpu, integrated, discrete, virtual, other
    std::string api_version;   // "1.3.230"
    std::vector<DeviceProperty> properties;

    bool usable() const;  // all required capabilities are supported
};

}  // namespace diptych
