#!/usr/bin/env bash
# One task of a farm: renders one frame of a shot. The worker needs bash and Blender.
# render.sh BLENDER FILE OUTPUT FORMAT LOGS ZIP FRAME
# BLENDER: command, quoted for a shell. OUTPUT: pattern of the pictures' names, such as /shots/film_####. FORMAT: such as PNG; empty for the scene's own.
# LOGS: folder for what Blender says; empty for the standard output. ZIP: Motus, for files that need it; empty for files that have been handed over.
set -euo pipefail
blender=()
eval "blender=($1)"
file=$2 output=$3 format=$4 logs=$5 zip=$6 frame=$7
number=$(printf '%.4d' "$frame")
if [[ $logs ]]; then
    mkdir -p "$logs"
    exec >>"$logs/frame_$number.log" 2>&1
fi

folder=$(mktemp -d "${output%/*}/.motus-$number-XXXXXX") # pictures come to their place when they are whole
trap 'rm -rf "$folder"' EXIT

install='import sys, bpy
zip = sys.argv[-1]
if zip.endswith("-legacy.zip"):  # for Blender before 4.2
    bpy.ops.preferences.addon_install(filepath=zip)
    bpy.ops.preferences.addon_enable(module="motus")
else:
    bpy.ops.extensions.package_install_files(repo="user_default", filepath=zip, enable_on_install=True)
if not hasattr(bpy.types.Object, "motus"):
    raise SystemExit("motus: the add-on could not be installed")'

options=()
if [[ $zip ]]; then
    export BLENDER_USER_RESOURCES=$folder/profile
    export MOTUS_PLANS=${output%/*}/farm/plans # what one task has computed for all frames, the others read
    options=(--python-exit-code 1 --python-expr "$install")
fi

# Without the options, this is the command that farms with a "simple Blender render" run as well.
"${blender[@]}" --background --enable-autoexec "${options[@]}" "$file" --render-output "$folder/pictures/${output##*/}" \
    ${format:+--render-format "$format"} --use-extension 1 --render-frame "$frame" ${zip:+-- "$zip"}

# Blender ends well, too, if it has written no picture.
shopt -s nullglob
pictures=("$folder"/pictures/*)
if ((${#pictures[@]} == 0)); then
    echo "motus: Blender has written no picture of frame $frame"
    exit 1
fi
mv -- "${pictures[@]}" "${output%/*}/"
