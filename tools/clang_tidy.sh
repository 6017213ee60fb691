#!/usr/bin/env bash
# clang-tidy over every source, two at a time; a file is analysed again only when what it is made
# from has changed (the preprocessed text, the checks and the tool are the key).
# usage: clang_tidy.sh ROOT [--everything]
# Without --everything: the code that moves the machine or models it. The harness and the carriers
# include libraries whose headers cost half a minute of analysis per file.
set -uo pipefail
root=$(cd "${1:?usage: clang_tidy.sh ROOT [--everything]}" && pwd)
cd "$root" || exit 1
build=build/tidy
cache=${XDG_CACHE_HOME:-$HOME/.cache}/towbench-tidy
mkdir -p build "$cache"
cmake -S . -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_COMPILER=clang++ \
  -DCMAKE_CXX_COMPILER_LAUNCHER= -DTOWBENCH_REPORT_ASSETS=OFF -DTOWBENCH_BENCHMARKS=OFF -DTOWBENCH_UNITY=OFF >build/tidy.log 2>&1 ||
  { tail -n 20 build/tidy.log; exit 1; }

tidy_one() {
  local build=$1 cache=$2 file=$3 key command
  command=$(python3 - "$build" "$file" <<'PY'
import json, os, sys
for entry in json.load(open(os.path.join(sys.argv[1], "compile_commands.json"))):
    if os.path.relpath(entry["file"]) == sys.argv[2]:
        print(entry["command"].split(" -o ")[0])
        break
PY
  )
  [[ -n $command ]] || exit 0
  key=$({ cat .clang-tidy; clang-tidy --version; (cd "$build" && eval "$command -E -P $PWD/../../$file" 2>/dev/null); } | sha256sum | cut -d' ' -f1)
  [[ -e $cache/$key ]] && exit 0
  if clang-tidy -p "$build" --quiet "$file" 2>/dev/null >"$cache/$key.out"; then
    touch "$cache/$key"
    rm -f "$cache/$key.out"
  else
    cat "$cache/$key.out"
    rm -f "$cache/$key.out"
    exit 1
  fi
}
export -f tidy_one

# Product code only: in tests, GoogleTest's macros make most of the noise.
folders=('core/*.cc' 'protocol/*.cc' 'emulator/*.cc' 'bbmc/*.cc' ':!protocol/carriers/*')
[[ ${2:-} == --everything ]] && folders=('core/*.cc' 'protocol/*.cc' 'emulator/*.cc' 'bbmc/*.cc' 'harness/*.cc' 'study/*.cc')
mapfile -t files < <(git ls-files "${folders[@]}")
echo "clang-tidy: ${#files[@]} files"
printf '%s\n' "${files[@]}" | xargs -P 2 -I{} bash -c 'tidy_one "$@"' _ "$build" "$cache" {}
