#!/bin/sh
# Rules on the text of the files: which part may use which, that every file says what it is for,
# names of tests, length of lines. Needs no R and no compiler. Prints a line for each rule, then
# `boundary: N passed, N failed`.

cd "$(dirname "$0")/.." || exit 1

# Files of the glue without one of the core to call: they serve the others, or R alone.
exempt="src/glue/ffi.c src/glue/run.c src/glue/form.c"

work=$(mktemp -d "${TMPDIR:-/tmp}/rotdyn-boundary.XXXXXX") || exit 1
trap 'rm -rf "$work"' 0
trap 'exit 1' HUP INT TERM

# rule NAME: reads the offences from standard input, a line each. It runs at the end of a pipe, in a
# shell of its own, so the verdicts go to a file.
rule() {
  where=$(cat)
  if test -z "$where"; then
    echo "ok - $1"
    echo passed >> "$work/verdicts"
  else
    echo "not ok - $1:"
    printf '%s\n' "$where" | sed 's/^/    /'
    echo failed >> "$work/verdicts"
  fi
}

# Every file of the project: those that git tracks or would add, or all files outside a clone.
if git rev-parse --is-inside-work-tree > /dev/null 2>&1; then
  git ls-files --cached --others --exclude-standard
else
  find . -type f ! -path '*/.git/*' ! -name '*.o' ! -name '*.so' ! -path ./src/Makevars |
    sed 's|^\./||'
fi | sort -u | while read -r file; do test -f "$file" && echo "$file"; done > "$work/files"

files() { grep -E "$1" "$work/files"; }

# code FILE...: the C code as `file:line:text`, without comments and strings (but with the names in
# #include "..."), so that a comment may mention R.
code() {
  test $# -gt 0 || return 0
  awk '
    FNR == 1 { open = 0 }
    {
      rest = $0
      text = ""
      keep = rest ~ /^[ \t]*#[ \t]*include/
      while (rest != "") {
        if (open) {
          end = index(rest, "*/")
          if (!end) break
          rest = substr(rest, end + 2)
          open = 0
        }
        if (!match(rest, /"([^"\\]|\\.)*"|\047([^\047\\]|\\.)+\047|\/\/|\/\*/)) {
          text = text rest
          break
        }
        token = substr(rest, RSTART, RLENGTH)
        text = text substr(rest, 1, RSTART - 1)
        rest = substr(rest, RSTART + RLENGTH)
        if (token == "//") break
        if (token == "/*") { open = 1; text = text " " } else text = text (keep ? token : "\"\"")
      }
      print FILENAME ":" FNR ":" text
    }' "$@"
}

