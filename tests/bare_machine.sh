#!/usr/bin/env bash
# The two commands of the README on a machine with nothing but a shell: a minimal Debian made with debootstrap, where a
# reader who may use sudo has a fresh clone, in a folder whose name has a space and an umlaut. Not part of continuous
# integration: it takes most of an hour. As root:
#   tests/bare_machine.sh [bookworm|trixie] [FOLDER]    FOLDER: where the system goes (4 GB; kept for a look, removed by
#                                                       the next run)
# BARE_MIRROR says where Debian comes from; BARE_COMMANDS which commands, separated by semicolons.
set -euo pipefail
((EUID == 0)) || { echo 'bare_machine.sh: run it as root: debootstrap and chroot need it' >&2 && exit 3; }
command -v debootstrap >/dev/null || { echo 'bare_machine.sh: install debootstrap' >&2 && exit 3; }
book=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
suite=${1:-bookworm}
place=${2:-/var/tmp/bare_machine_$suite}
mirror=${BARE_MIRROR:-http://deb.debian.org/debian}
commands=${BARE_COMMANDS:-./book run --quick 1;./book test}
[[ $suite == bookworm || $suite == trixie ]] || { echo "bare_machine.sh: $suite is none of bookworm, trixie" >&2 && exit 2; }

unmount() {
    local mount
    for mount in dev/pts dev/shm dev proc sys; do
        ! mountpoint -q "$place/$mount" || umount "$place/$mount"
    done
}
trap unmount EXIT
unmount
[[ ! -e $place ]] || rm -rf --one-file-system "$place"

echo "A minimal $suite in $place"
debootstrap --variant=minbase --include=sudo "$suite" "$place" "$mirror" >"$place.log" 2>&1 ||
    { tail -n 20 "$place.log" && exit 1; }
mount -t proc proc "$place/proc"
mount -t sysfs sys "$place/sys"
mount --bind /dev "$place/dev"
mount -t devpts devpts "$place/dev/pts"
mount -t tmpfs shm "$place/dev/shm"
cp /etc/resolv.conf "$place/etc/resolv.conf"
echo '127.0.0.1 localhost' >"$place/etc/hosts"  # as Debian's installer writes it; chromedriver is spoken to by name
for file in /etc/apt/apt.conf.d/*proxy*; do  # a machine that reaches its mirror through a proxy
    [[ ! -e $file ]] || cp "$file" "$place/etc/apt/apt.conf.d/"
done
# Daemons of the packages stay off.
printf '#!/bin/sh\nexit 101\n' >"$place/usr/sbin/policy-rc.d"
chmod +x "$place/usr/sbin/policy-rc.d"
chroot "$place" useradd --create-home --shell /bin/bash reader
echo 'reader ALL=(ALL) NOPASSWD: ALL' >"$place/etc/sudoers.d/reader"
git clone --quiet --no-hardlinks "$book" "$place/home/reader/bücher im regal"
chroot "$place" chown -R reader:reader /home/reader

IFS=';' read -ra each <<<"$commands"
failures=0
for command in "${each[@]}"; do
    name=$(tr -cs 'a-z0-9\n' '_' <<<"$command")
    echo "$command"
    started=$SECONDS result=0
    # A login as on a fresh system: none of this machine's environment.
    chroot "$place" su - reader -c "cd 'bücher im regal' && $command" >"$place.$name.log" 2>&1 </dev/null || result=$?
    printf '  ended with %d after %d min %d s; its output: %s\n' "$result" $(((SECONDS - started) / 60)) \
        $(((SECONDS - started) % 60)) "$place.$name.log"
    tail -n 5 "$place.$name.log"
    ((result == 0)) || failures=1
done
exit $failures
