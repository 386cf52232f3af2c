// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <stdexcept>
#include <string>

namespace diptych {

// The message of the error that `act` throws; empty if it succeeds.
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
