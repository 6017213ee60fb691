#!/bin/sh
# install.sh WORK_FOLDER: copies this folder's scripts there and installs their npm packages.
set -eu
here=$(dirname "$0")
mkdir -p "$1"
cp -R "$here"/*.mjs "$here/package.json" "$here/package-lock.json" "$here/diagnosis" "$1"
cd "$1"
exec npm ci --prefer-offline --ignore-scripts --no-audit --no-fund --loglevel=error --silent
