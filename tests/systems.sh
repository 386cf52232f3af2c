#!/bin/sh
# SPDX-License-Identifier: MIT
# Makes a minimal Debian, clones this repository into it (committed files only), and runs the README's two
# commands there:
#   tests/systems.sh debian12|debian13 [DIR]           CXX=clang++ tests/systems.sh debian13
# Prints versions, seconds and verdicts; a compiler warning is an error. Exit code 0: all passed, 1: a
# verdict or a test failed, 2: it could not run.
# Needs root, debootstrap and a network: some minutes plus the build, and 5 GB in DIR, which is kept for
# the next run. Without DIR it uses a folder of TMPDIR and removes it.
set -eu
fail() {
    printf '%s: %s\n' "$0" "$1" >&2
    exit 2
}
case ${1-} in
    debian12) suite=bookworm ;;
    debian13) suite=trixie ;;
    *) fail 'usage: debian12|debian13 [DIR]' ;;
esac
for need in debootstrap chroot unshare git; do
    command -v $need >/dev/null || fail "$need is missing; apt-get install debootstrap git"
done
[ "$(id -u)" -eq 0 ] || fail 'is for root: debootstrap and chroot are'
repository=$(git -C "$(dirname -- "$(readlink -f -- "$0")")" rev-parse --show-toplevel)

if [ $# -gt 1 ]; then
    mkdir -p -- "$2"
    system=$(readlink -f -- "$2")
else
    system=$(mktemp -d)
    trap 'rm -rf --one-file-system -- "$system"' EXIT INT TERM
fi
if [ ! -x "$system/usr/bin/apt-get" ]; then
    debootstrap --variant=minbase $suite "$system" "${DEBIAN_MIRROR:-http://deb.debian.org/debian}" \
        >"$system.log" 2>&1 || { cat "$system.log" >&2; fail "debootstrap failed (see above)"; }
    rm -f -- "$system.log"
fi
grep -qx "VERSION_CODENAME=$suite" "$system/etc/os-release" || fail "$system: holds another system than $1"
cp -- /etc/resolv.conf "$system/etc/resolv.conf"
# Uses this machine's proxy or mirror there as well.
for file in /etc/apt/apt.conf.d/*proxy*; do [ ! -f "$file" ] || cp -- "$file" "$system/etc/apt/apt.conf.d/"; done
rm -rf --one-file-system -- "$system/root/diptych" "$system/root/.cache"
git clone -q --no-hardlinks "$repository" "$system/root/diptych"

# Mounts end with the namespace, so that none is left when the folder is removed.
status=0
SYSTEM=$system unshare --mount sh -euc '
    mount --make-rprivate /
    for folder in proc sys dev; do mount --rbind /$folder "$SYSTEM/$folder"; done
    exec env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LC_ALL=C CXXFLAGS=-Werror ${CXX:+"CXX=$CXX"} chroot "$SYSTEM" sh -uc "$1"' sh '
    cd /root/diptych
    failed=0
    step() {
        name=$1 start=$(date +%s)
        shift
        "$@" >/root/step.log 2>&1 && verdict=passed || { verdict="failed, exit code $?" failed=1; tail -n 40 /root/step.log; }
        printf "%-28s %5d s  %s\n" "$name" $(($(date +%s) - start)) "$verdict"
    }
    if [ -n "${CXX-}" ]; then
        apt-get -q update >/dev/null && apt-get -q -y --no-install-recommends install clang >/dev/null 2>&1
    fi
    step "build, compare" ./diptych compare --size 640x360
    cat /root/step.log
    step "the same again" ./diptych compare --size 640x360
    step "build of the tests" ./diptych test -N
    step "unit, probe, compilers" ./diptych test -R "^(unit|probe)\.|CompileOn"
    grep -E "Skipped|% tests passed" /root/step.log
    . /etc/os-release
    printf "%s\n" "$PRETTY_NAME" "$("${CXX:-g++}" --version | head -n 1)"
    dpkg-query -W cmake glslang-tools libembree-dev mesa-vulkan-drivers spirv-tools vulkan-validationlayers
    exit $failed' || status=$?
exit $status
