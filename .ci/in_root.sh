#!/usr/bin/env bash
# in_root.sh ROOT COMMAND [ARGS...]: runs a program of the Debian in folder ROOT on this machine's files.
# Programs and libraries come from ROOT; every other folder (home, work, mnt, tmp, ...) is this machine's own, at the same
# path, and so are the current folder and each ARG that is a file. The mounts are private to the process: nothing is left.
set -euo pipefail

# Private mounts want root: as root, or as root of a user namespace of one's own, or by sudo (the program runs as the user).
if [[ ${1:-} != --inside ]]; then
    self=$(readlink -f -- "${BASH_SOURCE[0]}")
    if ((EUID == 0)); then
        exec unshare --mount --propagation private -- bash "$self" --inside '' "$@"
    elif unshare --user --map-root-user --mount true 2>/dev/null; then
        exec unshare --user --map-root-user --mount --propagation private -- bash "$self" --inside '' "$@"
    fi
    exec sudo --preserve-env unshare --mount --propagation private -- bash "$self" --inside "$(id -u):$(id -g)" "$@"
fi
user=$2 root=$3 # user: whom to become, where it is sudo that made us root
shift 3

new=$root/mnt
mount -t tmpfs tmpfs "$new"

# show SOURCE PATH: SOURCE of this machine or of ROOT appears at PATH.
show() {
    if [[ -L $1 ]]; then
        cp -P -- "$1" "$new$2"
    elif [[ -d $1 ]]; then
        mkdir -p -- "$new$2"
        mount --rbind -- "$1" "$new$2"
    elif [[ -f $1 ]]; then
        mkdir -p -- "$(dirname -- "$new$2")"
        touch -- "$new$2"
        mount --bind -- "$1" "$new$2"
    fi
}

for entry in "$root"/*; do
    name=/${entry##*/}
    case $name in
        /bin | /sbin | /lib* | /usr | /etc | /var) show "$entry" "$name" ;;
    esac
done
for name in /*; do
    case $name in
        /bin | /sbin | /lib* | /usr | /etc | /var | /boot | /lost+found) ;;
        *) show "$name" "$name" ;;
    esac
done
show /var/tmp /var/tmp

# What the command needs from below a system folder. A mount point stays behind in ROOT, so an empty one counts as missing.
clone=$(dirname -- "$(dirname -- "$(readlink -f -- "${BASH_SOURCE[0]}")")")
for folder in "$clone" "$PWD"; do
    [[ -n $(ls -A -- "$new$folder" 2>/dev/null) ]] || show "$folder" "$folder"
done
for argument in "${@:2}"; do
    [[ $argument != /* || ! -f $argument || $argument -ef $new$argument ]] || show "$argument" "$argument"
done

# Two releases of Mesa cut and grow each other's index of shaders, which both have mapped, and die by SIGBUS.
shaders=${MOTUS_CACHE:-${XDG_CACHE_HOME:-$HOME/.cache}/motus}/shaders/${root##*/}

MESA_SHADER_CACHE_DIR=${MESA_SHADER_CACHE_DIR:-$shaders} exec chroot ${user:+"--userspec=$user"} "$new" /usr/bin/env -C "$PWD" "$@"
