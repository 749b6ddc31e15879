#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Builds the Debian packages of the command line and of the desktop into build/packages/packages, the same bytes each time.
#   packaging/make_packages.sh [FOLDER]      (copies them there too)
set -euo pipefail
destination=${1:+$(readlink -m "$1")}
cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/.."
exec </dev/null
case "${1:-}" in -h | --help) sed -n '3,4s/^# \{0,1\}//p' "${BASH_SOURCE[0]}"; exit 0 ;; esac

if [[ -z ${SOURCE_DATE_EPOCH:-} ]]; then
  # A source archive has no git; then the newest of its changes dates it.
  SOURCE_DATE_EPOCH=$(git -c safe.directory="$PWD" log -1 --format=%ct 2>/dev/null || stat -c %Y CHANGELOG.md)
fi
export SOURCE_DATE_EPOCH

echo "== packages that are needed"
tools/setup.sh packages
echo "== build"
mkdir -p build
cmake --preset packages >build/packages.configure.log 2>&1 || { cat build/packages.configure.log; exit 1; }
cmake --build --preset packages
echo "== pack"
rm -rf build/packages/packages
cpack --config build/packages/CPackConfig.cmake
rm -rf build/packages/packages/_CPack_Packages
if [[ -n $destination ]]; then
  mkdir -p "$destination"
  cp build/packages/packages/*.deb "$destination"
fi
ls -l build/packages/packages/*.deb
