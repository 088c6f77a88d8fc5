#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Starts a program of the bundle; as `run_tests`, all of its tests. A library of lib/fallback is used only where the system has none
# of that name (any system with glibc 2.36 that has a libstdc++ has one that is new enough).
here=$(dirname -- "$(readlink -f -- "$0")")

known=$(/sbin/ldconfig -p 2>/dev/null || ldconfig -p 2>/dev/null)
for folder in "$here"/lib/fallback/*; do
    name=${folder##*/}
    case $known in
    *"$name (libc6,x86-64"*) ;;
    *)
        found=
        for place in $(printf '%s' "${LD_LIBRARY_PATH:-}" | tr : ' ') /usr/lib64 /usr/lib /usr/lib/x86_64-linux-gnu; do
            [ ! -e "$place/$name" ] || found=yes
        done
        [ -n "$found" ] || export LD_LIBRARY_PATH="${LD_LIBRARY_PATH:+$LD_LIBRARY_PATH:}$folder"
        ;;
    esac
done

program=${0##*/}
[ "$program" = run_tests ] || exec "$here/bin/$program" "$@"

export GNOMON_ROOT="$here/source"
status=0
for program in "$here"/bin/*_tests; do "$program" "$@" || status=1; done
exit $status
