#!/bin/bash
# SPDX-License-Identifier: MIT
# gpu-first-run.sh [--quick | --long] [OUT]: what to run first on a machine with a real GPU. Claims that
# hold bit for bit on lavapipe are tested here within 16 ULP, and every result stays in one folder, OUT
# (gpu-first-run-DATE-DEVICE): a log and a JUnit file a step, and README.md: what passed and what differs.
#   --quick    a sample of every step, in seconds
#   --long     on a CPU device, too, all that a GPU is asked; longer benchmarks
# Where the programs are missing, they are made in build/ by ./diptych and CMake; DIPTYCH_BUILD names another
# folder of programs, DIPTYCH_SPONZA another file of Sponza than that in ../shared/assets. The device is the
# one that diptych takes by itself; the Vulkan loader's VK_DRIVER_FILES chooses among drivers.
# Exit code 0: all right; 1: a step failed; 2: it could not run, or was interrupted. A step that fails or
# hangs does not stop the others.
set -u
export LC_ALL=C

fail() {
    printf 'gpu-first-run.sh: %s\n' "$1" >&2
    exit 2
}

home=$(dirname -- "$(dirname -- "$(readlink -f -- "$0")")")
size=default
out=
for word in "$@"; do
    case $word in
        --quick | --long) size=${word#--} ;;
        --help | -h)
            sed -n '3,/^set /{s/^# \{0,1\}//;/^set /d;p}' "$0"
            exit 0
            ;;
        -*) fail "$word: is no option; --quick, --long or --help" ;;
        *)
            [ -z "$out" ] || fail "$word: one folder is enough"
            out=$word
            ;;
    esac
done

# ---- the programs ------------------------------------------------------------------------------------

build=${DIPTYCH_BUILD:-$home/build}
program=$build/compare/diptych
missing() {
    local file
    for file in compare/diptych tests/image_tests tests/probe_tests; do
        [ -x "$build/$file" ] || { printf '%s' "$build/$file" && return; }
    done
}
absent=$(missing)
if [ -n "$absent" ]; then
    [ -z "${DIPTYCH_BUILD-}" ] || fail "$absent: is not there; build it, or leave DIPTYCH_BUILD unset"
    printf 'building in %s\n' "$build" >&2
    "$home/diptych" --version >/dev/null || fail "the build failed (see above)"
    cmake --build "$build" --target image_tests probe_tests unit_tests bench_kernels >&2 ||
        fail "the build failed (see above)"
    absent=$(missing)
    [ -z "$absent" ] || fail "$absent: was not built"
fi

# ---- the device, and the folder ----------------------------------------------------------------------

scratch=$(mktemp -d) || fail "no folder for temporary files"
child=
trap 'rm -rf -- "$scratch"' EXIT

# The device chosen here is used for everything else.
timeout -k 10 120 "$program" render builtin:triangle --size 16x9 --json -o "$scratch/triangle.png" \
    >"$scratch/triangle.json" 2>"$scratch/error" </dev/null ||
    fail "no device draws a triangle: $(tail -n 1 "$scratch/error")"
fact() { sed -n '/"device": {/,/}/s/^ *"'"$1"'": "\(.*\)",\{0,1\}$/\1/p' "$scratch/triangle.json"; }
device=$(fact name) driver=$(fact driver) type=$(fact type)
[ -n "$device" ] || fail "$program: does not say which device it draws on"

if [ -z "$out" ]; then
    slug=$(printf '%s' "$device" | tr -cs 'A-Za-z0-9\n' '-' | sed 's/^-//; s/-$//')
    first=gpu-first-run-$(date -u +%F)-$slug
    out=$first
    for ((i = 2; ; ++i)); do
        [ -e "$out" ] || break
        out=$first-$i
    done
fi
[ -z "$(ls -A -- "$out" 2>/dev/null)" ] || fail "$out: is not empty; name another folder"
mkdir -p -- "$out" 2>"$scratch/error" || fail "$(cat "$scratch/error")"
out=$(cd -- "$out" && pwd) || fail "$out: cannot be entered"

commit=$(git -C "$home" rev-parse --short=12 HEAD 2>/dev/null || echo unknown)
[ -z "$(git -C "$home" status --porcelain 2>/dev/null)" ] || commit="$commit, with changes"
version=$("$program" --version 2>/dev/null | head -n 1)
date=$(date -u +'%F %H:%M UTC')

# Amount of work: everything for a GPU; for a CPU device ten minutes, without new steps after nine.
amount=$size
if [ "$size" = default ]; then
    amount=whole
    [ "$type" != "cpu" ] || amount="cut"
