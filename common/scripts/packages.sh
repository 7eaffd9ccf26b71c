# shellcheck shell=bash
# Packages: which are missing, installing them, and what `./book doctor` prints. Sourced by ./book.

# Prints the lines of packages.txt that belong to the named parts, without comments.
package_lines() {
    local package part rest wanted
    while read -r package part rest; do
        [[ $package == \#* || -z $package ]] && continue
        for wanted; do
            [[ ,$part, == *,$wanted,* ]] || continue
            printf '%s %s %s\n' "$package" "$part" "$rest"
            break
        done
    done <"$root/common/scripts/packages.txt"
    return 0
}

# Is one of the comma-separated commands, <headers> or files there?
is_there() {
    local probe folder
    local -a probes
    IFS=, read -ra probes <<<"$1"
    for probe in "${probes[@]}"; do
        case $probe in
            /*) [[ -e $probe ]] && return 0 ;;
            \<*)
                for folder in /usr/include /usr/local/include "/usr/include/$(uname -m)-linux-gnu" ${BOOK_INCLUDE:+"$BOOK_INCLUDE"}; do
                    [[ -e $folder/${probe:1:-1} ]] && return 0
                done
                ;;
            *) command -v "$probe" >/dev/null && return 0 ;;
        esac
    done
    return 1
}

# Prints the packages of the named parts that are not there.
missing_packages() {
    local package probe
    while read -r package _ probe _; do
        is_there "$probe" || printf '%s\n' "$package"
    done < <(package_lines "$@")
}

# apt-get with its progress: a line that counts up on a terminal, a plain line now and then elsewhere.
apt() {
    local -a as_root=()
    local percent what line shown=-1
    ((EUID == 0)) || as_root=(sudo)
    "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -q -y -o DPkg::Lock::Timeout=300 \
        -o APT::Status-Fd=1 "$@" 2>&1 </dev/null | while IFS= read -r line; do
        case $line in
            dlstatus:*) what=downloading ;;
            pmstatus:*) what=installing ;;
            *) printf '%s\n' "$line" >>"$log/apt.txt" && continue ;;
        esac
        percent=$(cut -d: -f3 <<<"$line")
        percent=${percent%%.*}
        [[ $percent =~ ^[0-9]+$ ]] || continue
        if $is_terminal; then
            printf '\r      %s %3d %% ' "$what" "$percent" >&2
        elif ((percent / 25 != shown)); then
            shown=$((percent / 25))
            printf '      %s %d %%\n' "$what" "$percent" >&2
        fi
    done
    local result=$?
    ! $is_terminal || printf '\r\033[K' >&2
    return $result
}

# set_up PART...: installs what is missing of these parts. Without a required package nothing can go on; without an
# optional one, something is left out, which CMake tells.
set_up() {
    local -a missing
    local package
    mapfile -t missing < <(missing_packages "$@")
    step "Packages: ${missing[*]:-all there}${missing[*]:+ missing}"
    if ((${#missing[@]} > 0)) && $install; then
        if ! command -v apt-get >/dev/null; then
            say "      there is no apt-get here: please install these in this system's way"
        elif ((EUID != 0)) && ! command -v sudo >/dev/null; then
            say "      not root, and there is no sudo; as root: apt-get install ${missing[*]}"
        else
            say "      apt-get install (as root; its output: $log/apt.txt)"
            apt update || say "      apt-get update failed; trying with the lists that are there"
            # One that cannot be had must not keep the others out.
            if ! apt install --no-install-recommends "${missing[@]}"; then
                for package in "${missing[@]}"; do
                    apt install --no-install-recommends "$package" || say "      $package cannot be installed"
                done
            fi
            hash -r
        fi
        mapfile -t missing < <(missing_packages build)
    fi
    mapfile -t missing < <(missing_packages build | grep -vx ccache)
    ((${#missing[@]} == 0)) ||
        die 3 "these packages are required and not there: ${missing[*]} (Debian: apt-get install ${missing[*]})"
}

# Prints what is there, in which version; fails where something required is missing.
doctor() {
    local package part probe purpose version
    local -i wrong=0
    printf 'system    %s, %s, %s cores, %s of memory\n' \
        "$(sed -n 's/^PRETTY_NAME="\(.*\)"/\1/p' /etc/os-release 2>/dev/null || uname -s)" \
        "$(uname -m)" "$(nproc)" "$(awk '/^MemTotal/ {printf "%.0f GiB", $2 / 1048576}' /proc/meminfo 2>/dev/null)"
    printf 'book      %s\n' "$(git -C "$root" log -1 --format='%h of %cs' 2>/dev/null || echo 'no git history here')"
    for preset in release debug asan tsan; do
        [[ -f $root/build/$preset/build.ninja ]] && printf 'built     %s\n' "build/$preset"
    done
    printf '\n%-20s %-10s %-28s %s\n' package part version 'what for'
    while read -r package part probe purpose; do
        version=$(dpkg-query -W -f '${Version}' "$package" 2>/dev/null || true)
        if ! is_there "$probe"; then
            version=MISSING
            [[ $part == build && $package != ccache ]] && wrong=1
        fi
        printf '%-20s %-10s %-28s %s\n' "$package" "$part" "${version:-there, not from a package}" "$purpose"
    done < <(package_lines build run print test bench lab extra)
    echo
    echo 'build: required; the others: what needs them is left out where they are missing.'
    ((wrong == 0)) || die 3 "something required is missing: ./book run installs it"
}
