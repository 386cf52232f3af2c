#!/bin/sh
# SPDX-License-Identifier: MIT
# fuzz.sh PROGRAM ARGUMENTS...: fuzzes for DIPTYCH_FUZZ_S seconds (5 if unset). 0 only runs the existing
# inputs.
set -eu
seconds=${DIPTYCH_FUZZ_S:-5}
case $seconds in
    '' | *[!0-9]*)
        printf 'DIPTYCH_FUZZ_S=%s: is a whole number of seconds\n' "$seconds" >&2
        exit 2
        ;;
    0) limit=-runs=0 ;;
    *) limit=-max_total_time=$seconds ;;
esac
program=$1
shift
# Starting up and running existing inputs take additional time; -timeout ends an input that hangs.
exec timeout -k 10 $((seconds + 300)) "$program" "$limit" "$@"
