#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Sets everything up and passes the tests: what the README and continuous integration call.
#   tools/test.sh           g++, format, layers, unit, data and command-line tests
#   tools/test.sh --full    also the slow tests, other people's readers (R, QGIS), lone headers, the headless build,
#                           clang 16 with address + undefined-behaviour and thread sanitizers, clang-tidy, some
#                           seconds of each fuzz target, OpenGL on Vulkan, shaders by the standard's own compiler, and the
#                           benchmarks' build where ITK is installed
set -euo pipefail
cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/.."
exec </dev/null
export CTEST_OUTPUT_ON_FAILURE=1
export LSAN_OPTIONS=suppressions=$PWD/tests/leaks.supp:print_suppressions=0
# The sanitizers themselves may find a symbolizer that they then refuse, and say so wherever a known leak is looked up.
if command -v llvm-symbolizer >/dev/null; then
  ASAN_SYMBOLIZER_PATH=$(readlink -f "$(command -v llvm-symbolizer)")
  export ASAN_SYMBOLIZER_PATH
fi
export TSAN_OPTIONS=suppressions=$PWD/tests/threads.supp:print_suppressions=0${ASAN_SYMBOLIZER_PATH:+:external_symbolizer_path=$ASAN_SYMBOLIZER_PATH}
unset DISPLAY WAYLAND_DISPLAY  # nothing here may need a display

full=false
for argument in "$@"; do
  case "$argument" in
    --full) full=true ;;
    -h | --help) sed -n '3,8s/^# \{0,1\}//p' "${BASH_SOURCE[0]}"; exit 0 ;;
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
    # Only what is compiled has flags to be read with; of clang's builds this one has the most.
    if grep -q "/$file\"" build/asan/compile_commands.json; then echo "$file"; fi
  done | xargs -P "$jobs" -n 2 clang-tidy-16 -p build/asan --quiet --warnings-as-errors='*'
}

threaded_tests() {
  # Only the programs that hold such tests: with this sanitizer every file takes twice as long.
  build tsan --target "${threaded_programs[@]}" && run_ctest tsan -L unit -R "$threaded" &&
    build/tsan/tests/sonar_observe_test --gtest_brief=1 --gtest_filter='*Threads*:*Cancel*'
}

same_bytes_of_both_compilers() {
  # Each simulated and ran the small survey in its tests.
  local file
  for file in survey/truth/schools.csv out/schools.csv out/school_pings.csv out/products/obs-0001.nc out/products/obs-0002.nc; do
    cmp "build/dev/tests/cli/$file" "build/asan/tests/cli/$file" || return 1
  done
}

vulkan_tests() {
  # Mesa's OpenGL on Vulkan on the processor: a second compiler of shaders, and one that is strict. Without a context the
  # tests would skip themselves; that it is this driver is asked first.
  local MESA_LOADER_DRIVER_OVERRIDE=zink LIBGL_ALWAYS_SOFTWARE=1 SONAR_GL_DRIVER=zink
  local VK_ICD_FILENAMES
  VK_ICD_FILENAMES=$(compgen -G '/usr/share/vulkan/icd.d/lvp_icd*.json')
  export MESA_LOADER_DRIVER_OVERRIDE LIBGL_ALWAYS_SOFTWARE SONAR_GL_DRIVER VK_ICD_FILENAMES
  build/dev/src/render/sonar_render_gl_test --gtest_brief=1 --gtest_filter='*DrawsWithTheDriver*' |
    tee /dev/stderr | grep 'PASSED.* 1 test' >/dev/null && run_ctest dev -L gl
}

headless() {
  build headless --target sonarx && build/headless/src/cli/sonarx --version || return 1
  # Neither the compiler nor the linker may have been told of Qt.
  ! grep -n 'Qt[56]' build/headless/build.ninja && ! ldd build/headless/src/cli/sonarx | grep -i 'libqt\|not found'
}

benchmarks() {
  if ! compgen -G '/usr/lib/cmake/ITK-*' >/dev/null; then
    echo "ITK is not installed (tools/setup.sh bench): left out"
    return 0
  fi
  build bench --target bench_median
}

# Tests in which several threads work on the same things, and the programs that hold them.
threaded='[Tt]hreads?([A-Z_]|$)|Work\.|^session$'
threaded_programs=(sonar_base_test sonar_signal_test sonar_io_test sonar_synth_test sonar_session_test sonar_observe_test)

mkdir -p build
if $full; then part "packages" tools/setup.sh full readers; else part "packages" tools/setup.sh test; fi
part "format" check_format
part "layers" tools/check_layers
part "build with g++" build dev
if $full; then
  part "tests, the slow ones too" run_ctest dev
  part "OpenGL tests on Vulkan" vulkan_tests
  part "every header alone" tools/check_headers build/dev
  part "build with clang 16, address and undefined-behaviour sanitizers" build asan
  part "clang-tidy" tidy
  part "tests with address and undefined-behaviour sanitizers" run_ctest asan -LE 'slow|gui'
  part "g++ and clang give the same bytes" same_bytes_of_both_compilers
  part "fuzzing" tools/fuzz --preset asan --seconds 5 --seed 1 --no-ledger
  part "threaded tests with the thread sanitizer" threaded_tests
  part "headless build" headless
  part "build of the benchmarks" benchmarks
else
  part "tests" run_ctest dev -LE slow
fi

echo
printf '%s\n' "${report[@]}"
printf '%5d s  in all\n' "$SECONDS"
printf '%s\n' "${verdicts[@]}"
