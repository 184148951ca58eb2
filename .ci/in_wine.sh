#!/usr/bin/env bash
# in_wine.sh FOLDER PROGRAM [ARGS...]: runs a program for Windows by wine, whose drive C: is in FOLDER. Drive Z: is this machine's files, and what the program has for
# its current drive; so a path such as /tmp/file is the same for both.
set -euo pipefail
export WINEPREFIX=$1 WINEDEBUG=-all DISPLAY=''
export PYTHONUTF8=1 # as the Python in Blender has it
wine=${WINELOADER:-/usr/lib/wine/wine64} # the variable is wine's own
exec 9>&- # the lock of ../motus: wine's server gets what its first program has open, and outlives the command that asked for that

# Made by one process, and used by all.
mkdir -p "$WINEPREFIX"
exec 8>"$WINEPREFIX/lock"
flock 8
[[ -f $WINEPREFIX/system.reg ]] || "$wine" wineboot --init >/dev/null 2>&1 8>&-
exec 8>&-

# Blender for Windows takes a path that begins with a slash for one beside the file that is open.
for name in "${!BLENDER_USER_@}"; do
    path=${!name}
    [[ $path != /* ]] || export "$name=Z:${path//\//\\}"
done

# Python for Windows wants a standard input that does not end, and an output that is no file.
input=$(mktemp -u "$WINEPREFIX/input.XXXXXX")
mkfifo "$input"
exec <>"$input"
rm "$input"
"$wine" "${@:2}" 2>&1 | cat
