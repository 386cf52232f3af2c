#!/bin/sh
# SPDX-License-Identifier: MIT
# check_format.sh CLANG_FORMAT ROOT: checks that every C++ file under ROOT is formatted by .clang-format.
# Prints the differences; `clang-format -i FILE` fixes a file.
set -eu
cd -- "$2"
find compare deferred forward_plus shared shaders tests \( -name '*.cpp' -o -name '*.h' \) -print0 |
    xargs -0 "$1" --dry-run -Werror
