#!/bin/sh
# deps.sh SET...: install the Debian packages of the named sets that are missing, after naming them.
# NO_INSTALL=1 only prints the command. Nothing missing: no output, no network.
set -eu

packages_of() {
  case "$1" in
    build) echo "g++ cmake ninja-build pkg-config libeigen3-dev libfmt-dev libcli11-dev nlohmann-json3-dev zlib1g-dev libcairo2-dev
                 libboost-dev libtomlplusplus-dev libgif-dev libhdf5-dev fonts-dejavu-core" ;;
    python) echo "python3-dev python3-venv python3-pip python3-setuptools python3-wheel pybind11-dev python3-numpy
                  python3-matplotlib python3-pil python3-tk python3-pil.imagetk" ;;
    test) echo "libgtest-dev libfclib-dev python3-pytest python3-pytest-xdist python3-hypothesis python3-h5py
                python3-distributed mypy ffmpeg clang-14 libclang-rt-14-dev clang-format-14 git g++-aarch64-linux-gnu
                qemu-user libopenmpi-dev openmpi-bin" ;;
    mpi) echo "libopenmpi-dev openmpi-bin" ;;
    bench) echo "libbenchmark-dev" ;;
    bench-lcp) echo "libsiconos-numerics-dev libbullet-dev libdart-dev libfclib-dev" ;;
    bench-scenes) echo "libbox2d-dev libchipmunk-dev" ;;
    viewer) echo "emscripten nodejs npm" ;;
    viewer-test) echo "chromium" ;;
    fuzz) echo "clang-14 libclang-rt-14-dev" ;;
    *) echo "deps.sh: unknown set '$1'; sets: build python test mpi bench bench-lcp bench-scenes viewer viewer-test fuzz" >&2; exit 2 ;;
  esac
}

wanted=
for set in "$@"; do wanted="$wanted $(packages_of "$set")"; done

# These may come from elsewhere than Debian's packages.
is_there() { case "$1" in nodejs) command -v node ;; npm) command -v npm ;; chromium) command -v chromium ;; *) false ;; esac >/dev/null; }

missing=
for package in $wanted; do
  if is_there "$package"; then continue; fi
  case "$(dpkg-query -W -f='${Status}' "$package" 2>/dev/null)" in
    *"ok installed") ;;
    *) missing="$missing $package" ;;
  esac
done
[ -n "$missing" ] || exit 0

root=
if [ "$(id -u)" != 0 ]; then root=sudo; fi
command="$root apt-get install -y --no-install-recommends$missing"
if [ -n "${NO_INSTALL:-}" ] || { [ -n "$root" ] && ! command -v sudo >/dev/null; }; then
  echo "missing packages; as root run: apt-get install -y --no-install-recommends$missing" >&2
  exit 2
fi
echo "installing:$missing"
export DEBIAN_FRONTEND=noninteractive
log=$(mktemp)
trap 'rm -f "$log"' EXIT
install() { $command -q -o DPkg::Lock::Timeout=300 -o Acquire::Retries=3 >"$log" 2>&1; }
# An image without package lists, or with old ones, needs one update first.
install || { $root apt-get update -q >/dev/null && install; } || { tail -n 5 "$log" >&2; exit 1; }
