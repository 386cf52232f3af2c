#!/bin/sh
# SPDX-License-Identifier: MIT
# check_format.sh CLANG_FORMAT ROOT: every C++ file under ROOT is as .clang-format would write it. Prints the places
# that are not; `clang-format -i FILE` mends one.
set -eu
cd -- "$2"
find compare deferred forward_plus shared shaders tests \( -name '*.cpp' -o -name '*.h' \) -print0 |
    xargs -0 "$1" --dry-run -Werror
