// SPDX-License-Identifier: MIT
#pragma once

#include "shared/text/one_line.h"

#include <exception>
#include <new>
#include <stdexcept>
#include <string>

namespace diptych {

// Returns read(). Rethrows any error as a std::runtime_error, one line that begins with the file's name.
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
