# `./motus package --platforms`: wheels and zips for other systems and for this one's official Blenders; a part of ../motus, which sources this file.
# shellcheck shell=bash

# Debian's packages beside build_needs: the client of Maven Central, and what pip is run by.
platform_needs=(maven:mvn "${module_needs[@]}")

# use_zig PLATFORM: sets `given`, CMake's options for that compiler. Exit status 77, with the reason, where what it needs cannot be had.
use_zig() {
    local found status=0
    found=$("$python" "$here/.ci/platforms.py" "$cache" "$1") || status=$?
    case $status in
        0) ;;
        2) fail "$found" ;;
        *) say "SKIPPED: $1: $found"; exit 77 ;;
    esac
    mapfile -t given <<<"$found"
    # What the compiler is called by is a script of this build; which compiler it is stands in there.
    export CCACHE_COMPILERCHECK=content ZIG_GLOBAL_CACHE_DIR=$cache/zig ZIG_LOCAL_CACHE_DIR=$build/zig
}

# build_platform PLATFORM: builds its native modules. Exit status 77, with the reason, where what that needs cannot be had.
build_platform() {
    local given launcher
    use_zig "$1"
    use_ccache
    configure "module-$1" "${given[@]}" "${launcher[@]}"
    logged "build-$1" ninja --quiet -j "$(nproc)" -C "$build/module-$1" motus_modules
    "$programs/python" "$here/.ci/check_modules.py" "$1" "$build/module-$1/python" 3.11 3.13
}

# split_builder: sets `builder`, the command of a Blender that makes and validates zips; false where there is none.
split_builder() {
    local name blender blender_version profile
    for name in 4.5-lts 5.2-lts; do
        if choose_blender "$name"; then
            builder=("${blender[@]}")
            return
        fi
    done
    extension_builder
    ((${#builder[@]}))
}

# validate_platforms: by the command of each official Blender that there is.
validate_platforms() {
    local name zip blender blender_version profile
    for name in 4.5-lts 5.2-lts; do
        choose_blender "$name" || continue
        for zip in "$dist"/platforms/motus-*.zip; do
            [[ $zip == *-legacy.zip ]] || (use_profile && logged validate "${blender[@]}" --command extension validate "$zip")
        done
        say "Blender $name finds the zips of all platforms valid"
    done
}

# package_platforms PLATFORM...: what can be had of it; the last line counts what was skipped. Exit status 77 if that is all.
package_platforms() {
    local platform programs builder made=() skipped=0 status
    need "${build_needs[@]}"
    wish "${platform_needs[@]}" || true # each platform says what it cannot do without
    pinned package || { say "SKIPPED: no platform could be packaged"; exit 77; }
    for platform; do
        status=0
        (build_platform "$platform") || status=$?
        case $status in
            0) made+=("$platform=$build/module-$platform/python") ;;
            77) ((skipped += 1)) ;;
            *) exit "$status" ;;
        esac
    done
    if ((${#made[@]} == 0)) || ! split_builder; then
        say "SKIPPED: no platform could be packaged"
        exit 77
    fi
    "$programs/python" "$here/.ci/package_platforms.py" --stage "$build/stage-platforms" --dist "$dist/platforms" "${made[@]}" -- "${builder[@]}"
    validate_platforms
    say "packaged for ${#made[@]} platforms, $skipped skipped"
}

# The next two are for .ci's groups of tests: what `./motus package --platforms` has made, on this system and, run by wine, on Windows.
command_test_package() { # NAME PATTERN...: the extension, in an official Blender
    local kind exact suite abi
    row_of "$1" || fail "there is no Blender $1"
    if [[ $kind != windows ]]; then
        MOTUS_ZIP=$(ls "$dist"/platforms/motus-*-linux_x64.zip 2>/dev/null) || { say "SKIPPED: there are no packages of linux-x64"; exit 77; }
    fi
    command_test_inside "$@"
}
command_test_wheel() { # PLATFORM PATTERN...: the native module as pip installs it, by the tests of the bindings
    local wheel tag programs folder windows_python windows=() target=$build/wheel-$1 tests=$here/native/tests/python
    if [[ $1 == windows-x64 ]]; then
        tag=cp311-cp311-win_amd64
        find_windows_python 3.11 || exit 77
        install_module 4.5-windows || exit 77 # for NumPy
        windows=(bash "$here/.ci/in_wine.sh" "$build/wine" "$windows_python")
    else
        tag=$("$python" -c 'import sys; print("cp%d%d" % sys.version_info[:2])')
        tag=$tag-$tag-manylinux_2_28_x86_64
        pinned test || exit 77
    fi
    wheel=$(ls "$dist/platforms"/motus_native-*-"$tag".whl 2>/dev/null) || { say "SKIPPED: there is no wheel $tag"; exit 77; }
    rm -rf "$target"
    cd "$here"
    export PYTHONDONTWRITEBYTECODE=1
    if ((${#windows[@]})); then
        logged wheel "${windows[@]}" -m pip install --no-index --no-deps --target "$target" "$wheel"
        PYTHONPATH="Z:$target;Z:$folder" exec "${windows[@]}" .ci/suite.py "$tests" "${@:2}"
    fi
    logged wheel "$programs/pip" install --no-index --no-deps --target "$target" "$wheel"
    PYTHONPATH=$target exec "$programs/python" .ci/outside_blender.py "$tests" "${@:2}"
}
