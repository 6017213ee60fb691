#!/bin/sh
# A README that is too long, a cell that holds a paragraph, a dead link, a recipe's file that is not there, a library
# that README.md does not name and a long commit subject must be found.
# shellcheck disable=SC2016  # the backticks are Markdown
set -u
root=${1:?usage: planted_pages_test.sh ROOT}
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
failures=0
lines() { seq "$1" | sed 's/.*/text/'; }
long() { head -c "$1" /dev/zero | tr '\0' 'x'; }

fresh() {
  rm -rf "$scratch/tree"
  mkdir -p "$scratch/tree/folder" "$scratch/tree/docs/guide"
  lines 90 >"$scratch/tree/README.md"
  lines 40 >"$scratch/tree/folder/README.md"
  printf 'see [that](../there.md), `docs/guide/page.md`\n| a | %s |\n' "$(long 300)" >"$scratch/tree/docs/guide/page.md"
  : >"$scratch/tree/docs/there.md"
}
expect() { # expect VERDICT WHAT
  if sh "$root/tools/check_pages.sh" "$scratch/tree" >"$scratch/said" 2>&1; then got=pass; else got=fail; fi
  [ "$got" = "$1" ] && return
  echo "$2: expected $1, got $got: $(cat "$scratch/said")"
  failures=$((failures + 1))
}

fresh && expect pass "pages as they should be"
fresh && lines 91 >"$scratch/tree/README.md" && expect fail "README of 91 lines"
fresh && lines 41 >"$scratch/tree/folder/README.md" && expect fail "a folder's README of 41 lines"
fresh && printf '| a | %s |\n' "$(long 330)" >"$scratch/tree/docs/there.md" && expect fail "a paragraph in a cell"
fresh && printf '[gone](gone.md)\n' >"$scratch/tree/docs/there.md" && expect fail "a dead link"
fresh && printf 'see docs/guide/gone.md\n' >"$scratch/tree/docs/there.md" && expect fail "a page that is not there"

recipe() { fresh && printf '1. `%s`\n' "$1" >"$scratch/tree/CONTRIBUTING.md"; }
recipe 'docs/{there,guide/page}.md' && expect pass "a recipe of files that are there"
recipe 'docs/NAME_view.ts' && expect pass "a recipe of a file to be written"
recipe 'docs/{there,gone}.md' && expect fail "a recipe of a file that is not there"
recipe 'folder/*.cc' && expect fail "a recipe of files of which there is none"
library() { # library TABLE: README.md has Asio, and the page of dependencies TABLE
  fresh && mkdir "$scratch/tree/docs/reference" && printf '%s\n' "$1" >"$scratch/tree/docs/reference/dependencies.md" &&
    printf '## Dependencies\n| library | version |\n| --- | --- |\n| Boost: Asio | 1.74 |\n## Reading\n' >"$scratch/tree/README.md"
}
library '| Boost.Asio | 1.74 | why |' && expect pass "a library that README.md names"
library '| zlib | 1.2 | why |' && expect fail "a library that README.md does not name"

commit() { # commit TEXT: on top of a fresh base; true when the check passes
  rm -rf "$scratch/tree" && mkdir "$scratch/tree" && cd "$scratch/tree" || exit 1
  git init -q . && git config user.email test@example.org && git config user.name test && git config commit.gpgsign false
  git commit -q --allow-empty -m base && base=$(git rev-parse HEAD)
  git commit -q --allow-empty -m "$1"
  sh "$root/tools/check_commits.sh" "$scratch/tree" "$base" >"$scratch/said" 2>&1
}
verdict() { # verdict VERDICT WHAT TEXT
  if commit "$3"; then got=pass; else got=fail; fi
  [ "$got" = "$1" ] && return
  echo "$2: expected $1, got $got: $(cat "$scratch/said")"
  failures=$((failures + 1))
}
body=$(printf '\n\nWhy.')
verdict pass "a subject of 72 characters" "$(long 72)$body"
verdict fail "a subject of 73 characters" "$(long 73)$body"
verdict fail "a commit without a body" "Subject"
verdict fail "a subject with a full stop" "Subject.$body"

[ "$failures" -eq 0 ] && echo "every planted mistake was found"
exit "$failures"