fi
budget=1000000
case $amount in
    quick) about="a sample of every step (--quick)" ;;
    cut) about="cut to what a CPU device does in ten minutes" budget=540 ;;
    whole) about="the whole matrix" ;;
    long) about="the whole matrix, long benchmarks (--long)" ;;
esac
if [ "$type" = "cpu" ]; then
    about="$about; a CPU device: the same bits"
else
    about="$about; a GPU: the same within 16 ULP"
fi

# ---- steps -------------------------------------------------------------------------------------------

rows=      # rows of the summary's table
differs=   # failures, in words
measured=  # results of probes
left_out=  # skipped steps
failures=0
started=$SECONDS
deadline=0

# limited SECONDS COMMAND...: runs it for at most SECONDS, and never past the step's own limit.
limited() {
    local left=$((deadline - SECONDS))
    [ "$left" -lt "$1" ] || left=$1
    [ "$left" -gt 0 ] || return 124
    shift
    timeout -k 10 "$left" "$@" </dev/null &
    child=$!
    wait "$child"
    local code=$?
    child=
    return $code
}

# One table cell: escapes bars and removes newlines.
cell() { printf '%s' "$1" | tr '\n\t' '  ' | sed 's/|/\\|/g' | cut -c1-"${2:-300}"; }

# summary [STATE]: rewritten after every step, so that it survives a crash of the machine.
summary() {
    local verdict="all right"
    [ $failures -eq 0 ] || verdict="steps that failed: $failures"
    verdict=${1-}$verdict
    {
        printf '# First run on %s\n\n' "$device"
        printf '| | |\n|---|---|\n'
        printf '| device | %s (%s) |\n| driver | %s |\n' "$(cell "$device")" "$type" "$(cell "$driver")"
        printf '| date | %s |\n| commit | %s |\n| program | %s |\n' "$date" "$commit" "$(cell "$version")"
        printf '| asked | %s |\n| verdict | %s |\n' "$about" "$verdict"
        printf '| seconds | %d |\n' $((SECONDS - started))
        printf '\n| step | result | seconds | what | log |\n|---|---|---|---|---|\n%s' "$rows"
        printf '\n## What differs\n\n%s' "${differs:-Nothing.$'\n'}"
        [ -z "$measured" ] || printf '\n## What was measured\n\n%s' "$measured"
        printf '\n## What was left out\n\n%s' "${left_out:-Nothing.$'\n'}"
    } >"$out/.README.md" && mv -- "$out/.README.md" "$out/README.md"
}

interrupted() {
    trap '' INT TERM HUP
    [ -z "$child" ] || kill -TERM "$child" 2>/dev/null
    rows+="| ${name-} | interrupted | $((SECONDS - began)) | | |"$'\n'
    left_out+="- Every step after \`${name-}\`: it was interrupted."$'\n'
    summary "interrupted; so far: "
    fail "interrupted; $out/README.md says what was done"
}
began=$SECONDS
trap interrupted INT TERM HUP

# step NAME LIMIT FUNCTION ARGUMENTS...: FUNCTION returns 0 (passed), 3 (nothing to run) or another code
# (failed), and sets `what` to the text for the table.
step() {
    name=$1
    local limit=$2 code result start=${EPOCHREALTIME/./} ms
    shift 2
    what=
    if [ $((SECONDS - started)) -ge $budget ]; then
        rows+="| $name | left out | 0 | no time was left | |"$'\n'
        left_out+="- \`$name\`: no time was left."$'\n'
        printf '%-16s left out: no time was left\n' "$name"
        summary "unfinished; so far: "
        return
    fi
    began=$SECONDS
    deadline=$((SECONDS + limit))
    "$@" >"$out/$name.log" 2>&1
    code=$?
    case $code in
        0) result=passed ;;
        3)
            result="not run"
            left_out+="- \`$name\`: $what."$'\n'
            ;;
        *)
            result="**failed**"
            [ $SECONDS -lt $deadline ] || what="over its limit of $limit s; $what"
            failures=$((failures + 1))
            differs+="- **$name**: ${what:-exit code $code}"$'\n'"$faults"
            ;;
    esac
    faults=
    ms=$(((${EPOCHREALTIME/./} - start) / 1000))
    ms=$((ms / 1000)).$((ms / 100 % 10))
    rows+="| $name | $result | $ms | $(cell "$what") | [log]($name.log) |"$'\n'
    printf '%-16s %-8s %7s s  %s\n' "$name" "${result//\*/}" "$ms" "$what"
    summary "unfinished; so far: "
}
faults=  # list items of the current step

