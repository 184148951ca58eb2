# Which zip a Blender takes, and how it is installed; a part of ../motus, which sources this file.
# shellcheck shell=bash

# own_abi: what the files of native modules are named by that the Python of `blender` loads, such as cpython-311-x86_64-linux-gnu.
own_abi() {
    (system_python_first && "${blender[@]}" --background --factory-startup --python-expr \
        'import importlib.machinery; print("SUFFIX", importlib.machinery.EXTENSION_SUFFIXES[0])') | sed -n 's/^SUFFIX \.\(.*\)\.so$/\1/p'
}

# pythons_of ABI...: such as "3.11, 3.13".
pythons_of() { printf '%s\n' "$@" | sed 's/^cpython-3\([0-9]*\)-.*/3.\1/' | paste -sd , | sed 's/,/, /g'; }

# can_build ABI
can_build() { module_abis | grep -x -- "$1" >/dev/null; } # not with -q, which ends at the first match: what is still writing would fail by that

# package_for_blender: from now on only the module that `blender` needs is built; the zips with it lie apart from the whole ones.
package_for_blender() {
    local abis
    only_abi=$(own_abi)
    if ! can_build "$only_abi"; then
        mapfile -t abis < <(module_abis)
        fail "Blender $blender_version runs Python $(pythons_of "$only_abi"), for which no native module can be built here:" \
            "there can be one for Python $(pythons_of "${abis[@]}"), and ./motus package --platforms linux-x64 makes zips for 3.11 and 3.13"
    fi
    dist=$build/dist-$only_abi
}

zip_for() { # the zip that a Blender of version $1 takes; MOTUS_ZIP names another, for tests of what is released
    if [[ -n ${MOTUS_ZIP:-} ]]; then echo "$MOTUS_ZIP"; elif at_least "$1" 4.2; then ls "$dist"/motus-*-extension.zip; else ls "$dist"/motus-*-legacy.zip; fi
}

# platform_zip ABI: the zip that `blender` takes of those that `./motus package --platforms` has made, if its Python is one of these.
platform_zip() {
    local ending=linux_x64.zip
    at_least "$blender_version" 4.2 || ending=linux_x64-legacy.zip
    [[ $1 =~ ^cpython-31[13]-x86_64-linux-gnu$ ]] && ls "$dist"/platforms/motus-*-"$ending" 2>/dev/null
}

# A distribution's Blender takes its Python from the first python3 on the PATH, and breaks with another than the system's.
system_python_first() { export PATH=/usr/bin:$PATH; }

# install_zip ZIP: into the profile that the environment names, or the user's own.
install_zip() {
    if at_least "$blender_version" 4.2; then
        logged install "${blender[@]}" --command extension install-file --repo user_default --enable "$1"
    else
        logged install "${blender[@]}" --background --python-exit-code 1 --python "$here/.ci/install_legacy.py" -- "$1"
    fi
}

# name_blender PATH: sets BLENDER, a program, by its path or by that of the folder of an unpacked official Blender.
name_blender() {
    BLENDER=$1
    if [[ -d $1 ]]; then
        BLENDER=${1%/}/blender
        [[ -x $BLENDER ]] || fail "the folder $1 has no program blender: give the folder of an unpacked Blender, or its program"
    elif [[ -f $1 && ! -x $1 ]]; then
        fail "$1 is no program: unpack the archive of Blender, and give the folder that comes out of it"
    fi
}

# says_native: prints what the installed add-on says about its native module; false if that cannot be used.
says_native() {
    local module=motus said
    if at_least "$blender_version" 4.2; then module=bl_ext.user_default.motus; fi
    said=$("${blender[@]}" --background --addons "$module" --python-expr \
        "import $module.core.native as native; print('NATIVE', native.status.code, native.status.sentence)" | sed -n 's/^NATIVE //p')
    echo "${said#* }"
    [[ $said == OK\ * ]]
}

# own_zip: sets `zip` to what `blender` takes. It is made first, unless only what `./motus package --platforms` has made fits.
own_zip() {
    local abi
    abi=$(own_abi)
    if can_build "$abi" || ! zip=$(platform_zip "$abi"); then
        package_for_blender
        lock
        package
        unlock
        zip=$(zip_for "$blender_version")
    fi
}

command_install() {
    local zip said
    if [[ ${1:-} == --blender ]]; then
        value_of "$1" "the path of a Blender" "${2:-}"
        name_blender "$2"
        shift 2
    fi
    nothing_else install "$@"
    default_blender
    own_zip
    system_python_first
    install_zip "$zip"
    said=$(says_native) || fail "installed into Blender $blender_version, which cannot use it: $said"
    say "installed into Blender $blender_version (${blender[*]}) and enabled: $said"
}

# command_without_motus VERSION ARGS...: runs a Blender in a fresh profile, for pictures of how Motus is installed. Exit status 77: there is none.
command_without_motus() {
    choose_blender "$1" || exit 77
    profile=$build/profiles/without-motus-$1
    rm -rf "$profile"
    mkdir -p "$profile"
    use_profile
    exec "${blender[@]}" "${@:2}"
}
