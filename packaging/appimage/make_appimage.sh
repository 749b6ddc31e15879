#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Makes an AppImage of the desktop with the command line in it: one file that runs on Linux distributions not older than
# the one it was made on.
#   packaging/appimage/make_appimage.sh [FOLDER]      FOLDER: where linuxdeploy's AppImages are (default: ~/Downloads)
# It needs two programs that Debian has not packaged. Download them first:
#   linuxdeploy-x86_64.AppImage             github.com/linuxdeploy/linuxdeploy, Releases
#   linuxdeploy-plugin-qt-x86_64.AppImage   github.com/linuxdeploy/linuxdeploy-plugin-qt, Releases
# Without them it stops when the AppDir is complete but for the libraries. So far this alone has been tried, and the programs
# started from the AppDir; the last step has not.
set -euo pipefail
here=$(cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../.." && pwd)
exec </dev/null
case "${1:-}" in -h | --help) sed -n '3,10s/^# \{0,1\}//p' "${BASH_SOURCE[0]}"; exit 0 ;; esac
tools=$(readlink -m "${1:-$HOME/Downloads}")
cd "$here"
appdir=$here/build/AppDir

echo "== build"
tools/setup.sh build packages
mkdir -p build
cmake --preset packages >build/packages.configure.log 2>&1 || { cat build/packages.configure.log; exit 1; }
cmake --build --preset packages

echo "== AppDir"
rm -rf "$appdir"
cmake --install build/packages --prefix "$appdir/usr" --strip >build/AppDir.log
# One file, two programs: `FILE sonarx ...`, or a link to it that is named sonarx, is the command line; else the desktop.
# Its --help still names /usr/share/doc/sonarx, where an AppImage installs nothing.
cat >"$appdir/AppRun" <<'END'
#!/bin/sh
here=$(dirname "$(readlink -f "$0")")
# GDAL, PROJ and the MIME types bring data; those of the machine may be of another version.
export PROJ_DATA="$here/usr/share/proj" PROJ_LIB="$here/usr/share/proj" GDAL_DATA="$here/usr/share/gdal"
if [ "$(basename "${ARGV0:-$0}")" = sonarx ]; then exec "$here/usr/bin/sonarx" "$@"; fi
if [ "${1:-}" = sonarx ]; then shift; exec "$here/usr/bin/sonarx" "$@"; fi
exec "$here/usr/bin/sonar-explorer" "$@"
END
chmod +x "$appdir/AppRun"
cp -r /usr/share/proj "$appdir/usr/share/proj"
cp -r /usr/share/gdal "$appdir/usr/share/gdal"
cp packaging/desktop/sonar-explorer.desktop "$appdir/"
cp packaging/desktop/sonar-explorer.svg "$appdir/"
du -sh "$appdir"

echo "== AppImage"
linuxdeploy=$tools/linuxdeploy-x86_64.AppImage
if [[ ! -x $linuxdeploy || ! -x $tools/linuxdeploy-plugin-qt-x86_64.AppImage ]]; then
  echo "no linuxdeploy-x86_64.AppImage and linuxdeploy-plugin-qt-x86_64.AppImage in $tools: the AppDir is in $appdir" >&2
  exit 1
fi
version=$(sed -n 's/^project(sonar-explorer VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)
# Without FUSE, as in a container, AppImages unpack themselves first.
export APPIMAGE_EXTRACT_AND_RUN=1 QMAKE=/usr/bin/qmake6 LINUXDEPLOY_OUTPUT_VERSION=$version
export LDAI_OUTPUT=$here/build/sonar-explorer-$version-x86_64.AppImage
PATH=$tools:$PATH "$linuxdeploy" --appdir "$appdir" --plugin qt --output appimage \
  --executable "$appdir/usr/bin/sonarx" --executable "$appdir/usr/bin/sonar-explorer" \
  --desktop-file "$appdir/usr/share/applications/sonar-explorer.desktop" \
  --icon-file "$appdir/usr/share/icons/hicolor/scalable/apps/sonar-explorer.svg" --custom-apprun "$appdir/AppRun"
ls -l "$LDAI_OUTPUT"
