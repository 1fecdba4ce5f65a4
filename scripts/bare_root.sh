#!/bin/sh
# bare_root.sh WHEEL [ROOT [SUITE]]: install a wheel into a Debian root that has nothing but Python, and run an example of every kind there.
# Says the seconds of each first run, and fails where one compiles.  Wants root, debootstrap and the network.
set -e
WHEEL="$1"; ROOT="${2:-$(mktemp -d)}"; SUITE="${3:-bookworm}"
[ -x "$ROOT/usr/bin/python3" ] || debootstrap --variant=minbase --include=python3-venv,ca-certificates "$SUITE" "$ROOT" >"$ROOT.log" 2>&1 ||
    { tail -3 "$ROOT.log" >&2; exit 1; }
cp /etc/resolv.conf "$ROOT/etc/" 2>/dev/null || true
cp -r /etc/ssl/certs "$ROOT/etc/ssl/" 2>/dev/null || true
cp "$WHEEL" "$ROOT/tmp/"
inside() { chroot "$ROOT" env HOME=/root LC_ALL=C.UTF-8 "$@"; }
inside python3 -m venv /root/venv
inside /root/venv/bin/pip install -q "/tmp/$(basename "$WHEEL")"
inside rm -rf /root/.cache/drivewright
status=0
for name in disc_cam pressure_roller_shaft pin_indexer seedling_pusher four_bar hyvo_chain slider_crank_clearance; do
    inside sh -c "mkdir -p /tmp/copies && cd /tmp/copies && rm -f $name.toml && /root/venv/bin/drivewright examples $name" 2>/dev/null
    began=$(date +%s.%N)
    inside /root/venv/bin/drivewright run "/tmp/copies/$name.toml" --no-figures --out "/tmp/out/$name" >"$ROOT/tmp/said" 2>&1 || { cat "$ROOT/tmp/said"; status=1; }
    echo "$name: $(echo "$(date +%s.%N) - $began" | bc) s"
    if grep -q compiling "$ROOT/tmp/said"; then grep compiling "$ROOT/tmp/said"; status=1; fi
done
[ -z "$(inside find /root/.cache/drivewright -name '*.kernel')" ] || { echo "kernels were compiled:"; inside find /root/.cache/drivewright -name '*.kernel'; status=1; }
exit $status
