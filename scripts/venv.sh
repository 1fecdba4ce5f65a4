#!/bin/sh
# venv.sh PYTHON VENV core|test|docs: make the virtual environment and install the package with that extra.
# The stamp VENV/<extra>.ready is written last, so an interrupted install starts again.
set -e
PYTHON="$1"; VENV="$2"; EXTRA="$3"
usable() { "$PYTHON" -c 'import sys, ensurepip; assert sys.version_info >= (3, 11)' 2>/dev/null; }

if ! usable; then
    if [ "$(id -u)" = 0 ] && command -v apt-get >/dev/null && [ "$DRIVEWRIGHT_APT" != 0 ]; then
        echo "installing the system package python3-venv with apt-get (DRIVEWRIGHT_APT=0 forbids it)"
        { apt-get update -q && DEBIAN_FRONTEND=noninteractive apt-get install -y -q --no-install-recommends python3-venv; } >/dev/null 2>&1 || true
    fi
    usable || { echo "needs Python 3.11+ with venv: apt-get install python3-venv, or make PYTHON=..." >&2; exit 1; }
fi

if [ -f "$VENV/made" ] && [ pyproject.toml -nt "$VENV/made" ]; then
    rm -rf "$VENV"
fi
if [ ! -x "$VENV/bin/python" ] || [ ! -f "$VENV/made" ]; then
    rm -rf "$VENV"
    "$PYTHON" -m venv "$VENV"
    touch "$VENV/made"
fi

pip() { "$VENV/bin/python" -m pip --disable-pip-version-check "$@"; }
echo "installing into $VENV ($EXTRA) ..."
if [ "$EXTRA" = core ]; then
    pip install -q -e .
    touch "$VENV/core.ready"
    exit 0
fi

# Each extra by itself: one that does not install costs its own tests, not the run.
pip install -q -e .
touch "$VENV/core.ready"
for extra in $("$VENV/bin/python" scripts/extras.py "$EXTRA"); do
    if ! pip install -q -e ".[$extra]"; then
        [ "$extra" = dev ] || [ "$extra" = docs ] && { echo "the extra '$extra' did not install" >&2; exit 1; }
        echo "the extra '$extra' did not install; its tests are skipped (try: $VENV/bin/pip install -e '.[$extra]')"
    fi
done
touch "$VENV/$EXTRA.ready"
