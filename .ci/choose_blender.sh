# Which Blender a command runs, and how it is started; a part of ../motus, which sources this file.
# shellcheck shell=bash

# row_of NAME: sets the words of a Blender's line in the table .ci/blenders.py. False for a name that the table does not have.
row_of() {
    local row
    row=$("$python" "$here/.ci/blenders.py" "$1") && read -r _ kind exact suite abi <<<"$row"
}

has_root() { [[ -f $roots/$1/.complete ]]; }

# Whether .ci/in_root.sh can make its mounts; a container may forbid them even to root.
can_enter_roots() {
    { ((EUID == 0)) && unshare --mount true 2>/dev/null; } || unshare --user --map-root-user --mount true 2>/dev/null ||
        { command -v sudo >/dev/null && sudo unshare --mount true 2>/dev/null; }
}

# make_root SUITE: false, with the reason, where it cannot be made.
make_root() {
    bash "$here/.ci/roots.sh" --is-whole "$roots" "$1" && return
    if ! as_root unshare --mount true 2>/dev/null; then
        has_root "$1" && return # one of an older version of Motus, which may lack a package
        say "SKIPPED: the Debian $1 system for other Blenders is made as root or with sudo, and with the right to mount"
        return 1
    fi
    need "${root_needs[@]}"
    say "making a Debian $1 system in $roots/$1 (some minutes, 2 GB)"
    mkdir -p "$build" "$roots"
    if ! bash "$here/.ci/roots.sh" "$roots" "$1" >"$build/root-$1.log" 2>&1; then
        tail -n 5 "$build/root-$1.log" >&2
        has_root "$1" && return
        say "SKIPPED: the Debian $1 system could not be made, see $build/root-$1.log"
        return 1
    fi
}

# make_roots: each Debian system whose Blender and Python this one may lack.
make_roots() {
    local suite
    for suite in trixie sid; do
        [[ $(of_os ID) == debian && $(of_os VERSION_CODENAME) == "$suite" ]] || make_root "$suite" || true
    done
}

# version_of PROGRAM: major.minor; Blender takes half a second to say, so the answer is kept until the program changes.
version_of() {
    local program key file
    program=$(command -v "$1") || fail "there is no Blender $1"
    key=$(stat -L -c '%n %Y %s' "$program")
    file=$build/versions/$(cksum <<<"$key" | tr ' ' -)
    if [[ ! -f $file ]]; then
        mkdir -p "$build/versions"
        "$program" --version | sed -n 's/^Blender \([0-9]*\.[0-9]*\).*/\1/p' | head -n 1 >"$file.$$"
        mv -- "$file.$$" "$file" # at once whole, for other processes that ask
    fi
    cat "$file"
}

at_least() { [[ $(printf '%s\n' "$1" "$2" | sort -V | head -n 1) == "$2" ]]; }

# install_module NAME: sets `folder`, in which an official Blender is; false, with the reason, where it cannot be had.
install_module() {
    wish "${official_needs[@]}" || { say "SKIPPED: the official Blender $1 lacks what is named above"; return 1; }
    folder=$("$python" "$here/.ci/official.py" "$cache/official" "$1") ||
        { say "SKIPPED: pip could not install the official Blender $1: $folder"; return 1; }
}

# own_python: major.minor of this system's Python.
own_python() { "$python" -c 'import sys; print("%d.%d" % sys.version_info[:2])'; }

# choose_module NAME: what choose_blender does for an official Blender, which is a module of Python.
choose_module() {
    local folder in_root=()
    if [[ $(own_python) == "$abi" ]]; then
        : # no other system is needed
    elif [[ $suite != - ]]; then
        make_root "$suite" || return 1
        can_enter_roots || { say "SKIPPED: this system lets nobody mount, which Blender $1 needs"; return 1; }
        in_root=(bash "$here/.ci/in_root.sh" "$roots/$suite")
    else
        say "SKIPPED: the official Blender $1 is a module of Python $abi, which $python is not"
        return 1
    fi
    install_module "$1" || return 1
    blender=("${in_root[@]}" "/usr/bin/python$abi" -s -P "$here/.ci/module_program.py" "$folder")
    blender_version=${exact%.*}
}

