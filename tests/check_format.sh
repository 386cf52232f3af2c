#!/bin/sh
# SPDX-License-Identifier: MIT
# check_format.sh CLANG_FORMAT ROOT PASSED: checks that every C++ file under ROOT is formatted by .clang-format.
# PASSED: an empty file, as old as the last check that passed. Files unchanged since (ctime) are skipped.
# Prints the differences; `clang-format -i FILE` fixes a file.
set -eu
cd -- "$2"
if [ ! -e "$3" ] || [ -n "$(find -L .clang-format "$1" "$0" -cnewer "$3")" ]; then touch -d @0 "$3"; fi
touch "$3.new"
find compare deferred forward_plus shared shaders tests \( -name '*.cpp' -o -name '*.h' \) -cnewer "$3" -print0 |
    xargs -0 -r "$1" --dry-run -Werror
mv "$3.new" "$3"
