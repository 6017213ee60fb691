# shellcheck shell=bash disable=SC2154
# `./towbench package`: a .deb. Sourced by ./towbench.

# shellcheck source=tools/launcher/progress.sh
source "$root/tools/launcher/progress.sh"

run_package() {
  local out=$PWD
  case "${1:-}" in
    '') ;;
    --out) out=${2:?--out DIR} ;;
    *)
      [[ $1 == -h || $1 == --help ]] || { echo "towbench: unknown argument '$1' to package (allowed: --out --help)" >&2; exit 2; }
      printf 'usage: ./towbench package [--out DIR]\n\nBuilds towbench_VERSION_ARCHITECTURE.deb into DIR (here, where none is named).\nExample: ./towbench package --out dist && sudo apt install ./dist/towbench_*.deb\n'
      return
      ;;
  esac
  install_packages "${run_packages[@]}" "${study_packages[@]}" dpkg-dev file
  mkdir -p "$out"
  build_preset package towbench-bench towbench-panel towbench-study
  rm -rf "$build/package/deb"
  if ! (cd "$build/package" && umask 022 && watched 'packing' build_steps "$build/package.log" cpack -G DEB -B "$build/package/deb"); then
    tail -n 20 "$build/package.log" >&2
    exit 3
  fi
  cp "$build/package/deb/"*.deb "$out/"
  (cd "$out" && printf '%s\n' "$PWD/$(basename "$build/package/deb/"*.deb)")
}
