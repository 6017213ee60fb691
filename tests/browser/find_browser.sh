#!/bin/sh
# Prints the path of a Chromium. Exit: 0 found, 1 none, 99 none and TOWBENCH_ALLOW_NO_BROWSER=1.
for candidate in "${CHROMIUM:-}" /usr/bin/chromium /usr/bin/chromium-browser; do
  if [ -n "$candidate" ] && [ -x "$candidate" ]; then
    echo "$candidate"
    exit 0
  fi
done
echo "no Chromium found (Debian package: chromium; or set CHROMIUM to its path)" >&2
[ "${TOWBENCH_ALLOW_NO_BROWSER:-0}" = 1 ] && exit 99
exit 1
