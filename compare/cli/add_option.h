// SPDX-License-Identifier: MIT
// Adds options with a value to the parser. `type` stands for the value in --help.
#pragma once

#include <CLI/CLI.hpp>

#include <string>

namespace diptych::cli {

template <class Value>
CLI::Option* addOption(CLI::App& app, const std::string& name, Value& value, const std::string& type,
                       const std::string& help) {
    return app.add_option(name, value, help)->type_name(type);
}

// May be given several times, with a value each.
template <class Value>
CLI::Option* addEach(CLI::App& app, const std::string& name, Value& values, const std::string& type,
                     const std::string& help) {
    return addOption(app, name, values, type, help)->allow_extra_args(false);
}

// Also takes several values, separated by commas.
template <class Value>
CLI::Option* addList(CLI::App& app, const std::string& name, Value& values, const std::string& type,
                     const std::string& help) {
    return addEach(app, name, values, type, help)->delimiter(',');
}

}  // namespace diptych::cli
