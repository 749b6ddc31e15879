#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Sets everything up and does the main job: simulates a survey of raw files, finds the schools in it, prints what was
# found and where the tables and the map are. Where there is a display the survey is opened on it at the end.
# A program of the same version that is installed is used; else it is built first.
#   tools/demo.sh [FOLDER]      (default: build/demo in the project)
set -euo pipefail
here=$(cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/.." && pwd)
exec </dev/null
export LC_ALL=C
case "${1:-}" in -h | --help) sed -n '3,6s/^# \{0,1\}//p' "${BASH_SOURCE[0]}"; exit 0 ;; esac
folder=${1:-$here/build/demo}
mkdir -p "$folder"
folder=$(cd "$folder" && pwd)
cd "$here"

version=$(sed -n 's/^project(sonar-explorer VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)
sonarx=$(command -v sonarx || true)
explorer=$(command -v sonar-explorer || true)
if [[ -n $sonarx && $("$sonarx" --version 2>/dev/null) == "sonarx $version" ]]; then
  echo "== program"
  echo "$sonarx is installed and has this tree's version, $version: nothing is built"
else
  echo "== packages"
  tools/setup.sh build
  echo "== build"
  mkdir -p build
  cmake --preset release -DSONAR_TESTS=OFF >build/release.configure.log 2>&1 || { cat build/release.configure.log; exit 1; }
  cmake --build --preset release --target sonarx sonar-explorer
  sonarx=$here/build/release/src/cli/sonarx
  explorer=$here/build/release/src/gui/sonar-explorer
fi

echo "== survey"
# The truth is written last, so its presence means a whole survey.
if [[ ! -f $folder/survey/truth/schools.csv ]]; then
  rm -rf "$folder/survey.partial"
  "$sonarx" simulate "$folder/survey.partial" --preset demo --seed 1
  rm -rf "$folder/survey"
  mv "$folder/survey.partial" "$folder/survey"
fi
echo "$folder/survey: $(find "$folder/survey" -maxdepth 1 -name '*.raw' | wc -l) raw files, $(du -sh "$folder/survey" | cut -f1)"

echo "== run"
"$sonarx" run "$folder/survey" --out "$folder/out"

echo "== schools"
awk -F, 'NR == 1 { for (i = 1; i <= NF; ++i) column[$i] = i
                   printf "%-9s %4s %6s %10s %10s %8s %9s %8s %8s %7s\n", "survey", "id", "pings", "latitude", "longitude",
                          "depth m", "length m", "Sv dB", "m/s", "course"; next }
         { printf "%-9s %4s %6s %10.5f %10.5f %8.1f %9.1f %8.1f %8s %7s\n", $column["observation"], $column["school_id"],
                  $column["n_pings"], $column["latitude"], $column["longitude"], $column["depth_m"], $column["length_m"],
                  $column["sv_mean_db"], $column["speed_mps"] == "" ? "-" : sprintf("%.2f", $column["speed_mps"]),
                  $column["course_deg"] == "" ? "-" : sprintf("%.0f", $column["course_deg"]) }' "$folder/out/schools.csv"

echo "== against the known truth"
"$sonarx" score "$folder/out" --truth "$folder/survey/truth"

echo "== pictures"
pictures=$folder/pictures
mkdir -p "$pictures"
"$sonarx" render survey-map "$folder/out" --depth-raster "$folder/survey/truth/depth.tif" --out "$pictures/survey-map.pdf"
"$sonarx" render timeline "$folder/survey" "$folder/out" --whole-survey --out "$pictures/timeline.png"
"$sonarx" render volume "$folder/survey" "$folder/out" --out "$pictures/volume.png"
"$sonarx" render slice-top "$folder/survey" "$folder/out" --out "$pictures/slice-top.png"

echo "== where it is"
echo "raw survey         $folder/survey"
echo "table of schools   $folder/out/schools.csv"
echo "school by ping     $folder/out/school_pings.csv"
echo "map for QGIS       $folder/out/survey.gpkg"
echo "masks              $folder/out/products"
echo "pictures           $pictures"
echo "command line       $sonarx --help"
if [[ -z $explorer ]]; then
  echo "desktop            not installed (package sonar-explorer)"
  exit 0
fi
echo "desktop            $explorer $folder/survey"
if [[ -n ${DISPLAY:-}${WAYLAND_DISPLAY:-} ]]; then exec "$explorer" "$folder/survey"; fi
