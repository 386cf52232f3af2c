#!/bin/sh
# SPDX-License-Identifier: MIT
# group.sh PROGRAM FILTER RESULTS: runs GoogleTest suites in one process; JUnit in RESULTS.xml. FILTER is
# SUITE.*:SUITE.*[-PATTERN:...]. After a crash every suite runs again alone, to name the crashing TEST and
# run all others. Exit code: 0 if all pass.
set -uf
program=$1 filter=$2 results=$3
"$program" --gtest_brief=1 --gtest_filter="$filter" --gtest_output="xml:$results.xml" && exit
code=$?
[ $code -gt 1 ] || exit 1

printf '%s ended with %s; its suites again, one by one\n' "$program" $code
suites=${filter%%-*}
for suite in $(printf '%s' "$suites" | tr : ' '); do
    "$program" --gtest_filter="$suite${filter#"$suites"}" >"$results.log" 2>&1 || cat "$results.log"
done
exit 1
