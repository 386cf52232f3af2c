#!/bin/sh
# SPDX-License-Identifier: MIT
# check_format.sh CLANG_FORMAT ROOT PASSED: checks that every C++ file under ROOT is formatted by .clang-format.
# Files older than PASSED, which marks the last check that passed, are not read again.
# Prints the differences; `clang-format -i FILE` fixes a file.
set -eu
cd -- "$2"
newer=
if [ -e "$3" ] && [ -z "$(find .clang-format "$1" "$0" -newer "$3")" ]; then
    newer="-newer $3"
fi
touch "$3.new"
# shellcheck disable=SC2086
find compare deferred forward_plus shared shaders tests \( -name '*.cpp' -o -name '*.h' \) $newer -print0 |
    xargs -0 -r "$1" --dry-run -Werror
mv "$3.new" "$3"