# R code without its comments (a # inside a string ends the line, too).
r_code() { test $# -gt 0 && sed 's/#.*//' "$@"; }

# A whole word, for grep -E.
word() { echo "(^|[^A-Za-z0-9_.])($1)([^A-Za-z0-9_]|\$)"; }

# The shell splits these lists at blanks: no file has one in its name.
# shellcheck disable=SC2046
{
  code $(files '^src/core/.*\.[ch]$') > "$work/core"
  code $(files '^src/(glue/.*\.[ch]|init\.c)$') > "$work/glue"
  code $(files '^src/glue/entries\.h$') > "$work/entries"
  r_code $(files '^R/.*\.R$') > "$work/r"
  r_code $(files '^(R|tests)/.*\.R$') > "$work/r_and_tests"
}

# ---- the C core knows nothing of R -----------------------------------------------------------

include='#[[:space:]]*include[[:space:]]*[<"]'
r_headers='R|Rinternals|Rmath|Rdefines|Rversion|Rconfig|Rembedded|Rinterface|S|R_ext/.*'
grep -E "$include($r_headers)(\.h)?[>\"]" "$work/core" |
  rule "src/core includes no R header"
grep -E "$(word 'SEXP|Rprintf|REprintf|Rvprintf|(R|Rf)_[A-Za-z0-9_]+|[A-Z]+SXP')" "$work/core" |
  rule "src/core uses nothing of R's"
grep -E "${include}glue" "$work/core" | rule "src/core includes no header of the glue"
prints='v?f?printf|putchar|putc|fputs?c?|puts|perror'
ends='exit|_exit|_Exit|quick_exit|abort|assert'
grep -E "$(word "($prints|$ends|rand|srand)[[:space:]]*\\(.*")" "$work/core" |
  rule "src/core does not print, end the process or draw from C's random numbers"

grep -E "gsl_set_error_handler" "$work/core" | grep -v '^src/core/ground/gsl\.c:' |
  rule "GSL's error handler is set in src/core/ground/gsl.c alone"

# ---- the glue knows nothing of GSL -----------------------------------------------------------

grep -E "(^|[^A-Za-z0-9_])gsl_|[<\"]gsl/" "$work/glue" |
  rule "src/glue and src/init.c use nothing of GSL's"

# Entry points of R that "Writing R Extensions" (4.5, "API index") lists: R hides the others one by
# one. Of the accessors in capitals, those that it does not list are named.
api='R_(CallMethodDef|CheckStack|CheckUserInterrupt|ContinueUnwind|DimNamesSymbol|FINITE|GlobalEnv)
R_RegisterCCallable
R_(MakeUnwindCont|NaN|NO_REMAP|NamesSymbol|NilValue|PosInf|PreserveObject|ReleaseObject)
R_(ClassSymbol|DimSymbol|UnwindProtect)
Rf_(Scalar(Integer|Logical|Real|String)|alloc(Matrix|Vector)|as(Integer|Logical|Real)|duplicate)
Rf_(error|eval|getAttrib|inherits|install|is(Function|Matrix|Null|Object)|lang[234]|length)
Rf_(mk(Char|CharLenCE|Named|String)|ncols|nrows|setAttrib|translateCharUTF8|xlength)'
hidden='ATTRIB|BODY|CLOENV|DATAPTR|ENCLOS|ENVFLAGS|EXTPTR_(PROT|PTR|TAG)|FORMALS|FRAME|HASHTAB'
hidden="$hidden|IS_S4_OBJECT|LEVELS|NAMED|OBJECT|PR(CODE|ENV|VALUE)|STDVEC_DATAPTR|STRING_PTR"
hidden="$hidden|SETLENGTH|SETLEVELS|SET_(ATTRIB|BODY|CLOENV|ENCLOS|ENVFLAGS|FORMALS|FRAME)"
hidden="$hidden|SET_(HASHTAB|NAMED|OBJECT|S4_OBJECT|TRUELENGTH|TYPEOF)|TRUELENGTH|VECTOR_PTR"
{
  grep -oE '^[^:]*:[0-9]*|(^|[^A-Za-z0-9_])(R_[A-Z][A-Za-z_]*|Rf_[A-Za-z0-9]+)' "$work/glue" |
    sed 's/^[^A-Za-z]//' | awk '/:/ { at = $0; next } { print at ": " $0 }' |
    grep -vxE "[^ ]* ($(echo "$api" | paste -sd'|' -))"
  grep -E "(^|[^A-Za-z0-9_.])($hidden)[[:space:]]*\\(" "$work/glue"
} | rule "the glue uses entry points of R's documented API alone"

# ---- the layers of the core ------------------------------------------------------------------

# LEVEL FOLDER of src/core: its files include headers of its own folder and of folders of a lower
# level. Folders of one level exclude each other. A constraint that is not listed is at level 5.
layers='
1 ground
2 maths
3 design
3 engine
3 summary
4 engine/ode
4 body
5 tables
5 measure
6 scene/drive
6 scene/pivot
7 scene
8 object
9 sweep
9 text
10 fit
11 api
'
# INCLUDER:LINE UNIT INCLUDED: a unit is x.c with x.h.
at='src/core/\([a-z0-9_/]*\)\.[ch]:[0-9]*'
sed -n "s|^\\($at\\):.*# *include *\"\\([a-z0-9_/]*\\)\\.h\".*|\\1 \\2 \\3|p" "$work/core" \
  > "$work/includes"
echo "$layers" | awk '
  function folder(unit) { sub(/\/[^\/]*$/, "", unit); return unit }
  FILENAME == "-" { if (NF) level[$2] = $1; next }
  function known(at) { if (!(at in level) && at ~ /^scene\/[a-z]+$/) level[at] = 5 }
  { from = folder($2); to = folder($3); known(from); known(to) }
  !(from in level) || !(to in level) { print $1 ": no layer names it, or " $3 ".h"; next }
  level[to] > level[from] || (level[to] == level[from] && to != from) {
    print $1 ": " from " includes " $3 ".h"
  }' - "$work/includes" |
  rule "files of src/core include headers of their folder and of lower layers"
awk '$2 != $3 { print $2, $3 }' "$work/includes" | sort -u | tsort 2>&1 > "$work/sorted" |
  sed 's/^tsort: //' | rule "units of src/core (x.c with x.h) include each other in no circle"

# ---- scenes ----------------------------------------------------------------------------------

files '^R/.*\.R$' |
  grep -vE '^R/(constraints|(table-)?constraint[a-z-]*|(table-)?scene[a-z-]*)\.R$' |
  tr '\n' '\0' | xargs -0 grep -nE 'rot_scene_' /dev/null | grep -vE '^[^:]*:[0-9]*: *#' |
  rule "R/ names a class of scenes only in its own files and in the list of constraints"

# ---- files of one topic ----------------------------------------------------------------------

files '^src/core/.*\.c$' | while read -r file; do
  test -f "${file%.c}.h" || echo "$file"
done | rule "every x.c of src/core has its x.h"
# Files whose includes lead to ground/ieee.h, directly or through others, grow until none is added.
sed -n 's|^src/\([a-z0-9_/]*\.[ch]\):.*# *include *"\([a-z0-9_/]*\.h\)".*|\1 \2|p' \
  "$work/core" "$work/glue" | awk '
  { from[NR] = $1; to[NR] = ($2 ~ /^glue\// ? "" : "core/") $2 }
  END {
    seen["core/ground/ieee.h"] = 1
    do {
      more = 0
      for (i = 1; i <= NR; i++) if ((to[i] in seen) && !(from[i] in seen)) more = seen[from[i]] = 1
    } while (more)
    for (file in seen) print "src/" file
  }' | sort > "$work/guarded"
files '^src/.*\.c$' | comm -23 - "$work/guarded" |
  rule "every C file of src/ sees ground/ieee.h, which refuses fast mathematics"
grep -l '\\verb{r ' man/*.Rd | rule "the help has no code left that was to be evaluated"
for file in configure src/Makevars.win tools/library.sh; do
  grep -q -- '-ffp-contract=off' $file || echo "$file"
done | rule "every build switches contraction of a * b + c off"
# glue/X.c calls X.h, or, of a scene, Y/X.h as glue/Y_X.c.
files '^src/core/.*\.h$' | sed 's|.*/\([a-z]*\)/\([a-z0-9_]*\)\.h$|\2\n\1_\2|' > "$work/topics"
files '^src/glue/.*\.c$' | while read -r file; do
  case " $exempt " in *" $file "*) continue ;; esac
  topic=${file#src/glue/}
  grep -qx "${topic%.c}" "$work/topics" || echo "$file"
done | rule "every file of src/glue has one of src/core that it calls"
sed '/^#/d; s/ @GSL_CFLAGS@//; s/@FP_CONTRACT@/-ffp-contract=off/
  s/@GSL_LIBS@/-lgsl -lgslcblas -lm/' src/Makevars.in > "$work/makevars"
sed '/^#/d' src/Makevars.win | diff "$work/makevars" - |
  rule "src/Makevars.win is src/Makevars.in with the GSL of Rtools"
version=$(sed -n 's/^Version: //p' DESCRIPTION)
{
  head -n 1 packaging/debian/changelog | grep -v "^rotdyn ($version-[0-9]*) "
  grep '^#define ROTDYN_VERSION' inst/include/rotdyn.h | grep -v "\"$version\""
} | rule "packaging and the C interface have the version of DESCRIPTION"
sh tools/objects.sh | diff src/Makevars.objects - |
  rule "src/Makevars.objects lists the files of src/ (make objects)"

# of_topics PROGRAM: awk on the lines of tests/topics.txt, with the files of the project in `there`
# and core_test(): the file of a test of src/core by its path. One process, not some for each file.
topics=tests/topics.txt
of_topics() {
  awk -v topics=$topics '
    function core_test(path) {
      match(path, /[^\/]*$/)
      return "tests/core/" substr(path, 1, RSTART - 1) "test_" substr(path, RSTART) ".c"
    }
    FNR == NR { there[$0] = 1; next }
    /^#/ || !NF { next }
    '"$1" "$work/files" $topics
}

# A file of the exact name, or a line of tests/topics.txt.
# shellcheck disable=SC2016
of_topics '
    { first[$1] = $2 }
    END {
      for (file in there) {
        stem = file
        if (file ~ /^src\/core\/.*\.c$/) {
          gsub(/^src\/core\/|\.c$/, "", stem)
          if (core_test(stem) in there || first[file] ~ /^[a-z+]/) continue
        } else if (file ~ /^R\/.*\.R$/) {
          sub(/^R\//, "", stem)
          if (("tests/testthat/test-" stem) in there || first[file] ~ /^[a-z]/) continue
        } else if (file !~ /^src\/glue\/.*\.c$/ || first[file] ~ /^[a-z]/) {
          continue
        }
        print file
      }
    }' | sort | rule "every file of src/core, of src/glue and of R/ has a file of tests"
# shellcheck disable=SC2016
of_topics '
    {
      if (!($1 in there)) print topics ": there is no " $1
      core = $1 ~ /^src\/core\//
      for (i = 2; i <= NF; i++) {
        if ($i == "+") { core = 0; continue }
        test = core ? core_test($i) : "tests/testthat/test-" $i ".R"
        if (!(test in there)) print topics ": " $1 ": there is no " test
      }
    }' | rule "tests/topics.txt names files that exist"

# ---- registration ----------------------------------------------------------------------------

sed -n 's/^[^:]*:[0-9]*://; s/.*[^A-Za-z0-9_]*X(\(ffi_[A-Za-z0-9_]*\)[ ,].*/\1/p' "$work/entries" |
  sort > "$work/registered"
grep -oE 'ffi_[A-Za-z0-9_]+' "$work/r" | sort -u > "$work/called"
grep -oE 'ffi_[A-Za-z0-9_]+' "$work/r_and_tests" | sort -u > "$work/mentioned"
uniq -d "$work/registered" | rule "every entry of src/glue/entries.h is listed once"
sort -u "$work/registered" | comm -13 - "$work/called" |
  rule "every ffi_ name in R/ is in src/glue/entries.h"
sort -u "$work/registered" | comm -23 - "$work/mentioned" |
  rule "every entry of src/glue/entries.h is called in R/ or tests/"
{ test -s "$work/registered" || test ! -s "$work/glue" || echo "no X(ffi_..., n) found"; } |
  rule "src/glue/entries.h lists entries"

# Of two R functions of one name R silently takes the one in the last file of the alphabet.
files '^R/.*\.R$' | tr '\n' '\0' | xargs -0 grep -hoE '^[A-Za-z._][A-Za-z._0-9]* <- function' |
  sort | uniq -d | rule "no two functions in R/ have one name"

# ---- what each file is for -------------------------------------------------------------------

sh tools/map.sh | grep ': *$' | rule "every file of R/ and src/ begins with a comment"

# ---- text that no file may contain -----------------------------------------------------------

# The patterns are written so that they do not match themselves.
search() { tr '\n' '\0' < "$work/files" | xargs -0 grep -InE "$1" /dev/null | cut -c 1-160; }
search '(^|[^A-Za-z0-9_.~-])/(w[o]rk|r[o]ot|h[o]me)/' | rule "no path of one machine"
search '(^|[^A-Za-z])(TO[D]O|FI[X]ME)([^A-Za-z]|$)' | rule "no work left marked in the files"
search '(cr[a]n|cl[o]ud)\.r-project\.org|deb\.d[e]bian\.org|registry\.n[p]mjs' |
  rule "no package registry's host name"

search '^(<{7}|>{7}) ' | rule "no conflict left in the files"

# Code: R, C, shell. Tables may be wider: rows of test data, rows of tables and inline code in help.
code_files='\.([Rch]|sh|in|win)$|^(configure|cleanup|\.ci/run)$'
files "$code_files" | tr '\n' '\0' | LC_ALL=C.UTF-8 xargs -0 grep -nE '.{101}' /dev/null |
  grep -vE '^(tests/core/[^:]*:[0-9]*: *\{|R/[^:]*:[0-9]*:#. *[|`])' | cut -c 1-160 |
  rule "lines of code have at most 100 columns"
files "$code_files" | tr '\n' '\0' | xargs -0 grep -nE "$(printf '\t')|[[:space:]]\$" /dev/null |
  rule "code has no tab and no blank at the end of a line"

passed=$(grep -c passed "$work/verdicts")
failed=$(grep -c failed "$work/verdicts")
echo "boundary: $passed passed, $failed failed"
test $failed = 0
