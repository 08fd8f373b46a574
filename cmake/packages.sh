# shellcheck shell=bash
# SPDX-License-Identifier: MIT
# Sourced by tests/run, bench/run and bench/scene: what is missing on this machine, and how it gets there.
#
#   need "what it is" "Debian packages, best first, separated by |; a+b: both" "remedy elsewhere" command...
#       notes the thing as missing unless the command succeeds
#   want ...
#       likewise, for what can be done without
#   provide
#       on Debian and Ubuntu says what it will install, installs it, and looks again; elsewhere, or with
#       install=no, names each missing thing and how to get it. Exits with 3 if something needed stays missing.

install=${install:-yes}
missing=()

say() { printf '%s\n' "$*"; }
die() { # code, message
    local code=$1
    shift
    printf '%s: %s\n' "$program" "$*" >&2
    exit "$code"
}
have() { command -v "$1" >/dev/null 2>&1; }
value_follows() { # an option that needs a value, and all that follows it
    case ${2:-} in "" | --*) die 2 "$1 needs a value; see --help" ;; esac
}
at_least() { [ "$(printf '%s\n%s\n' "$1" "$2" | sort -V | head -n 1)" = "$1" ]; } # wanted, found

note_missing() { # needed or wanted, and what need and want take
    local necessity=$1 what=$2 packages=$3 remedy=$4
    shift 4
    "$@" >/dev/null 2>&1 || missing+=("$what"$'\t'"$packages"$'\t'"$remedy"$'\t'"$necessity")
}
need() { note_missing needed "$@"; }
want() { note_missing wanted "$@"; }

# Tests for need.
cmake_is_new_enough() { have cmake && at_least 3.25 "$(cmake --version | sed -n '1s/[^0-9]*//p')"; }
has_header() { # header, compiler (without it, or if it is not here: the first one there is)
    local compiler=${2:-}
    have "$compiler" || for compiler in c++ g++ clang++; do have "$compiler" && break; done
    printf '#include <%s>\n' "$1" | "$compiler" -std=c++20 -fsyntax-only -x c++ -
}
can_sanitize() { # compiler
    local out
    out=$(mktemp) || return 1
    printf 'int main() {}\n' | "$1" -fsanitize=address,undefined -x c++ - -o "$out" && "$out"
    local result=$?
    rm -f "$out"
    return $result
}
compiles_cxx20() { # compiler
    printf '#include <concepts>\n#include <span>\nint main() {}\n' | "$1" -std=c++20 -fsyntax-only -x c++ -
}

compiler_package() { # compiler -> its Debian package
    case ${1##*/} in
    clang++*) printf 'clang%s' "${1##*clang++}" ;;
    *) printf '%s' "${1##*/}" ;;
    esac
}
comes_in_a_package() { # compiler: by its name alone, since the lists of apt may still be empty
    [[ $1 =~ ^(g|clang)\+\+(-[0-9]+)?$ ]]
}
check_compiler() { # one that the user has named: is here, or may be installed
    have "$1" || comes_in_a_package "$1" || die 2 "no such compiler: $1"
}
on_debian() { have apt-get && [ -r /etc/debian_version ]; }
first_available() { # a|b+c|d -> the first that apt knows, b c if it is the second; nothing if it knows none
    local packages
    for packages in ${1//|/ }; do
        # shellcheck disable=SC2086 # several words
        if apt-cache show ${packages//+/ } >/dev/null 2>&1; then
            printf '%s' "${packages//+/ }"
            return
        fi
    done
}

count_missing() { # needed or wanted
    local entry count=0
    for entry in ${missing[@]+"${missing[@]}"}; do
        [ "${entry##*$'\t'}" != "$1" ] || count=$((count + 1))
    done
    printf '%s' "$count"
}
say_missing() {
    local entry what packages remedy necessity
    say "$program: missing on this machine:"
    for entry in "${missing[@]}"; do
        IFS=$'\t' read -r what packages remedy necessity <<<"$entry"
        [ "$necessity" = needed ] || necessity="what uses it is left out without"
        say "  - $what: $remedy (Debian, Ubuntu: $(sed "s/|/ or /g; s/+/ and /g" <<<"$packages"); $necessity)"
    done
}
give_up_if_needed() { # why: exits if something needed is missing; else goes on without the rest
    [ "$(count_missing needed)" = 0 ] || die 3 "$1"
}
install_with_apt() { # packages; nothing that is there is removed for them, even if it is in their way
    "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends --no-remove "$@" \
        </dev/null >/dev/null
}
install_packages() { # needed or wanted
    local entry what packages remedy necessity package chosen=()
    for entry in "${missing[@]}"; do
        IFS=$'\t' read -r what packages remedy necessity <<<"$entry"
        [ "$necessity" = "$1" ] || continue
        # Where apt knows none, what another package brings may do.
        for package in $(first_available "$packages"); do
            case " ${chosen[*]-} " in *" $package "*) ;; *) chosen+=("$package") ;; esac
        done
    done
    [ ${#chosen[@]} -gt 0 ] || return 0
    say "$program: installing with apt-get, which takes some minutes: ${chosen[*]}"
    install_with_apt "${chosen[@]}" && return
    for package in "${chosen[@]}"; do # one that cannot come is not to keep the others away
        install_with_apt "$package" || say "$program: apt-get could not install $package, without removing others"
    done
}

provide() { # the function that calls need and want for everything
    local list_needs=$1 as_root=()
    missing=()
    "$list_needs"
    [ ${#missing[@]} -gt 0 ] || return 0
    say_missing
    local hint="install the above and start again"
    if [ "$install" != yes ]; then
        give_up_if_needed "nothing installed, as asked; $hint"
        return 0
    fi
    if ! on_debian; then
        give_up_if_needed "this system has no apt; $hint"
        return 0
    fi
    if [ "$(id -u)" -ne 0 ]; then
        if ! have sudo; then
            give_up_if_needed "not root, and there is no sudo; $hint"
            return 0
        fi
        as_root=(sudo)
    fi
    "${as_root[@]}" apt-get update -qq || say "$program: apt-get update failed; trying with the lists that are there"
    install_packages needed
    install_packages wanted
    hash -r
    missing=()
    "$list_needs"
    [ ${#missing[@]} -gt 0 ] || return 0
    say_missing
    give_up_if_needed "still missing after the installation"
}
