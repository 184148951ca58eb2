# What a command needs of the system, and how it gets there: apt-get installs it on Debian 12 and 13, elsewhere one line says what to install.
# A part of ../motus, which sources this file.
# shellcheck shell=bash

os_release=/etc/os-release
loader=/lib64/ld-linux-x86-64.so.2 # of programs on x86-64; says which levels of these processors this one has

# PACKAGE:PROBE, Debian's name of a package, and what shows that it is there: a program, or a file. Of several with | between one is enough, as
# systems lay files differently. GCC optimises on all processors at once where there is a make.
build_needs=(
    g++:g++ make:make cmake:cmake ninja-build:ninja binutils:objdump libglm-dev:/usr/include/glm/glm.hpp
    libhwy-dev:/usr/include/hwy/highway.h
    pybind11-dev:/usr/include/pybind11/pybind11.h "catch2:/usr/include/catch2/catch.hpp|/usr/include/catch2/catch_all.hpp"
    python3-dev:/usr/bin/python3-config
    "python3-numpy:/usr/lib/python3/dist-packages/numpy|/usr/lib*/python3.*/site-packages/numpy"
)
# What a Blender draws with: it opens these libraries when it begins to render, and Debian's package asks for none of them.
drawing_needs=(
    "libegl1:/usr/lib/*/libEGL.so.1|/usr/lib64/libEGL.so.1|/usr/lib/libEGL.so.1"
    "libgl1:/usr/lib/*/libGL.so.1|/usr/lib64/libGL.so.1|/usr/lib/libGL.so.1"
    "libgl1-mesa-dri:/usr/lib/*/dri|/usr/lib64/dri|/usr/lib/dri|/usr/lib/*/libEGL_nvidia.so.0"
)
blender_needs=(blender:blender "${drawing_needs[@]}")
test_needs=(clang:clang++ xvfb:Xvfb "${drawing_needs[@]}")
module_needs=("python3-venv:/usr/lib*/python3.*/ensurepip")
# What official Blenders, which are modules of Python, are linked to and import.
official_needs=(
    "${module_needs[@]}" "${drawing_needs[@]}"
    "python3-requests:/usr/lib/python3/dist-packages/requests|/usr/lib*/python3.*/site-packages/requests"
    "libxrender1:/usr/lib/*/libXrender.so.1|/usr/lib64/libXrender.so.1|/usr/lib/libXrender.so.1"
    "libxfixes3:/usr/lib/*/libXfixes.so.3|/usr/lib64/libXfixes.so.3|/usr/lib/libXfixes.so.3"
    "libxi6:/usr/lib/*/libXi.so.6|/usr/lib64/libXi.so.6|/usr/lib/libXi.so.6"
    "libxkbcommon0:/usr/lib/*/libxkbcommon.so.0|/usr/lib64/libxkbcommon.so.0|/usr/lib/libxkbcommon.so.0"
    "libsm6:/usr/lib/*/libSM.so.6|/usr/lib64/libSM.so.6|/usr/lib/libSM.so.6"
)
wine_needs=(wine64:/usr/lib/wine/wine64 maven:mvn)
farm_needs=(slurm-wlm:/usr/sbin/slurmctld munge:/usr/sbin/munged)
reader_needs=("chromium:chromium|chromium-browser|google-chrome")
lint_needs=(clang-format:clang-format clang-tidy:clang-tidy shellcheck:shellcheck git:git "${module_needs[@]}")
root_needs=(debootstrap:/usr/sbin/debootstrap)
# What CMake's presets of other compilers and systems need beside build_needs: a compiler, and an emulator for what it makes.
declare -A preset_needs=(
    [aarch64-linux]="g++-aarch64-linux-gnu:aarch64-linux-gnu-g++ qemu-user:qemu-aarch64"
    [windows-x64]="g++-mingw-w64-x86-64-posix:x86_64-w64-mingw32-g++-posix wine64:/usr/lib/wine/wine64"
    [libcxx]="clang-19:clang++-19 libc++-19-dev:/usr/lib/llvm-19/include/c++/v1 libc++abi-19-dev:/usr/lib/llvm-19/lib/libc++abi.so"
    [threads]="clang:clang++ libclang-rt-dev:/usr/lib/llvm-*/lib/clang/*/lib/linux/libclang_rt.tsan-x86_64.a"
    [wasm32]="${module_needs[*]}"
    [fuzz]="clang:clang++ libclang-rt-dev:/usr/lib/llvm-*/lib/clang/*/lib/linux/libclang_rt.fuzzer-x86_64.a"
)

