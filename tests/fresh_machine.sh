#!/usr/bin/env bash
# Runs README's two commands where nothing is installed: in a bare Debian (debootstrap), on a copy of the last commit.
# Too slow for ctest, and for root only. What it makes is gone when it ends, however it ends.
set -euo pipefail

usage() {
    cat <<'USAGE'
usage: tests/fresh_machine.sh bookworm|trixie [COMMAND...]

COMMAND is what ./run gets, several words quoted as one: 'demo --time 5'. The default is demo, then test.

  MIRROR   where packages come from (default: where this machine's apt has Debian's from, or deb.debian.org)
  TMPDIR   where the system is made; it needs about 5 GB (default: /tmp)
USAGE
}

fail() {
    echo "fresh_machine: $*" >&2
    exit 1
}

own_mirror() {
    apt-get indextargets --format '$(REPO_URI)' 'Created-By: Packages' 'Label: Debian' 2>/dev/null | sort -u | head -n 1
}

# How this machine's apt reaches its mirror.
apt_settings() {
    apt-config dump | grep -E '^Acquire::(https?::|Check-)[^"]* "[^"]+";' || true
}

in_system() {
    chroot "$folder/system" env -i HOME=/root PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin \
        ${http_proxy:+http_proxy="$http_proxy"} ${https_proxy:+https_proxy="$https_proxy"} "$@"
}

count_packages() {
    in_system dpkg-query --show --showformat='${db:Status-Status}\n' | grep -c '^installed$'
}

# Runs a step, named first, and notes its minutes.
measured() {
    local name=$1 status=0
    shift
    echo "fresh_machine: $name" >&2
    { time "$@" 2>&3; } 3>&2 2>"$folder/time" || status=$?
    summary+=$(awk -v name="$name" -v status="$status" '{ printf "  %-20s %5.1f min, %5.1f min of processor time%s", name,
        $1 / 60, ($2 + $3) / 60, status ? ", FAILED with status " status : "" }' "$folder/time")$'\n'
    return "$status"
}
TIMEFORMAT='%R %U %S'
summary=

clean_up() {
    if [[ -n ${inner:-} ]]; then
        kill -KILL "$inner" || true
        sleep 2 # until the last of its processes is gone
    fi
    rm -rf --one-file-system "$folder"
}

# Makes the system in $folder and runs the commands in it.
run_in_bare_system() {
    local release=$1 system=$folder/system mirror=${MIRROR:-$(own_mirror)} commit bare command failed=0
    shift
    commit=$(git -C "$checkout" rev-parse --short HEAD)
    measured "bare $release" debootstrap --variant=minbase "$release" "$system" "${mirror:-http://deb.debian.org/debian}" >&2
    mount -t proc proc "$system/proc"
    mount --rbind /dev "$system/dev"
    mount --rbind /sys "$system/sys"
    cp /etc/hosts /etc/resolv.conf "$system/etc/"
    apt_settings >"$system/etc/apt/apt.conf.d/99fresh-machine"
    mkdir "$system/wend"
    git -C "$checkout" archive "$commit" | tar -x -C "$system/wend"
    bare=$(count_packages)
    for command in "$@"; do
        measured "./run $command" in_system /wend/run $command || failed=1
    done
    echo
    echo "$release, commit $commit, $(nproc) processors, $(($(count_packages) - bare)) packages beside the $bare of the bare system:"
    printf %s "$summary"
    return "$failed"
}

checkout=$(cd "$(dirname "$(readlink -f "$0")")/.." && pwd)
case ${1:-} in
bookworm | trixie)
    [[ $EUID -eq 0 ]] || fail "only root can make a system"
    command -v debootstrap >/dev/null || fail "debootstrap is missing (apt-get install debootstrap)"
    folder=$(mktemp -d -t fresh_machine.XXXXXX)
    trap clean_up EXIT
    trap 'exit 130' INT TERM HUP
    # Namespaces of its own for mounts and processes: both end with the inner script, so the folder holds only files.
    unshare --mount --propagation private --pid --fork --kill-child "$0" inside "$folder" "$@" &
    inner=$!
    status=0
    wait "$inner" || status=$?
    inner=
    exit "$status"
    ;;
inside)
    folder=$2
    shift 2
    [[ $# -gt 1 ]] || set -- "$1" demo test
    run_in_bare_system "$@"
    ;;
*)
    usage >&2
    exit 2
    ;;
esac
