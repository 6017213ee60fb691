#!/usr/bin/env bash
# A folder is configured once in a call, and never by what builds beside a stage that has configured it: CMake would
# write the lists of tests again while they are read.
# usage: configured_once_test.sh ROOT
set -euo pipefail
source_root=${1:?usage: configured_once_test.sh ROOT}
scratch=$(mktemp -d)
mkdir "$scratch/bin"
cat >"$scratch/bin/cmake" <<'SCRIPT'
#!/bin/sh
echo "$*" >>"$CALLS"
SCRIPT
chmod +x "$scratch/bin/cmake"
export PATH=$scratch/bin:$PATH CALLS=$scratch/calls
root=$source_root
# shellcheck source=tools/launcher/build.sh
source "$source_root/tools/launcher/build.sh"
# shellcheck source=tools/launcher/test.sh
source "$source_root/tools/launcher/test.sh"
# shellcheck source=tools/launcher/progress.sh
source "$source_root/tools/launcher/progress.sh"
trap 'rm -rf "$scratch"' EXIT
root=$scratch build=$scratch/build built_s=0

wrong() { echo "configured_once: $1"; cat "$CALLS"; exit 1; }
calls() { grep -c -- "$1" "$CALLS" || true; }

built sanitize test_core
[[ $(calls '--preset sanitize') == 1 ]] || wrong 'was not configured'
start_build_beside sanitize fuzz_targets
built sanitize fuzz_targets
[[ $(calls '--preset sanitize') == 1 ]] || wrong 'configured again beside a stage'
[[ $(calls '--target fuzz_targets') == 2 ]] || wrong 'was not built'
built tsan test_core
[[ $(calls '--preset tsan') == 1 ]] || wrong 'another folder was not configured'
build_preset release && build_preset user && build_preset release
[[ $(calls '--preset release') == 2 && $(calls '--preset user') == 1 ]] || wrong 'another preset of the same folder was not configured'
echo 'each folder is configured once'
