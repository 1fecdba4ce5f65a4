#!/bin/sh
# System packages that tests and reports like to have.  `install` fetches them; `offer` does so only as root (or with
# `sudo -n`) on a Debian-like system with something missing, never with DRIVEWRIGHT_APT=0, and goes on when apt fails.
PACKAGES="python3-venv chromium libgl1 libquadmath0 fonts-dejavu-core fonts-wqy-zenhei"

missing() {
    for package in $PACKAGES; do
        dpkg-query -W -f='${Status}' "$package" 2>/dev/null | grep -q "install ok installed" || printf '%s ' "$package"
    done
}

as_root() {
    if [ "$(id -u)" = 0 ]; then "$@"; else sudo -n "$@"; fi
}

install() {
    as_root apt-get update -q && DEBIAN_FRONTEND=noninteractive as_root apt-get install -y -q --no-install-recommends $PACKAGES
}

case "$1" in
    install) install ;;
    offer)
        [ "$DRIVEWRIGHT_APT" = 0 ] && exit 0
        command -v apt-get >/dev/null && command -v dpkg-query >/dev/null || exit 0
        [ -z "$(missing)" ] && exit 0
        [ "$(id -u)" = 0 ] || sudo -n true 2>/dev/null || exit 0
        echo "installing system packages with apt-get (DRIVEWRIGHT_APT=0 forbids it): $(missing)"
        install >/tmp/drivewright-apt.$$ 2>&1 || { echo "apt did not succeed; the tests that need these packages are skipped:"; tail -3 /tmp/drivewright-apt.$$; }
        rm -f /tmp/drivewright-apt.$$
        ;;
    *) echo "usage: system.sh install|offer" >&2; exit 2 ;;
esac
exit 0
