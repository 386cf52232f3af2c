#!/bin/sh
# SPDX-License-Identifier: MIT
# Installs the .deb on a minimal Debian, and compares the gallery there, with the seconds to the verdict:
#   cmake --build build --target package
#   tests/package-on-bare-debian.sh build/diptych_*.deb [bookworm|trixie]      the Debian that built it (bookworm)
# Needs root, debootstrap and a network; takes some minutes and 1 GB in TMPDIR.
set -eu
[ $# -ge 1 ] && [ $# -le 2 ] && [ -f "$1" ] || { echo "usage: $0 FILE.deb [bookworm|trixie]" >&2; exit 2; }
for need in debootstrap chroot; do
    command -v $need >/dev/null || { echo "$0: $need is missing; apt-get install debootstrap" >&2; exit 2; }
done
[ "$(id -u)" -eq 0 ] || { echo "$0: is for root: debootstrap and chroot are" >&2; exit 2; }

bare=$(mktemp -d)
trap 'umount "$bare/proc" 2>/dev/null || true; rm -rf -- "$bare"' EXIT INT TERM
debootstrap --variant=minbase "${2:-bookworm}" "$bare" "${DEBIAN_MIRROR:-http://deb.debian.org/debian}" >"$bare.log" 2>&1 ||
    { cat "$bare.log" >&2; exit 2; }
rm -f -- "$bare.log"
cp -- "$1" "$bare/root/diptych.deb"
cp -- /etc/resolv.conf "$bare/etc/resolv.conf"
# Uses this machine's proxy or mirror there as well.
for file in /etc/apt/apt.conf.d/*proxy*; do [ ! -f "$file" ] || cp -- "$file" "$bare/etc/apt/apt.conf.d/"; done
mount -t proc proc "$bare/proc"
chroot "$bare" sh -euc '
    export DEBIAN_FRONTEND=noninteractive LC_ALL=C
    apt-get -q update
    began=$(date +%s)
    apt-get -q -y --no-install-recommends install /root/diptych.deb
    diptych --version
    cd /root
    installed=$(date +%s)
    diptych compare && status=0 || status=$?
    echo "$((installed - began)) s to install, $(($(date +%s) - installed)) s to the verdict"
    exit $status'
