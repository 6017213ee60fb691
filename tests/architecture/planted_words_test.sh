#!/bin/sh
# A retired word must be found in a page and in code, as a word and inside a name; a quoted one in a page must not.
# shellcheck disable=SC2016  # the backticks are Markdown
set -u
root=${1:?usage: planted_words_test.sh ROOT}
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
failures=0
mkdir -p "$scratch/docs"
printf '# Glossary\n```retired\nwidgets? => component\nold (way|path) => new way\n```\n' >"$scratch/docs/glossary.md"

expect() { # expect VERDICT FILE TEXT: does a tree with this one file pass or fail?
  printf '%b\n' "$3" >"$scratch/$2"
  if sh "$root/tools/check_words.sh" "$scratch" "${2##*.}" >"$scratch/said" 2>&1; then got=pass; else got=fail; fi
  if [ "$got" != "$1" ]; then
    echo "$2 with [$3]: expected $1, got $got: $(cat "$scratch/said")"
    failures=$((failures + 1))
  elif [ "$1" = fail ] && ! grep -q "^$2:[0-9]*: .*: say " "$scratch/said"; then
    echo "$2 with [$3]: refused without file, line and what to say: $(cat "$scratch/said")"
    failures=$((failures + 1))
  fi
  rm "$scratch/$2"
}

expect fail page.md 'a Widget of ours'
expect fail page.md 'one\ntwo\nthe old way'
expect pass page.md 'midget and widgetry are other words'
expect pass page.md 'what `widget.h` holds\n```\nwidget\n```'
expect fail page.md '```\ncode\n```\nand widgets below it'
expect fail code.cc 'int widget_count = 0;'
expect fail code.cc 'int theWidgetCount = 0;'
expect fail code.h '// the old path of it'
expect pass code.h 'int component_count = 0;'
expect pass code.cc 'const char* seed = "widget";  // kept word: another would change the noise'

printf '# Glossary\nno list\n' >"$scratch/docs/glossary.md"
printf 'fine\n' >"$scratch/page.md"
if sh "$root/tools/check_words.sh" "$scratch" md >/dev/null 2>&1; then
  echo "a glossary without a list passed"
  failures=$((failures + 1))
fi

[ "$failures" -eq 0 ] && echo "every planted word was found"
exit "$failures"