# ---- kinds of steps ----------------------------------------------------------------------------------

devices() {
    if ! limited 120 "$program" devices --json >"$out/devices.json" ||
        ! limited 120 "$program" devices >"$out/devices.txt"; then
        what=$(tail -n 1 "$out/$name.log")
        return 1
    fi
    cat "$out/devices.txt"
    what="devices: $(grep -c '^[0-9]' "$out/devices.txt"); facts that are not so:"
    what+=" $(grep -c '^ *no ' "$out/devices.txt")"
    measured+="Devices, and what they lack ([devices.txt](devices.txt)):"$'\n\n'
    measured+="$(grep -E '^[0-9]|^ *no ' "$out/devices.txt" | sed 's/^/    /')"$'\n\n'
}

# Accuracy of the device's arithmetic, and of the shipped shader functions on it.
arithmetic() {
    local code=0
    limited 300 "$program" devices --probe >"$out/arithmetic.txt" || code=$?
    cat "$out/arithmetic.txt"
    what=$(tail -n 1 "$out/arithmetic.txt")
    measured+="How exact its arithmetic is: [arithmetic.txt](arithmetic.txt), ${what#"${what%%[! ]*}"}"$'\n\n'
    return $code
}

# Images that must be equal: finds driver errors without a reference.
relations() {
    local code=0
    limited 900 "$program" audit "$relations_scene" --relations --force -o "$out/relations" \
        >"$out/relations.txt" 2>&1 || code=$?
    cat "$out/relations.txt"
    what=$(grep -E 'relations hold' "$out/relations.txt" | tail -n 1)
    measured+="Pictures that must be alike: [relations.txt](relations.txt), ${what:-none}"$'\n\n'
    [ $code -eq 0 ] || what="${what:-exit code $code}"
    return $code
}

