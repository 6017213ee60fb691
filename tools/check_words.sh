#!/bin/sh
# Refuses the retired words of docs/glossary.md in tracked files of the given kinds.
# usage: check_words.sh ROOT [EXTENSION...]      md when none is given; for code: cc h ts sh toml
set -eu
cd "${1:?usage: check_words.sh ROOT [EXTENSION...]}"
shift
[ $# -gt 0 ] || set -- md
glossary=docs/glossary.md

# shellcheck disable=SC2016  # the backticks are Markdown
list=$(sed -n '/^```retired$/,/^```$/{/^```/d;p;}' "$glossary")
if [ -z "$list" ]; then
  echo "$glossary lists no retired word" >&2
  exit 1
fi
listed=$(git ls-files 2>/dev/null || true)
[ -n "$listed" ] || listed=$(find . -type f | sed 's|^\./||')

status=0
for extension in "$@"; do
  files=$(printf '%s\n' "$listed" | grep "\.$extension\$" | grep -vxF "$glossary" || true)
  if [ -z "$files" ]; then
    echo "no file ends in .$extension" >&2
    status=1
    continue
  fi
  echo "words: $(printf '%s\n' "$files" | wc -l) files .$extension"
  printf '%s\n' "$files" | RETIRED=$list perl -e '
    my @rules = map { my ($word, $say) = split / => /; [qr/\b(?:$word)\b|\b(?:$word)(?=\s)/i, $say] } split /\n/, $ENV{RETIRED};
    # One expression for all first: most lines have none.
    my $any = join "|", map { (split / => /)[0] } split /\n/, $ENV{RETIRED};
    $any = qr/\b(?:$any)/i;
    my $found = 0;
    while (my $file = <STDIN>) {
      chomp $file;
      open(my $in, "<", $file) or next;  # listed by git and not yet committed as deleted
      my $fenced = 0;
      while (my $line = <$in>) {
        next if $line =~ /kept word:/;  # a value that other data depends on
        my $text = $line;
        if ($file =~ /\.md$/) {
          if ($text =~ /^\s*```/) { $fenced = !$fenced; next; }
          next if $fenced || $text =~ /^    \S/;
          $text =~ s/`[^`]*`//g;
          $text =~ s/\]\([^)]*\)/]/g;
        }
        $text =~ s/([a-z])([A-Z])/$1 $2/g;
        $text =~ s/_/ /g;
        next unless $text =~ $any;
        for my $rule (@rules) {
          next unless $text =~ $rule->[0];
          print STDERR "$file:$.: \"$&\": say $rule->[1]\n";
          $found = 1;
        }
      }
    }
    exit $found;' || status=1
done
exit $status
