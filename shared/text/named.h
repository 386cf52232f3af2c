// SPDX-License-Identifier: MIT
#pragma once

#include "shared/text/one_line.h"

#include <exception>
#include <new>
#include <stdexcept>
#include <string>

namespace diptych {

// Returns the result of read(). Any error in it is rethrown as a std::runtime_error whose line begins with
// the file's name.
template <class Read>
auto named(const std::string& name, const Read& read) {
    try {
        return read();
    } catch (const std::bad_alloc&) {
        throw std::runtime_error(name + ": does not fit in this machine's memory");
    } catch (const std::exception& e) {
        throw std::runtime_error(name + ": " + oneLine(e.what(), 400));
    }
}

}  // namespace diptych
