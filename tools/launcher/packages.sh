# shellcheck shell=bash
# What the bench needs from Debian, and how it gets there. Sourced by ./towbench; expects $root.

# To build and run the bench.
run_packages=(
  g++ cmake ninja-build ccache git ca-certificates
  libboost-dev libfmt-dev libtomlplusplus-dev libcli11-dev nlohmann-json3-dev libexpected-dev libgpiod-dev
  libunicorn-dev
)
# What the experiments that estimate need besides: `identify`, `diagnose` and their like.
study_packages=(libeigen3-dev libceres-dev)
# To build BBMC as a bare-metal image for the virtual board.
baremetal_packages=(gcc-arm-none-eabi libnewlib-arm-none-eabi libstdc++-arm-none-eabi-newlib)
# To build and test the bench in every way that CI does.
test_packages=(
  "${baremetal_packages[@]}"
  libgtest-dev libgmock-dev libbenchmark-dev libsundials-dev libode-dev
  clang clang-format clang-tidy libclang-rt-14-dev shellcheck chromium python3 debootstrap
  qemu-system-x86 can-utils socat cpio make
  g++-arm-linux-gnueabihf qemu-user-static valgrind
)

package_is_missing() { ! dpkg-query -W -f='${Status}' "$1" 2>/dev/null | grep -q 'ok installed'; }

# Node comes from Debian unless the machine already has one of its own.
add_node_if_missing() {
  command -v node >/dev/null || missing+=(nodejs)
  command -v npm >/dev/null || missing+=(npm)
}

# install_packages run|study|test [PACKAGE...]: says what it installs, asks for root only when it has to.
install_packages() {
  local wanted=("${run_packages[@]}") missing=() package
  [[ $1 == run ]] || wanted+=("${study_packages[@]}")
  [[ $1 == test ]] && wanted+=("${test_packages[@]}")
  wanted+=("${@:2}")
  if ! command -v dpkg-query >/dev/null; then
    echo "towbench: this is no Debian; it is on you to provide: ${wanted[*]} nodejs npm" >&2
    return
  fi
  for package in "${wanted[@]}"; do
    if package_is_missing "$package"; then missing+=("$package"); fi
  done
  add_node_if_missing
  ((${#missing[@]})) || return 0

  local as_root=()
  if ((EUID != 0)); then
    if ! command -v sudo >/dev/null; then
      echo "towbench: not root and no sudo; please install: ${missing[*]}" >&2
      exit 3
    fi
    as_root=(sudo)
  fi
  echo "towbench: installing Debian packages: ${missing[*]}" >&2
  local log
  log=$(mktemp)
  if ! { "${as_root[@]}" apt-get update &&
    "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
      apt-get install -y --no-install-recommends "${missing[@]}"; } >"$log" 2>&1 </dev/null; then
    tail -n 20 "$log" >&2
    echo "towbench: installing failed; the whole log: $log" >&2
    exit 3
  fi
  rm -f "$log"
}
