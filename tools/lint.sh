#!/usr/bin/env bash
# Format, shell scripts, include rules, rings of folders, pages, checks of requirements, planted slips, words of the tank, retired words, commit subjects and machine paths of the whole tree.
# usage: lint.sh ROOT      TOWBENCH_LINT_BASE: commits after this one are checked
set -uo pipefail
root=${1:?usage: lint.sh ROOT}
cd "$root" || exit 1
status=0

mapfile -t sources < <(git ls-files '*.cc' '*.h')
mapfile -t scripts < <(git ls-files '*.sh' towbench .ci/run)

echo "clang-format: ${#sources[@]} files"
# Not as a pipe into grep: its status is that of the first that fails, and a finding would pass.
if ! findings=$(printf '%s\0' "${sources[@]}" | xargs -0 -P "$(nproc)" -n 200 clang-format --dry-run -Werror 2>&1); then
  grep -E 'error' <<<"$findings" | head -n 20
  status=1
fi

echo "shellcheck: ${#scripts[@]} scripts"
printf '%s\0' "${scripts[@]}" | xargs -0 -P "$(nproc)" -n 8 shellcheck -x || status=1

sh tools/check_includes.sh . || status=1
sh tools/check_folder_cycles.sh . || status=1
sh tools/check_pages.sh . || status=1
sh tools/check_requirements.sh . || status=1
bash tools/check_slips.sh . || status=1
bash tools/check_axis_words.sh . || status=1
sh tools/check_words.sh . md cc h ts toml sh py || status=1
sh tools/check_commits.sh . "${TOWBENCH_LINT_BASE:-795b709}" || status=1

# An absolute path of somebody's machine in a tracked file is a mistake, always.
if git grep -nIE '(^|[^A-Za-z0-9_.])/(work|home|root)/' -- . ":!*.lock" ":!tools/lint.sh"; then
  echo "machine paths in tracked files"
  status=1
fi

# Tests of one binary run in several processes at once.
shared=$(git grep -nE 'temp_directory_path\(\) / "' -- tests | grep -v XXXXXX || true)
if [ -n "$shared" ]; then
  echo "$shared"
  echo "a temporary file that two processes share; use TemporaryFixtures"
  status=1
fi

exit "$status"
