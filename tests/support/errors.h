// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <stdexcept>
#include <string>

namespace diptych {

// What is said where `act` fails; empty where it does not.
template <std::invocable Act>
std::string faultOf(Act&& act) {
    try {
        act();
    } catch (const std::runtime_error& error) {
        return error.what();
    }
    return {};
}

}  // namespace diptych