# The failing channels of a report.json.
failed_channels() {
    awk '/"number":/ { channel = 1 }
         /"name":/ { name = $2; gsub(/[",]/, "", name) }
         channel && /"verdict": "fail"/ { printf "%s%s", sep, name; sep = ", " }
         /"verdict":/ { channel = 0 }' "$1"
}

# The largest relative depth difference in a report.json; no encoding explains any.
depth_difference() {
    awk '/"name":/ { name = $2 }
         name == "\"depth\"," && /"max":/ { sub(/,$/, "", $2); printf "%s", $2; exit }' "$1" 2>/dev/null
}

# A command's output without progress lines.
without_progress() { grep -Ev '^diptych: [^ ]+: +[0-9]+ % |/index\.html$|^$' "$1"; }

# validation SCENES...: compares each under the validation layers.
validation() {
    local scene file code message depth bad=0 differing=0 depths=0 t
    mkdir -p "$out/validation"
    printf '# Validation, scene by scene\n\n| scene | exit code | seconds | depths differ by | message |\n' \
        >"$out/validation.md"
    printf '|---|---|---|---|---|\n' >>"$out/validation.md"
    for scene in "$@"; do
        file=${scene#builtin:}
        file=$out/validation/${file//[^A-Za-z0-9_]/_}
        t=${EPOCHREALTIME/./}
        printf '%s\n' "$scene"
        limited 300 "$program" compare "$scene" --validate --size 160x90 --runs 1 -o "$file" \
            2>"$scratch/error"
        code=$?
        t=$(((${EPOCHREALTIME/./} - t) / 100000))
        cat "$scratch/error"
        message=$(without_progress "$scratch/error" | tail -n 1)
        depth=$(depth_difference "$file/report.json")
        [[ $depth =~ ^(0(\.0*)?)?$ ]] || depths=$((depths + 1))
        case $code in
            0) mv "$file/report.json" "$file.json" && rm -rf -- "$file" ;;
            1) message="differs: $(failed_channels "$file/report.json")" ;;
            124 | 137) message="took too long" ;;
        esac
        printf '| %s | %d | %d.%d | %s | %s |\n' "$scene" $code $((t / 10)) $((t % 10)) "$depth" \
            "$(cell "$message" 1000)" >>"$out/validation.md"
        [ $code -ne 1 ] || differing=$((differing + 1))
        [ $code -le 1 ] || bad=$((bad + 1))
        [ $code -eq 0 ] || faults+="    - \`$scene\`: exit code $code: $(cell "$message" 400)"$'\n'
    done
    what="$# scenes, $differing differ, $bad with messages or errors, $depths with other depths:"
    what+=" [table](validation.md)"
    [ $((differing + bad)) -eq 0 ]
}

# From a GoogleTest log: the failed TESTs and the first failure of each.
failed_tests() {
    awk '/^\[ RUN      \]/ { name = $4; text = ""; lines = 0; next }
         /^\[  FAILED  \] .*\([0-9]+ ms/ {
             if (++n <= 25) printf "    - `%s`:%s\n", name, text
             name = ""; next
         }
         /^\[/ { name = ""; next }
         name != "" && /: Failure$/ { ++lines; next }
         name != "" && lines == 1 && length(text) < 300 {
             gsub(/[`|]/, " "); gsub(/^ +/, ""); text = text " " $0
         }
         END {
             if (n > 25) printf "    - and %d more\n", n - 25
             if (name != "") printf "    - `%s`: it ended in this one\n", name
         }' "$1"
}

# tests PROGRAM FILTER: the TESTs of one of the programs, in one process.
tests() {
    local tests=$build/tests/$1 filter=$2 code log=$out/$name.log ran failed skipped
    if [ ! -x "$tests" ] ||
        ! limited 60 "$tests" --gtest_list_tests --gtest_filter="$filter" 2>/dev/null | grep -q '^  '; then
        what="not in this build"
        return 3
    fi
    limited 1000000 "$tests" --gtest_filter="$filter" --gtest_output="xml:$out/$name.xml"
    code=$?
    ran=$(grep -c '^\[ RUN      \]' "$log")
    failed=$(grep -c '^\[  FAILED  \] .*([0-9]* ms' "$log")
    skipped=$(grep -c '^\[  SKIPPED \] .*([0-9]* ms' "$log")
    what="$ran TESTs, $failed failed"
    [ "$skipped" -eq 0 ] || what+=", $skipped skipped"
    faults=$(failed_tests "$log")
    [ -z "$faults" ] || faults+=$'\n'
    [ $code -le 1 ] || what+=", ended by exit code $code"
    [ $code -eq 0 ] || return 1
    if [ "$skipped" -gt 0 ]; then
        [ "$skipped" -lt "$ran" ] || return 3
        left_out+="- \`$name\`: $skipped TESTs were skipped, the log says why."$'\n'
    fi
}

# probe SUITE: runs it from the program that has it, with its output and recorded properties.
probe() {
    local suite=$1 candidate code
    for candidate in unit_tests probe_tests image_tests; do
        tests $candidate "$suite.*:*/$suite.*"
        code=$?
        [ $code -eq 3 ] || break
    done
    [ $code -ne 3 ] || return 3
    local found
    found=$({
        grep -Ev '^(\[|Note:|Running|$)|TESTs?, |tests? from' "$out/$name.log"
        [ ! -e "$out/$name.xml" ] ||
            sed -n 's/.*<property name="\([^"]*\)" value="\([^"]*\)".*/\1: \2/p' "$out/$name.xml"
    } | head -n 60 | sed 's/^/    /')
    [ -z "$found" ] || measured+="\`$suite\`:"$'\n\n'"$found"$'\n\n'
    return $code
}

# bench ARGUMENTS...: the table goes to the log, the page to the step's own folder.
bench() {
    set -- "$@" --size "$bench_size" --paths deferred,forward_plus -o "$out/$name"
    if ! limited 1000000 "$program" bench "$@"; then
        what=$(tail -n 1 "$out/$name.log")
        return 1
    fi
    what="[bench.json]($name/bench.json), [page]($name/index.html)"
    measured+="\`$name\`:"$'\n\n'"$(without_progress "$out/$name.log" | cut -c1-94 | sed 's/^/    /')"$'\n\n'
}

# kernels RUNS: one light at one pixel.
kernels() {
    if [ ! -x "$build/tests/bench_kernels" ]; then
        what="not in this build"
        return 3
    fi
    if ! limited 1000000 "$build/tests/bench_kernels" "$1"; then
        what=$(tail -n 1 "$out/$name.log")
        return 1
    fi
    what="$(grep -c ' buffer,' "$out/$name.log") kernels"
    measured+="\`$name\`:"$'\n\n'"$(sed 's/^/    /' "$out/$name.log")"$'\n\n'
}

absent() {
    what=$1
    return 3
}

# ---- the run -----------------------------------------------------------------------------------------

printf '%s, %s: %s\nresults in %s\n' "$device" "$type" "$about" "$out"
case $amount in
    whole | long) export DIPTYCH_CAMPAIGN=1 ;;
esac

step devices 240 devices
step arithmetic 300 arithmetic
relations_scene=builtin:gallery
[ "$amount" != quick ] || relations_scene=builtin:triangle
step relations 900 relations

mapfile -t scenes < <("$program" render --list-scenes --json 2>/dev/null |
    sed -n 's/^ *"name": "\(builtin:[^"?]*\).*/\1/p')
[ "$amount" != quick ] || scenes=(builtin:triangle builtin:points)
step validation 3600 validation "${scenes[@]}"

step no-contraction 600 probe NoContraction
[ "$amount" = quick ] || step depth-equality 1200 probe DepthEquality

bench_size=1280x720
case $amount in
    quick)
        left_out+="- --quick: all scenes but two, of the matrix all but a TEST, of the probes all but a"
        left_out+=" suite, and Sponza."$'\n'
        bench_size=64x36
        step parity 300 tests image_tests 'Builtin/BuiltinParity.FullIsBitEqual/triangle'
        step probes 300 tests probe_tests 'Lights.*'
        step bench-spheres 300 bench 'builtin:spheres?lights=4' --runs 1 --assign clustered
        ;;
    cut)
        left_out+="- A CPU device: of \`light-matrix\`, the gallery but for 257 lights, 4,096 lights, the"
        left_out+=" campaign; of \`parity\`, packed encodings and most pre-passes; of \`light-lists\`, 65,600"
        left_out+=" lights; the step \`other-pictures\`; of benchmarks, the"
        left_out+=" assignments every and per_object, other light counts, the step \`kernels\`. --long asks"
        left_out+=" all."$'\n'
        parity='Builtin/BuiltinParity.FullIsBitEqual/*:Builtin/StandardParity.APrepass*/gallery'
        step parity 240 tests image_tests "$parity"
        step light-matrix 180 tests image_tests 'Lights/LightMatrix.*/spheres_*:*/gallery_257_*-*_4096_*'
        step light-pairs 240 tests image_tests 'Builtin/LightPairs.*'
        step light-extremes 120 tests image_tests 'LightExtremes.*:LightNegativeControls.*'
        step light-lists 120 tests image_tests 'LightLists.*-LightLists.SixtyFive*'
        step assets 180 tests image_tests 'Asset/AssetParity.*'
        step probes 120 tests probe_tests '*'
        step bench-spheres 120 bench builtin:spheres --runs 3 --assign clustered,tiled
        sponza_options=(--light-counts 64 --runs 3 --assign "clustered,tiled")
        ;;
    whole | long)
        others='*-Builtin/*Parity.*:*/LightMatrix.*:*/LightPairs.*:*/Asset*:AssetScenes.*'
        others+=':LightExtremes.*:LightLists.*:LightNegativeControls.*'
        step parity 3600 tests image_tests 'Builtin/*Parity.*:Parity*:Verdict*'
        step light-matrix 3600 tests image_tests 'Lights/LightMatrix.*'
        step light-pairs 3600 tests image_tests 'Builtin/LightPairs.*'
        step light-extremes 1800 tests image_tests 'LightExtremes.*:LightNegativeControls.*'
        step light-lists 1800 tests image_tests 'LightLists.*'
        step assets 3600 tests image_tests '*Asset*'
        step probes 1800 tests probe_tests '*'
        step other-pictures 3600 tests image_tests "$others:Parity*:Verdict*"
        spheres_options=(--light-counts "64,256,1024,4096" --runs 9)
        sponza_options=(--light-counts "64,256,1024" --runs 9)
        kernel_runs=15
        if [ "$amount" = long ]; then
            spheres_options=(--light-counts "16,64,256,1024,4096,16384" --runs 31)
            sponza_options=(--light-counts "64,256,1024" --runs 31)
            kernel_runs=31
        fi
        step bench-spheres 1800 bench builtin:spheres "${spheres_options[@]}"
        step kernels 600 kernels "$kernel_runs"
        ;;
esac
if [ "$amount" != quick ]; then
    sponza=${DIPTYCH_SPONZA:-$home/../shared/assets/scenes/sponza/Sponza.gltf}
    lights=$home/../shared/bench/sponza-{}.lights.json
    [ -e "${lights/\{\}/64}" ] || lights=point:64
    if [ -e "$sponza" ]; then
        step bench-sponza 1800 bench "$sponza" --lights "$lights" "${sponza_options[@]}"
    else
        step bench-sponza 1 absent "no ../shared/assets/scenes/sponza/Sponza.gltf, and no DIPTYCH_SPONZA"
    fi
fi

summary
printf '%s\n' "$out/README.md"
[ $failures -eq 0 ]
