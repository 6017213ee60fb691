#!/usr/bin/env bash
# The texts of the Debian package that are made from others: the man page and the bash completion from
# the programs' own help, copyright and changelog as Debian wants them.
# usage: package_texts.sh ROOT PREFIX VERSION      PREFIX holds lib/towbench
set -euo pipefail
root=${1:?} prefix=${2:?} version=${3:?}
program=$prefix/lib/towbench/towbench-bench
doc=$prefix/share/doc/towbench man=$prefix/share/man/man1 completions=$prefix/share/bash-completion/completions
mkdir -p "$doc" "$man" "$completions"

# Help as it is printed, with what troff would read as its own masked.
as_troff() { sed -e 's/\\/\\e/g' -e 's/-/\\-/g' -e "s/^\([.']\)/\\\\\&\1/"; }

{
  printf '.TH TOWBENCH 1 "" "towbench %s" "User Commands"\n.SH NAME\n' "$version"
  printf 'towbench \\- hardware\\-in\\-the\\-loop bench for embedded motion controllers\n'
  printf '.SH SYNOPSIS\n.B towbench\n.I VERB\n[\\fIOPTIONS\\fR]\n.SH DESCRIPTION\n.nf\n'
  "$program" --help | as_troff
  printf '.fi\n.SH VERBS\n'
  verbs=$("$program" completion | sed -nE "s/^    ([a-z-]+)\) words=.*/\1/p")
  for verb in $verbs; do
    [[ $verb == test ]] && continue
    printf '.SS %s\n.nf\n' "$verb"
    "$program" "$verb" --help | as_troff
    printf '.fi\n'
  done
} | gzip -9n >"$man/towbench.1.gz"

"$program" completion >"$completions/towbench"

{
  printf 'towbench is under the MIT licence:\n\n'
  cat "$root/LICENSE"
  printf '\nIts programs are linked with Unicorn, which is under the GNU General Public License, version 2:\n'
  printf 'whoever passes them on does so under that licence, /usr/share/common-licenses/GPL-2.\n'
} >"$doc/copyright"
printf 'towbench (%s) stable; urgency=low\n\n  * As built from its sources.\n\n -- towbench maintainers <authors@towbench.example.org>  %s\n' \
  "$version" "$(git -C "$root" log -1 --format=%cD 2>/dev/null || date -R)" | gzip -9n >"$doc/changelog.gz"
chmod 644 "$man/towbench.1.gz" "$completions/towbench" "$doc/copyright" "$doc/changelog.gz"
