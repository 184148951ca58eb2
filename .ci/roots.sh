#!/usr/bin/env bash
# roots.sh DIR SUITE...: makes DIR/trixie (Blender 4.3, Python 3.13) and DIR/sid (Blender 5.2, Python 3.14), each a Debian in
# a folder, unless it is there already. Needs debootstrap, and root for the making. The stamp DIR/SUITE/.complete holds the
# names of the packages that were asked for: a root that was broken off is made again, one without a package is given it.
# roots.sh --is-whole DIR SUITE: whether nothing is to be done; needs nothing.
set -euo pipefail

# libgl1 and libglx-mesa0: Blender opens a window by them, but Debian's package does not ask for them (5.2).
# libsm6, libice6 and libxkbcommon0: what the official Blender 5.2, a module, is linked to.
packages=(
    blender python3-numpy python3-requests python3-dev pybind11-dev libgl1-mesa-dri libegl1 libgl1 libglx-mesa0
    libsm6 libice6 libxkbcommon0
)

# is_whole ROOT: a root may have more, which another version of Motus has asked for.
is_whole() {
    local package had
    had=" $(cat "$1/.complete" 2>/dev/null) "
    for package in "${packages[@]}"; do [[ $had == *" $package "* ]] || return 1; done
}

if [[ ${1:-} == --is-whole ]]; then
    is_whole "$2/$3"
    exit
fi

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

# Clones share the folder: of two that want the same, the second waits for what the first makes.
mkdir -p -- "$dir"
exec {lock}>"$dir/.lock"
flock "$lock"

make_root() {
    local suite=$1 root=$dir/$1
    umount --recursive "$root/proc" "$root/dev" 2>/dev/null || true
    rm -rf --one-file-system -- "$root"
    mkdir -p -- "$root"
    debootstrap --variant=minbase --include=ca-certificates "$suite" "$root"
    cp /etc/resolv.conf "$root/etc/"
    cp /etc/apt/apt.conf.d/* "$root/etc/apt/apt.conf.d/"  # how this machine reaches the mirrors
}

install_packages() {
    local suite=$1 root=$dir/$1
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
    printf '%s\n' "${packages[*]}" "$(cat "$root/.complete" 2>/dev/null)" | tr ' ' '\n' | sort -u | xargs >"$root/.complete.new"
    mv -- "$root/.complete.new" "$root/.complete"
}

for suite; do
    is_whole "$dir/$suite" && continue
    [[ -f $dir/$suite/.complete ]] || make_root "$suite"
    install_packages "$suite"
done
