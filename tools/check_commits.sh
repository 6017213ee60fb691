#!/bin/sh
# Subjects of the commits since BASE: at most 72 characters, no full stop at the end, and a body below an empty line.
# usage: check_commits.sh ROOT BASE
set -eu
cd "${1:?usage: check_commits.sh ROOT BASE}"
base=${2:?usage: check_commits.sh ROOT BASE}
if ! git cat-file -e "$base^{commit}" 2>/dev/null; then
  echo "commits: skipped, $base is not in this clone"
  exit 0
fi
status=0
count=0
for commit in $(git rev-list --no-merges "$base..HEAD"); do
  count=$((count + 1))
  subject=$(git show -s --format=%s "$commit")
  short=$(git rev-parse --short "$commit")
  if [ "${#subject}" -gt 72 ]; then
    echo "$short: subject of ${#subject} characters, at most 72: $subject" >&2
    status=1
  fi
  case $subject in
    *.) echo "$short: subject ends in a full stop: $subject" >&2 && status=1 ;;
  esac
  if [ -z "$(git show -s --format=%b "$commit")" ]; then
    echo "$short: no body that says why: $subject" >&2
    status=1
  fi
done
echo "commits: $count since $base"
exit $status
