#!/usr/bin/env bash
# roots.sh DIR SUITE...: makes DIR/trixie (Blender 4.3, Python 3.13) and DIR/sid (Blender 5.2, Python 3.14), each a Debian in
# a folder, unless it is there already. Needs debootstrap, and root for the making. The stamp DIR/SUITE/.complete says that
# a root is whole; one that was broken off is made again.
set -euo pipefail

# The mounts that the making needs are private to this process, so that none is left however it ends.
if [[ ${1:-} != --inside ]]; then
    self=$(readlink -f -- "${BASH_SOURCE[0]}")
    as_root=()
    ((EUID == 0)) || as_root=(sudo)
    exec "${as_root[@]}" unshare --mount --propagation private -- bash "$self" --inside "$@"
fi
shift
dir=$1
shift

packages=(blender python3-numpy python3-requests python3-dev pybind11-dev libgl1-mesa-dri libegl1)

make_root() {
    local suite=$1 root=$dir/$1
    umount --recursive "$root/proc" "$root/dev" 2>/dev/null || true
    rm -rf --one-file-system -- "$root"
    mkdir -p -- "$root"
    debootstrap --variant=minbase --include=ca-certificates "$suite" "$root"
    cp /etc/resolv.conf "$root/etc/"
    cp /etc/apt/apt.conf.d/* "$root/etc/apt/apt.conf.d/"  # how this machine reaches the mirrors
    mount --rbind /proc "$root/proc"
    mount --rbind /dev "$root/dev"
    export DEBIAN_FRONTEND=noninteractive
    chroot "$root" apt-get update -q
    chroot "$root" apt-get install -y -q --no-install-recommends "${packages[@]}"
    # Blender 5.2's extension command reads manifests with it; trixie's does without.
    [[ $suite != sid ]] || chroot "$root" apt-get install -y -q --no-install-recommends python3-cattr
    chroot "$root" apt-get clean
    umount --recursive "$root/proc" "$root/dev"
    chmod 1777 "$root/tmp"
    touch "$root/.complete"
}

for suite; do
    [[ -f $dir/$suite/.complete ]] || make_root "$suite"
done