# Names of the same packages: of Fedora and its kin, and of Arch.
declare -A dnf_names=(
    [g++]=gcc-c++ [ninja-build]=ninja-build [libglm-dev]=glm-devel [libhwy-dev]=highway-devel [pybind11-dev]=pybind11-devel [catch2]=catch-devel
    [python3-dev]=python3-devel [xvfb]=xorg-x11-server-Xvfb [libgl1-mesa-dri]=mesa-dri-drivers [python3-venv]=python3
    [libxrender1]=libXrender [libxfixes3]=libXfixes [libxi6]=libXi [libxkbcommon0]=libxkbcommon [libsm6]=libSM [libegl1]=libglvnd-egl [libgl1]=libglvnd-glx
    [clang-format]=clang-tools-extra [clang-tidy]=clang-tools-extra [shellcheck]=ShellCheck
)
declare -A pacman_names=(
    [g++]=gcc [ninja-build]=ninja [libglm-dev]=glm [libhwy-dev]=highway [pybind11-dev]=pybind11
    [python3-dev]=python [python3-numpy]=python-numpy [python3-requests]=python-requests [xvfb]=xorg-server-xvfb [libgl1-mesa-dri]=mesa [python3-venv]=python
    [libxrender1]=libxrender [libxfixes3]=libxfixes [libxi6]=libxi [libxkbcommon0]=libxkbcommon [libsm6]=libsm [libegl1]=libglvnd [libgl1]=libglvnd
    [clang-format]=clang [clang-tidy]=clang
)

# of_os KEY: a value of os-release, without quotation marks.
of_os() { sed -n "s/^$1=//p" "$os_release" 2>/dev/null | tr -d '"' | head -n 1; }

# installs_itself: whether the packages of this system are known by name and contents, so that a command may install what it needs.
installs_itself() { [[ $(of_os ID) == debian && $(of_os VERSION_CODENAME) =~ ^(bookworm|trixie)$ ]]; }

# as_root COMMAND...: false where there is no way to be root.
as_root() {
    if ((EUID == 0)); then "$@"; elif command -v sudo >/dev/null; then sudo "$@"; else return 1; fi
}

# package_manager: prints apt-get, dnf or pacman, by what the system says that it is, or else by what is on it; nothing for another.
package_manager() {
    local kin program
    for kin in $(of_os ID) $(of_os ID_LIKE); do
        case $kin in
            debian | ubuntu) echo apt-get; return ;;
            fedora | rhel | centos) echo dnf; return ;;
            arch) echo pacman; return ;;
        esac
    done
    for program in apt-get dnf pacman; do
        if command -v "$program" >/dev/null; then echo "$program"; return; fi
    done
}

# install_line PACKAGE...: how packages, given by Debian's names, are installed on this system.
install_line() {
    local package names=()
    case $(package_manager) in
        apt-get) echo "sudo apt-get install $*" ;;
        dnf)
            for package; do names+=("${dnf_names[$package]:-$package}"); done
            echo "sudo dnf install $(printf '%s\n' "${names[@]}" | awk '!seen[$0]++' | xargs)"
            ;;
        pacman)
            for package; do names+=("${pacman_names[$package]:-$package}"); done
            echo "sudo pacman -S --needed $(printf '%s\n' "${names[@]}" | awk '!seen[$0]++' | xargs)"
            ;;
        *) echo "by your system's names for what Debian calls $*" ;;
    esac
}

# is_there PROBE
is_there() {
    local probe probes
    IFS='|' read -ra probes <<<"$1"
    for probe in "${probes[@]}"; do
        if [[ $probe == /* ]]; then compgen -G "$probe" >/dev/null; else command -v "$probe" >/dev/null; fi && return
    done
    return 1
}

# find_missing PACKAGE:PROBE...: sets `missing` to the packages that are not there.
find_missing() {
    local pair
    missing=()
    for pair; do is_there "${pair#*:}" || missing+=("${pair%%:*}"); done
}

# need PACKAGE:PROBE...: installs what is missing on Debian 12 and 13; elsewhere, or with no way to be root, says how to install it and stops.
need() {
    local missing
    find_missing "$@"
    ((${#missing[@]})) || return 0
    if ! installs_itself || ! as_root true 2>/dev/null; then
        fail "this system lacks what Motus needs here; install it with: $(install_line "${missing[@]}")"
    fi
    mkdir -p "$cache"
    install_packages "$@" 8>"$cache/installing"
}

# install_packages PACKAGE:PROBE...: by apt-get, what is missing still when no other clone is installing: apt-get does not wait for another one that
# reads the lists of packages. File descriptor 8 is the lock; a service that a package starts must not keep it.
install_packages() (
    flock 8
    find_missing "$@"
    ((${#missing[@]})) || exit 0
    say "installing by apt-get: ${missing[*]}"
    logged apt as_root apt-get update -q 8>&-
    # Other programs that install, such as a machine's own updates, are waited for.
    logged apt as_root env DEBIAN_FRONTEND=noninteractive apt-get -o DPkg::Lock::Timeout=600 install -y -q --no-install-recommends "${missing[@]}" 8>&-
)

# wish PACKAGE:PROBE...: the same for what a command can do without; false where it cannot be installed.
wish() { if installs_itself; then (need "$@"); fi; }

# has_preset PRESET: false, with the reason, where a compiler or emulator of it is neither there nor can be installed, or this processor could not
# run what it makes.
has_preset() {
    local needs missing
    read -ra needs <<<"${preset_needs[$1]:-}"
    wish "${needs[@]}" || true
    find_missing "${needs[@]}"
    ((${#missing[@]} == 0)) || { say "SKIPPED: the preset $1 lacks what Debian calls ${missing[*]}"; return 1; }
    [[ $1 != x86-64-v* || $("$loader" --help 2>/dev/null) == *" $1 (supported"* ]] ||
        { say "SKIPPED: this processor cannot run programs for $1"; return 1; }
}
