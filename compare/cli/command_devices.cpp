// SPDX-License-Identifier: MIT
#include "compare/cli/add_option.h"
#include "compare/cli/command.h"
#include "compare/cli/exit_code.h"
#include "compare/probe/groups.h"
#include "compare/probe/run.h"
#include "compare/run/print.h"
#include "shared/material/texture_probe.h"
#include "shared/text/json_text.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <map>

namespace diptych::cli {
namespace {

struct DevicesLine : SceneGroup {
    bool probe = false;  // run the probes of compare/probe
};

void describeDevices(CLI::App& app, DevicesLine& options) {
    addSettings(app, options);
    addImage(app, options);
    addDevice(app, options);
    app.add_flag("--probe", options.probe,
                 "run the shaders' functions on millions of inputs and compare them with double precision, "
                 "in ULP; exit code 1 if an error exceeds Vulkan's limit");
    addFiles(app, options, "not accepted: devices writes no file; use --json");
    addOutput(app, options);
    acceptUnread(app, {"--out", "--force"});
    for (const char* unread : {pixel_group, image_group}) acceptUnread(app, unread);
}

using ProbeResults = std::map<int, std::vector<probe::Result>>;  // key: device index

nlohmann::ordered_json jsonOf(const std::vector<DeviceInfo>& devices, const ProbeResults& probes) {
    nlohmann::ordered_json json{{"schema", 1}, {"devices", nlohmann::ordered_json::array()}};
    for (const DeviceInfo& device : devices) {
        nlohmann::ordered_json properties = nlohmann::ordered_json::array();
        for (const DeviceProperty& property : device.properties)
            properties.push_back({{"what", property.what},
                                  {"there", property.there},
                                  {"required", property.required},
                                  {"note", property.note}});
        json["devices"].push_back({{"index", device.index},
                                   {"name", device.name},
                                   {"driver", device.driver},
                                   {"type", device.type},
                                   {"api_version", device.api_version},
                                   {"usable", device.usable()},
                                   {"facts", properties}});
        if (const auto found = probes.find(device.index); found != probes.end())
            json["devices"].back()["probes"] = probe::jsonOf(found->second);
    }
    return json;
}

void print(const DeviceInfo& device) {
    printOut("{}  {} ({}, {}, Vulkan {}){}\n", device.index, device.name, device.type, device.driver,
             device.api_version, device.usable() ? "" : ": cannot be used");
    for (const DeviceProperty& property : device.properties)
        printOut("     {:<3}  {:<38} {}{}\n", property.there ? "yes" : "no", property.what, property.note,
                 property.required && !property.there ? " (required)" : "");
}

int runDevices(const DevicesLine& options) {
    refuseOut(options, "devices");
    std::vector<DeviceInfo> devices = listDevices();
    if (!options.device.empty()) {
        const DeviceInfo chosen = Device({options.device, options.validate}).info();
        std::erase_if(devices, [&](const DeviceInfo& device) { return device.index != chosen.index; });
    }
    ProbeResults probes;
    Progress progress(progressOutput(options));
    for (DeviceInfo& device : devices) {
        if (!device.usable()) continue;
        Device opened({std::to_string(device.index), options.validate});
        for (DeviceProperty& property : opened.probe()) device.properties.push_back(std::move(property));
        const TextureSampling texels = probeTextures(opened),
                              exact = probeTextures(opened, TexturePrecision::exact);
        for (DeviceProperty& property : textureProperties(opened, texels, exact))
            device.properties.push_back(std::move(property));
        if (options.probe) {
            for (DeviceProperty& property : probe::roundingProperties(opened))
                device.properties.push_back(std::move(property));
            probes[device.index] = probe::runProbes(opened, probe::allProbes(), Stage(progress, device.name));
        }
        checkValidation(opened);
    }
    progress.wipe();
    if (options.json)
        printOut("{}\n", jsonText(jsonOf(devices, probes)));
    else if (!options.quiet)
        for (const DeviceInfo& device : devices) {
            print(device);
            if (const auto found = probes.find(device.index); found != probes.end())
                printColored(options, "\n" + probe::tableOf(found->second, options.verbose));
        }
    // The loader finds installed drivers by itself. Drivers bundled with a program need VK_DRIVER_FILES.
    if (!options.json && !options.quiet && options.device.empty())
        printOut(
            "To use devices of several drivers at once (compare --against-device), set "
            "VK_DRIVER_FILES=FILE.json:FILE.json\n");
    return exitCode(std::ranges::all_of(probes, [](const auto& of) { return probe::allPassed(of.second); }));
}

}  // namespace

Command devicesCommand() {
    return makeCommand<DevicesLine>(
        {"devices", "Lists Vulkan devices and what each can and cannot do here", "diptych devices"},
        describeDevices, resolveScene, runDevices);
}

}  // namespace diptych::cli
