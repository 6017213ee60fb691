#!/bin/sh
# Compiles the HAL component: build.sh FOLDER gives FOLDER/towbench.so. Needs linuxcnc-uspace-dev.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
mkdir -p "${1:?usage: build.sh FOLDER}"
cd "$1"
halcompile --compile "$here/towbench.comp"
