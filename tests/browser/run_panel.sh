#!/bin/sh
# run_panel.sh WORK_FOLDER BENCH ROOT RUNS_FOLDER SCREENSHOT_FOLDER
#
# Drives the panel in headless Chromium. Exit: 0 good, 1 not, 99 no browser and
# TOWBENCH_ALLOW_NO_BROWSER=1.
set -eu
work=$1
shift
browser=$(sh "$(dirname "$0")/find_browser.sh") || exit $?
export CHROMIUM="$browser"
exec node "$work/panel.test.mjs" "$@"
