#!/bin/sh
# Length and form of the pages: README.md at most 90 lines, a folder's README at most 40, no table cell that holds a
# paragraph, no link, no named page and no file of a recipe that is not there, each library of dependencies.md in
# README's table.
# usage: check_pages.sh ROOT
set -eu
cd "${1:?usage: check_pages.sh ROOT}"
status=0
complain() {
  echo "$1" >&2
  status=1
}

pages=$(git ls-files '*.md' 2>/dev/null || true)
[ -n "$pages" ] || pages=$(find . -name '*.md' | sed 's|^\./||')
[ -n "$pages" ] || complain "no page at all"
echo "pages: $(printf '%s\n' "$pages" | wc -l)"

for page in $pages; do
  [ -f "$page" ] || continue
  lines=$(wc -l <"$page")
  case $page in
    README.md) limit=90 ;;
    */README.md) limit=40 ;;
    docs/reference/verbs.md | docs/measurements/*) limit=1000 ;; # written by programs
    *) limit=400 ;;
  esac
  [ "$lines" -le "$limit" ] || complain "$page: $lines lines, at most $limit"

  awk -v page="$page" -v most=320 '
    /^```/ { fenced = !fenced }
    !fenced && /^\|/ {
      cells = split($0, cell, "|")
      for (i = 1; i <= cells; ++i) {
        if (length(cell[i]) > most) { printf "%s:%d: a cell of %d characters, at most %d\n", page, FNR, length(cell[i]), most; bad = 1 }
      }
    }
    END { exit bad }' "$page" >&2 || status=1

  folder=$(dirname "$page")
  # shellcheck disable=SC2013,SC2016  # the backticks are Markdown; a link holds no space
  for link in $(sed 's/`[^`]*`//g' "$page" | grep -oE '\]\([^)#: ]+' | cut -c3-); do
    case $link in http*) continue ;; esac
    [ -e "$folder/$link" ] || complain "$page: links to $link, which is not there"
  done
done

# Pages of docs/ that any file names: a page, a comment, a help text.
for named in $( (git grep -IhoE 'docs/[a-z0-9/-]+\.md' -- ':!tests/architecture' 2>/dev/null ||
  grep -rhoE 'docs/[a-z0-9/-]+\.md' .) | sort -u); do
  [ -e "$named" ] || complain "$named is named and not there: $(git grep -Il "$named" 2>/dev/null | head -n 3 | tr '\n' ' ')"
done

# Files that CONTRIBUTING.md names; one in capitals (NAME) is yet to be written.
if [ -f CONTRIBUTING.md ]; then
  # shellcheck disable=SC2016  # the backticks are Markdown
  gone=$(perl -lne 'while (/`([\w.\/{},*-]+\/[\w.\/{},*-]*)`/g) {
    next if $1 =~ /[A-Z]{4}/;
    my @files = glob $1;
    print for @files ? grep { !-e } @files : $1;
  }' CONTRIBUTING.md)
  [ -z "$gone" ] || complain "CONTRIBUTING.md names what is not there: $(echo "$gone" | tr '\n' ' ')"
fi

# A library by the last part of its name: Boost.Asio is Asio in README.md's table.
libraries=docs/reference/dependencies.md
if [ -f "$libraries" ]; then
  named=$(sed -n '/^## Dependencies/,/^## [^D]/s/^| \([^|]*\)|.*/\1/p' README.md | tr -cs 'A-Za-z0-9+:-' '\n')
  # shellcheck disable=SC2013  # spaces have become _
  for library in $(sed -nE 's/^\| ([^|(]*[^|( ]) *(\([^)]*\) )?\| [0-9].*/\1/p' "$libraries" | sed 's/, /\n/g; s/ /_/g'); do
    for word in $(echo "${library##*.}" | tr '_' ' '); do
      echo "$named" | grep -qxF "$word" || complain "README.md: its table of dependencies has no $word"
    done
  done
fi
exit $status
