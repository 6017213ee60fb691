#!/bin/sh
# run.sh WORK_FOLDER SCREENSHOT_FOLDER COMMAND [ARGUMENT...]
#
# Runs the command, takes the last line that it prints as the path of a report in its run folder (the
# bench's own convention), and judges that report in headless Chromium. WORK_FOLDER holds the npm
# packages (install.sh). Exit: 0 good, 1 not, 99 no browser and TOWBENCH_ALLOW_NO_BROWSER=1.
set -eu

work=$1
shots=$2
shift 2

browser=$(sh "$(dirname "$0")/find_browser.sh") || exit $?
export CHROMIUM="$browser"

report=$("$@" | tail -n 1)
if [ ! -f "$report" ]; then
  echo "'$*' did not print the path of a report: '$report'" >&2
  exit 1
fi
exec node "$work/report.test.mjs" "$report" "$(dirname "$report")" "$shots"
