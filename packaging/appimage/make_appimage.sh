#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Makes an AppImage of the desktop with the command line in it: one file that runs on Linux distributions not older than
# the one it was made on.
#   packaging/appimage/make_appimage.sh [RUNTIME]      RUNTIME: the file below (default: ~/Downloads/runtime-x86_64)
# Debian packages all that it needs but the 1 MB with which an AppImage begins. Download it first:
#   runtime-x86_64      github.com/AppImage/type2-runtime, Releases
# Without it, it stops when all but this is done; build/AppDir/AppRun then starts as the AppImage would. So far this alone has been
# tried: in a bare Debian 12 with X, fonts and OpenGL, the command line on a survey and the desktop's window.
set -euo pipefail
here=$(cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../.." && pwd)
exec </dev/null
case "${1:-}" in -h | --help) sed -n '3,9s/^# \{0,1\}//p' "${BASH_SOURCE[0]}"; exit 0 ;; esac
runtime=$(readlink -m "${1:-$HOME/Downloads/runtime-x86_64}")
cd "$here"
appdir=$here/build/AppDir

echo "== build"
tools/setup.sh build packages
mkdir -p build
cmake --preset packages >build/packages.configure.log 2>&1 || { cat build/packages.configure.log; exit 1; }
cmake --build --preset packages

echo "== AppDir"
rm -rf "$appdir"
for component in cli desktop; do
  cmake --install build/packages --prefix "$appdir/usr" --strip --component $component
done >build/AppDir.log
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

echo "== libraries"
lib=$appdir/usr/lib
plugins=$(qmake6 -query QT_INSTALL_PLUGINS)
for plugin in platforms/libqxcb platforms/libqoffscreen imageformats/libqsvg xcbglintegrations/libqxcb-egl-integration \
              xcbglintegrations/libqxcb-glx-integration; do
  if [[ -f $plugins/$plugin.so ]]; then install -D -m 644 -t "$appdir/usr/plugins/${plugin%/*}" "$plugins/$plugin.so"; fi
done
# The C and C++ libraries are newer on the machines it runs on, OpenGL is that of the graphics card, X and fonts that of the desktop.
machines='lib(c|m|dl|rt|pthread|resolv|stdc\+\+|gcc_s|GL|EGL|GLX|GLdispatch|OpenGL|drm|gbm|X11|X11-xcb|xcb|fontconfig|freetype)\.so|ld-linux'
mkdir -p "$lib"
find "$appdir/usr/bin" "$appdir/usr/plugins" -type f -print0 | xargs -0 ldd |
  awk '$2 == "=>" && $3 ~ /^\// { print $3 }' | sort -u | grep -vE "/($machines)" | xargs cp -L -t "$lib"
find "$lib" -maxdepth 1 -name '*.so*' -type f -exec patchelf --set-rpath "\$ORIGIN" {} +
find "$appdir/usr/bin" -type f -exec patchelf --set-rpath "\$ORIGIN/../lib" {} +
find "$appdir/usr/plugins" -type f -exec patchelf --set-rpath "\$ORIGIN/../../lib" {} +
printf '[Paths]\nPrefix = ..\nPlugins = plugins\n' >"$appdir/usr/bin/qt.conf"
du -sh "$appdir"

echo "== AppImage"
version=$(sed -n 's/^project(sonar-explorer VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)
image=$here/build/sonar-explorer-$version-x86_64.AppImage
mksquashfs "$appdir" "$image.squashfs" -noappend -root-owned -quiet -no-progress -comp xz
if [[ ! -f $runtime ]]; then
  ls -l "$image.squashfs"
  echo "no $runtime: the AppDir is in $appdir" >&2
  exit 1
fi
cat "$runtime" "$image.squashfs" >"$image"
chmod +x "$image"
rm "$image.squashfs"
ls -l "$image"
