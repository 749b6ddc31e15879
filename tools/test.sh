#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Sets everything up and passes the tests: what the README and continuous integration call.
#   tools/test.sh           g++, format, layers, unit, data and command-line tests
#   tools/test.sh --full    also clang 16, clang-tidy, address + undefined-behaviour and thread sanitizers, lone headers,
#                           the slow tests
set -euo pipefail
cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/.."
exec </dev/null
export CTEST_OUTPUT_ON_FAILURE=1
unset DISPLAY WAYLAND_DISPLAY  # nothing here may need a display

full=false
for argument in "$@"; do
  case "$argument" in
    --full) full=true ;;
    -h | --help) sed -n '3,6s/^# \{0,1\}//p' "${BASH_SOURCE[0]}"; exit 0 ;;
    *) echo "test.sh: unknown argument '$argument' (there is --full)" >&2; exit 2 ;;
  esac
done

jobs=$(nproc)
report=()   # one line a part, printed again at the end
verdicts=() # what ctest said

part() {
  local name=$1 start=$SECONDS
  shift
  echo "=== $name"
  if ! "$@"; then
    echo "=== FAILED: $name ($((SECONDS - start)) s)" >&2
    exit 1
  fi
  report+=("$(printf '%5d s  %s' $((SECONDS - start)) "$name")")
  echo "=== $name: $((SECONDS - start)) s"
}

tracked() {
  # Git refuses a checkout that another user owns, as under sudo, unless told that this one is meant. A source archive
  # has no git.
  git -c safe.directory="$PWD" ls-files --cached --others --exclude-standard -- "$@" 2>/dev/null ||
    find src tests fuzz bench \( -name '*.cpp' -o -name '*.h' \)
}

check_format() {
  local files
  mapfile -t files < <(tracked '*.cpp' '*.h' | grep -v '^tests/layers/fixtures/')
  clang-format-16 --dry-run -Werror "${files[@]}"
}

build() {
  local preset=$1
  shift
  cmake --preset "$preset" >"build/$preset.configure.log" 2>&1 || { cat "build/$preset.configure.log"; return 1; }
  cmake --build --preset "$preset" -j "$jobs" "$@"
}

run_ctest() {
  local preset=$1 log status=0
  shift
  log=$(mktemp)
  ctest --test-dir "build/$preset" -j "$jobs" --no-tests=error "$@" | tee "$log" || status=1
  verdicts+=("$preset: $(grep -E '[0-9]+% tests passed' "$log" || echo 'no verdict')")
  rm -f "$log"
  return $status
}

tidy() {
  tracked 'src/*.cpp' 'fuzz/*.cpp' | while read -r file; do
    # Only what the clang build compiles has flags to be read with.
    if grep -q "/$file\"" build/clang/compile_commands.json; then echo "$file"; fi
  done | xargs -P "$jobs" -n 4 clang-tidy-16 -p build/clang --quiet --warnings-as-errors='*'
}

threaded_tests() {
  build tsan && run_ctest tsan -L unit -R '[Tt]hread|Work|[Pp]arallel|[Jj]obs'
}

mkdir -p build
if $full; then part "packages" tools/setup.sh full; else part "packages" tools/setup.sh test; fi
part "format" check_format
part "layers" tools/check_layers
part "build with g++" build dev
if $full; then
  part "tests, the slow ones too" run_ctest dev
  part "every header alone" tools/check_headers build/dev
  part "build with clang 16" build clang
  part "tests of the clang build" run_ctest clang -LE slow
  part "clang-tidy" tidy
  part "build with address and undefined-behaviour sanitizers" build asan
  part "tests with address and undefined-behaviour sanitizers" run_ctest asan -LE slow
  part "threaded tests with the thread sanitizer" threaded_tests
else
  part "tests" run_ctest dev -LE slow
fi

echo
printf '%s\n' "${report[@]}"
printf '%5d s  in all\n' "$SECONDS"
printf '%s\n' "${verdicts[@]}"
