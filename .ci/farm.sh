# A shot rendered by an existing farm engine: what .ci/farm/farm.py asks of Motus; a part of ../motus, which sources this file.
# shellcheck shell=bash

command_farm() {
    wish "${module_needs[@]}" || true # for the openjd of PyPI
    system_python_first
    exec "$python" "$here/.ci/farm/farm.py" --programs "$cache/programs" "$@"
}

# choose_worker [COMMAND]: sets `blender`, `blender_version` and `profile`; COMMAND is a command of several words, a name in .ci/blenders.py, or missing.
choose_worker() {
    local kind exact suite abi
    if [[ -z ${1:-} ]]; then
        drawing_blender
    elif row_of "$1"; then
        choose_blender "$1" || exit 1
    else
        mapfile -t blender < <(xargs -n 1 printf '%s\n' <<<"$1")
        blender_version=$("${blender[@]}" --version 2>/dev/null | sed -n 's/^Blender \([0-9]*\.[0-9]*\).*/\1/p' | head -n 1) || true
        [[ $blender_version ]] || fail "$1 is no Blender: it does not say its version when it is given --version"
        profile=$build/profiles/farm-$(cksum <<<"$1" | cut -d ' ' -f 1)
    fi
}

# choose_zip: sets MOTUS_ZIP to what `blender` takes.
choose_zip() {
    local zip
    if [[ -n ${MOTUS_PREPARED:-}${MOTUS_ZIP:-} ]]; then zip=$(zip_for "$blender_version"); else own_zip; fi
    export MOTUS_ZIP=$zip
}

# The next three are for .ci/farm/farm.py; each begins with the COMMAND of choose_worker, which may be empty.
command_farm_blender() { # prints the words of the command, quoted for a shell
    choose_worker "$1"
    printf '%q ' "${blender[@]}"
}
command_farm_zip() { # prints the path of the zip that workers install
    choose_worker "$1"
    choose_zip
    echo "$MOTUS_ZIP"
}
command_farm_hand_over() { # COMMAND SHOT RESULT FIRST LAST
    choose_worker "$1"
    choose_zip
    run_blender --background --python-exit-code 1 --python "$here/.ci/farm/hand_over.py" -- "${@:2}"
}
