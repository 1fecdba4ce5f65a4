#!/bin/sh
# machines.sh [ROW ...] [-- PYTEST ARGUMENT ...]: the suite as other machines would run it; without names, every row.
# A row is one processor, number of BLAS threads, Python, or set of versions of the dependencies. Prints the rows of the table in
# docs/reliability.md; what a row printed is kept in out/machines/ROW.log. A row that cannot be set up here says why.
cd "$(dirname "$0")/.." || exit 2
JOBS="${JOBS:-2}"
WHERE=out/machines
ROWS="native generic x86-64-v3 nehalem haswell zen skylakex no-simd blas-8 python-3.11 python-3.12 python-3.13 python-3.14 lowest newest"

# The instructions that NumPy chooses at run time, and that this processor has.
DISPATCHED="from numpy._core import _multiarray_umath as core
print(','.join(name for name in core.__cpu_dispatch__ if core.__cpu_features__.get(name)))"

# What a row sets in the environment, as words NAME=VALUE.
settings() {
    case "$1" in
        generic | x86-64-v3) echo "NUMBA_CPU_NAME=$1 NUMBA_CPU_FEATURES=" ;;
        nehalem) echo "OPENBLAS_CORETYPE=Nehalem" ;;
        haswell) echo "OPENBLAS_CORETYPE=Haswell" ;;
        zen) echo "OPENBLAS_CORETYPE=Zen" ;;
        skylakex) echo "OPENBLAS_CORETYPE=SkylakeX" ;;
        no-simd) echo "NPY_DISABLE_CPU_FEATURES=$(.venv/bin/python -c "$DISPATCHED")" ;;
        blas-8) echo "OPENBLAS_NUM_THREADS=8 OMP_NUM_THREADS=8" ;;
    esac
}

# The first Python of a version that runs: one on the path, or one of pyenv.
interpreter() {
    for python in "python$1" "$HOME/.pyenv/versions/$1".*/bin/python; do
        "$python" -c 'import venv' 2>/dev/null && echo "$python" && return
    done
    return 1
}

# Where a row has its packages, and beside it its compiled kernels: another NumPy or numba cannot use those of .venv.
folder_of() { echo "$PWD/$WHERE/$1.venv"; }

# The environment of a row, made where there is none; prints its Python, or says on the error stream why there is none.
environment() {
    case "$1" in
        python-*) version="${1#python-}" resolution=highest ;;
        lowest) version=3.11 resolution=lowest-direct ;;
        newest) version=3.11 resolution=highest ;;
        *) echo .venv/bin/python && return ;;
    esac
    folder=$(folder_of "$1")
    if [ ! -f "$folder/ready" ]; then
        python=$(interpreter "$version") || { echo "no Python $version here" >&2; return 1; }
        rm -rf "$folder"
        "$python" -m venv "$folder" && "$folder/bin/python" -m pip -q --disable-pip-version-check install uv &&
            "$folder/bin/uv" pip install -q --python "$folder/bin/python" --resolution "$resolution" -e ".[test]" || return 1
        touch "$folder/ready"
    fi
    echo "$folder/bin/python"
}

row() {
    name="$1" log="$WHERE/$1.log" settings=$(settings "$1")
    shift
    if ! python=$(environment "$name" 2>"$log"); then
        echo "| \`$name\` | not run | $(grep -v '^ *$' "$log" | head -1 | cut -c1-160) |"
        return 1
    fi
    cache="${XDG_CACHE_HOME:-$HOME/.cache}"
    case "$python" in /*) cache="$(folder_of "$name")/cache" ;; esac
    set -- "$python" -m pytest -n "$JOBS" -p no:cacheprovider "$@"
    env XDG_CACHE_HOME="$cache" OPENBLAS_NUM_THREADS=1 OMP_NUM_THREADS=1 MPLBACKEND=Agg $settings "$@" >"$log" 2>&1
    code=$?
    echo "| \`$name\` | $(sed -n 's/^=* \(.*\(passed\|failed\|error\).*\) in .* =*$/\1/p' "$log" | tail -1) | $settings |"
    return $code
}

names=
while [ $# -gt 0 ] && [ "$1" != -- ]; do
    case " $ROWS " in
        *" $1 "*) names="$names $1" ;;
        *) echo "machines.sh: no row '$1'; there are: $ROWS" >&2; exit 2 ;;
    esac
    shift
done
[ "$1" = -- ] && shift
[ $# -gt 0 ] || set -- -m "not slow"

[ -f .venv/test.ready ] || { echo "machines.sh: run 'make test' first; the rows use its .venv" >&2; exit 2; }
mkdir -p "$WHERE"
echo "| machine | outcome | settings |"
echo "|---|---|---|"
failed=0
for name in ${names:-$ROWS}; do
    row "$name" "$@" || failed=1
done
exit $failed