# find_windows_python VERSION: sets `windows_python`, the program of a Python for Windows; false, with the reason, where it or wine cannot be had.
find_windows_python() {
    wish "${wine_needs[@]}" || true
    [[ -x /usr/lib/wine/wine64 ]] || { say "SKIPPED: programs for Windows are run by /usr/lib/wine/wine64, which this system does not have"; return 1; }
    windows_python=$("$python" "$here/.ci/platforms.py" "$cache" windows-x64 "$1") ||
        { say "SKIPPED: Python $1 for Windows could not be fetched: $windows_python"; return 1; }
}

# choose_windows NAME: what choose_blender does for an official Blender for Windows, which wine runs. The zip that it takes is that of `./motus package --platforms`.
choose_windows() {
    local folder windows_python
    MOTUS_ZIP=$(ls "$dist"/platforms/motus-*-windows_x64.zip 2>/dev/null) ||
        { say "SKIPPED: Blender $1 takes what \`./motus package --platforms windows-x64\` makes, which has not been run"; return 1; }
    find_windows_python "$abi" || return 1
    install_module "$1" || return 1
    blender=(bash "$here/.ci/in_wine.sh" "$build/wine" "$windows_python" -s -P "$here/.ci/module_program.py" "$folder")
    blender_version=${exact%.*}
}

# choose_blender [NAME]: sets `blender` (the command), `blender_version` and `profile`. False where there is none of it.
choose_blender() {
    local own=${BLENDER:-blender} wanted=${1:-} key kind exact suite abi
    if [[ -n $wanted && " ${MOTUS_WITHOUT:-} " == *" $wanted "* ]]; then
        say "SKIPPED: Blender $wanted, as was said above"
        return 1
    fi
    if [[ -z $wanted ]] || [[ $wanted == "$(command -v "$own" >/dev/null && version_of "$own")" ]]; then
        blender=("$(command -v "$own" || echo "$own")")
        blender_version=$(version_of "$own")
        key=$blender_version-$(cksum <<<"${blender[0]}" | cut -d ' ' -f 1)
    else
        row_of "$wanted" || kind=none
        if [[ $kind == module || $kind == windows ]]; then
            "choose_$kind" "$wanted" || return 1
        elif [[ $kind == none || $suite == - ]]; then
            say "SKIPPED: this machine has no Blender $wanted"
            return 1
        else
            make_root "$suite" || return 1
            can_enter_roots || { say "SKIPPED: this system lets nobody mount, which Blender $wanted needs"; return 1; }
            blender=(bash "$here/.ci/in_root.sh" "$roots/$suite" blender)
            blender_version=$wanted
        fi
        key=$wanted
    fi
    profile=${MOTUS_PROFILE:-$build/profiles/$key}
}

# wish_blender: installs this system's own Blender; false where it has none, or nobody may install it.
wish_blender() { installs_itself && wish "${blender_needs[@]}"; }

# choose_official: what choose_blender does, for the newest official Blender that this system's Python can load.
choose_official() {
    local name
    for name in $("$python" "$here/.ci/blenders.py" | tac | awk -v abi="$(own_python)" '$2 == "module" && $5 == abi { print $1 }'); do
        say "there is no Blender on the PATH, so the official Blender $name is used"
        choose_blender "$name" && return
    done
    fail "there is no Blender here that Motus could run, not even an official one for Python $(own_python); install one with: $(install_line blender)"
}

# drawing_blender: the default Blender, for what it renders; without the libraries that it draws with EEVEE ends the process.
drawing_blender() {
    wish "${drawing_needs[@]}" || true
    default_blender
}
