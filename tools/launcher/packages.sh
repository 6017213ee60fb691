# shellcheck shell=bash disable=SC2034
# What the bench needs from Debian, and how it gets there. Sourced; expects $root and progress.sh.

# To build and run the bench.
run_packages=(
  g++ cmake ninja-build ccache git ca-certificates
  libboost-dev libfmt-dev libtomlplusplus-dev libcli11-dev nlohmann-json3-dev libexpected-dev libgpiod-dev
  libunicorn-dev libssl-dev libnlopt-cxx-dev libpugixml-dev libzip-dev
)
# What the experiments that estimate need besides: `identify`, `diagnose` and their like.
study_packages=(libeigen3-dev libceres-dev libmatio-dev liblz4-dev libzstd-dev)
# To build BBMC as a bare-metal image for the virtual board.
baremetal_packages=(gcc-arm-none-eabi libnewlib-arm-none-eabi libstdc++-arm-none-eabi-newlib)
# To build and test the bench in every way that guards main.
test_packages=(
  "${run_packages[@]}" "${study_packages[@]}" "${baremetal_packages[@]}"
  libgtest-dev libgmock-dev libbenchmark-dev libsundials-dev libode-dev
  clang clang-format clang-tidy lld libclang-rt-14-dev shellcheck chromium python3 debootstrap
  qemu-system-x86 can-utils socat cpio make
  g++-arm-linux-gnueabihf qemu-user-static valgrind
)

# Of the stage `linuxcnc` alone.
linuxcnc_packages=(linuxcnc-uspace linuxcnc-uspace-dev)

# Those of the named packages that are not installed. Node may come from elsewhere than Debian.
missing_packages() {
  local wanted=("$@")
  command -v node >/dev/null || wanted+=(nodejs)
  command -v npm >/dev/null || wanted+=(npm)
  comm -23 <(printf '%s\n' "${wanted[@]}" | sort -u) \
    <(dpkg-query -W -f='${db:Status-Status} ${Package}\n' "${wanted[@]}" 2>/dev/null | sed -n 's/^installed //p' | sort -u)
}

# install_packages PACKAGE...: in one call; says what it installs, asks for root only when it has to.
install_packages() {
  if ! command -v dpkg-query >/dev/null; then
    echo "towbench: this is no Debian; it is on you to provide: $* nodejs npm" >&2
    return
  fi
  local missing=() as_root=() log
  mapfile -t missing < <(missing_packages "$@")
  ((${#missing[@]})) || return 0
  if ((EUID != 0)); then
    if ! command -v sudo >/dev/null; then
      echo "towbench: not root and no sudo; please install: ${missing[*]}" >&2
      exit 3
    fi
    as_root=(sudo)
  fi
  echo "towbench: installing Debian packages: ${missing[*]}" >&2
  # The password is asked for here, not below a progress line.
  ((EUID == 0)) || sudo -v || exit 3
  log=$(mktemp)
  if ! watched 'installing packages' package_steps "$log" apt_install "${missing[@]}"; then
    grep -E '^(E|Err)' "$log" >&2 || tail -n 20 "$log" >&2
    echo "towbench: installing failed; the whole log: $log" >&2
    exit 3
  fi
  rm -f "$log"
}

apt_install() {
  "${as_root[@]}" apt-get update &&
    "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends "$@"
}
