#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Installs the packages into a bare Debian 12, does a first survey there, builds a program on the library and reads pings from
# Python, with times. Needs root, and the mirror that this machine's apt uses.
#   packaging/test_packages.sh [FOLDER]      FOLDER: where the .deb files are (default: build/packages/packages)
# The bare Debian stands in SONAR_ROOT (default: a temporary folder, removed at the end).
set -euo pipefail
here=$(cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/.." && pwd)
exec </dev/null
case "${1:-}" in -h | --help) sed -n '3,6s/^# \{0,1\}//p' "${BASH_SOURCE[0]}"; exit 0 ;; esac
packages=$(readlink -f "${1:-$here/build/packages/packages}")
sonarx=$(echo "$packages"/sonarx_*.deb)
explorer=$(echo "$packages"/sonar-explorer_*.deb)
library=$(echo "$packages"/libsonar-explorer_*.deb)
headers=$(echo "$packages"/libsonar-explorer-dev_*.deb)
module=$(echo "$packages"/python3-sonar-explorer_*.deb)
[[ -f $sonarx ]] || { echo "test_packages.sh: no sonarx_*.deb in $packages (packaging/make_packages.sh makes it)" >&2; exit 1; }
((EUID == 0)) || { echo "test_packages.sh: run it as root; it makes a root of its own" >&2; exit 1; }
for tool in debootstrap dpkg-deb desktop-file-validate groff; do
  command -v "$tool" >/dev/null || { echo "test_packages.sh: no $tool (tools/setup.sh packages)" >&2; exit 1; }
done

failed=0
say() { printf '%-52s %s\n' "$1" "$2"; }
check() {
  local what=$1
  shift
  if "$@" >"$work/log" 2>&1; then say "$what" "ok"; else say "$what" "FAILED"; sed 's/^/    /' "$work/log"; failed=1; fi
}
seconds() { # prints how long the command took; its output goes to a file
  local begin=$EPOCHREALTIME
  "$@" >"$work/log" 2>&1 || { echo "failed: $*" >&2; tail -20 "$work/log" >&2; return 1; }
  awk -v a="$begin" -v b="$EPOCHREALTIME" 'BEGIN { printf "%.1f s\n", b - a }'
}
size_mb() { du -sxm "$1" | cut -f1; }

work=$(mktemp -d)
root=${SONAR_ROOT:-$work/root}
stays() {
  local status=0
  bare env QT_QPA_PLATFORM=offscreen timeout 5 sonar-explorer /survey || status=$?
  ((status == 124))
}
schools_of_table() { # observation,school_id,n_pings,sv_mean_db of the first survey, as the example prints them
  awk -F, 'NR == 1 { for (i = 1; i <= NF; ++i) at[$i] = i; next }
           { printf "%s,%.2f,%.2f,%.2f\n", $at["observation"], $at["school_id"], $at["n_pings"], $at["sv_mean_db"] }' "$root/out/schools.csv"
}
read_pings() { # the loudest valid sample of each school in each ping, out of the pings' own arrays, is that of the table
  bare python3 - <<'END'
import csv
import sonar_explorer as se
observation = se.open_survey("/survey").observation("obs-0001")
product = se.read_product("/out/products/obs-0001.nc")
for row in csv.DictReader(open("/out/school_pings.csv")):
    index, number = int(row["ping_index"]), int(row["school_id"])
    ping = observation.ping(index)
    members = (product.school_ids(index) == number) & (ping.flags == 0)
    loudest_db = ping.sv[members].max() * se.DB_PER_COUNT
    assert abs(loudest_db - float(row["sv_max_db"])) < se.DB_PER_COUNT / 2, (row, loudest_db)
END
}
mounted() { grep -q " $root/proc " /proc/mounts; }
clean() {
  if mounted; then umount "$root/proc"; fi
  if ! mounted; then rm -rf "$work"; fi
}
trap clean EXIT
bare() (
  exec env -i HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin LC_ALL=C.UTF-8 DEBIAN_FRONTEND=noninteractive chroot "$root" "$@"
)

echo "== what the packages hold"
for package in "$sonarx" "$explorer" "$library" "$headers" "$module"; do
  if [[ -f $package ]]; then say "$(basename "$package")" "$(stat -c %s "$package") bytes"; fi
done
depends=$(dpkg-deb -f "$sonarx" Depends)
echo "sonarx depends on $depends"
check "no Qt and no X library is linked by the command line" bash -c "! grep -qiE 'qt|libx11|libxcb|libgl[0-9]' <<<'$depends'"
mkdir "$work/cli" "$work/desktop"
dpkg-deb -x "$sonarx" "$work/cli"
usr=$work/cli/usr
check "the manual that --help names is in the package" \
  bash -c "manual=\$('$usr/bin/sonarx' --help | sed -n 's/^Manual: //p'); [[ \$manual == '$usr'/* && -f \$manual ]]"
check "man pages name it where it will be" zgrep -qF '/usr/share/doc/sonarx/user\-guide.md' "$usr/share/man/man1/sonarx.1.gz"
check "man pages: no warning" bash -c "
  cd '$usr/share/man/man1'; for page in *.gz; do zcat \$page | groff -ww -man -Kutf8 -Tutf8 -z || exit 1; done 2>&1 | tee '$work/man'
  ! test -s '$work/man'"
check "a man page for every verb" bash -c "
  '$usr/bin/sonarx' --help | sed -n '/^Verbs/,/^\$/s/^  \([a-z]*\) .*/\1/p' | grep -v '^help\$' |
    while read -r verb; do test -f '$usr/share/man/man1/sonarx-'\$verb.1.gz || exit 1; done"
check "completion: bash" bash -n "$usr/share/bash-completion/completions/sonarx"
if command -v zsh >/dev/null; then check "completion: zsh" zsh -n "$usr/share/zsh/vendor-completions/_sonarx"; fi
if command -v fish >/dev/null; then check "completion: fish" fish -n "$usr/share/fish/vendor_completions.d/sonarx.fish"; fi
check "manual as HTML, with pictures" test -s "$usr/share/doc/sonarx/html/index.html" -a -d "$usr/share/doc/sonarx/html/pictures"
check "no folder of the build in it" bash -c "! grep -rlF '$here' '$work/cli'"
if [[ -f $explorer ]]; then
  dpkg-deb -x "$explorer" "$work/desktop"
  check "no folder of the build in the desktop" bash -c "! grep -rlF '$here' '$work/desktop'"
  check "desktop entry" desktop-file-validate "$work/desktop/usr/share/applications/sonar-explorer.desktop"
  if command -v appstreamcli >/dev/null; then
    # Its name is no reversed domain name, because the project has no domain: a warning.
    check "metainfo: no error" bash -c "
      ! appstreamcli validate --no-net '$work/desktop/usr/share/metainfo/sonar-explorer.metainfo.xml' | grep '^E:'"
  fi
fi

for package in "$library" "$headers" "$module"; do
  [[ -f $package ]] || continue
  mkdir "$work/one"
  dpkg-deb -x "$package" "$work/one"
  check "no folder of the build in $(dpkg-deb -f "$package" Package)" bash -c "! grep -rlF '$here' '$work/one'"
  rm -r "$work/one"
done

echo "== bare Debian 12"
# The mirror that apt here uses, in either way of writing it.
mirror=$({ cat /etc/apt/sources.list /etc/apt/sources.list.d/*.list /etc/apt/sources.list.d/*.sources 2>/dev/null || true; } |
  awk '/^deb[ \t]/ { for (i = 2; i < NF; ++i) if ($i ~ /:\/\// && $(i + 1) == "bookworm") print $i }
       /^URIs:/ { uri = $2 } /^Suites:/ { for (i = 2; i <= NF; ++i) if ($i == "bookworm") print uri }' | sed -n 1p)
[[ -n $mirror ]] || { echo "test_packages.sh: apt's sources name no mirror of bookworm" >&2; exit 1; }
if [[ ! -f $root/etc/debian_version ]]; then
  say "debootstrap from $mirror" "$(seconds debootstrap --variant=minbase bookworm "$root" "$mirror")"
fi
mounted || mount -t proc proc "$root/proc"
before=$(size_mb "$root")
say "size of the bare root" "$before MB"
mkdir -p "$root/packages"
cp "$packages"/*.deb "$root/packages"
bare apt-get -q update >"$work/log" 2>&1 || { cat "$work/log"; exit 1; }

echo "== sonarx"
begin=$EPOCHREALTIME
say "apt install ./sonarx_*.deb" "$(seconds bare bash -c 'apt-get -q install -y /packages/sonarx_*.deb')"
bare apt-get clean
say "installed" "$(bare dpkg-query -W -f '${Package} ${Version}' sonarx), $(($(size_mb "$root") - before)) MB with what it needs"
check "no Qt is installed" bash -c "! chroot '$root' dpkg-query -W -f '\${Package}\n' 2>/dev/null | grep -i '^libqt'"
check "no library is missing" bash -c "! chroot '$root' ldd /usr/bin/sonarx | grep 'not found'"
bare rm -rf /survey /out
say "simulate (easy, 40 pings)" "$(seconds bare sonarx simulate /survey --preset easy --seed 1 --observations 1 --pings 40 -q)"
say "run" "$(seconds bare sonarx run /survey -o /out -q)"
say "from the package to the first table" "$(awk -v a="$begin" -v b="$EPOCHREALTIME" 'BEGIN { printf "%.1f s", b - a }')"
cut -d, -f1-8 "$root/out/schools.csv" | head -4
check "the table has a school" bash -c "test \$(wc -l <'$root/out/schools.csv') -gt 1"
check "render a map" bare sonarx render survey-map /out -o /out/survey-map.png
check "render a volume" bare sonarx render volume /survey /out -o /out/volume.png

if [[ -f $library && -f $headers ]]; then
  echo "== libsonar-explorer, libsonar-explorer-dev"
  before=$(size_mb "$root")
  say "apt install ./libsonar-explorer*.deb" "$(seconds bare bash -c 'apt-get -q install -y /packages/libsonar-explorer*.deb')"
  bare apt-get clean
  say "installed" "$(($(size_mb "$root") - before)) MB more"
  say "apt install g++ cmake make" "$(seconds bare apt-get -q install -y --no-install-recommends g++ cmake make)"
  bare apt-get clean
  bare rm -rf /example /products
  cp -r "$here/examples/cpp" "$root/example"
  say "build examples/cpp" "$(seconds bare bash -c 'cmake -S /example -B /example/build && cmake --build /example/build')"
  say "run it: detects" "$(seconds bare bash -c '/example/build/schools /survey /products >/example/told')"
  check "it finds what the table says" diff <(grep '^obs-[0-9]*,' "$root/example/told") <(schools_of_table)
fi

if [[ -f $library && -f $module ]]; then
  echo "== python3-sonar-explorer"
  before=$(size_mb "$root")
  say "apt install ./python3-sonar-explorer_*.deb" \
      "$(seconds bare bash -c 'apt-get -q install -y /packages/libsonar-explorer_*.deb /packages/python3-sonar-explorer_*.deb')"
  bare apt-get clean
  say "installed" "$(($(size_mb "$root") - before)) MB more"
  check "python3 opens the survey, its pings are the table's" read_pings
fi

if [[ -f $explorer ]]; then
  echo "== sonar-explorer"
  before=$(size_mb "$root")
  say "apt install ./sonar-explorer_*.deb" \
      "$(seconds bare bash -c 'apt-get -q install -y /packages/sonar-explorer_*.deb')"
  bare apt-get clean
  say "installed" "$(bare dpkg-query -W -f '${Package} ${Version}' sonar-explorer), $(($(size_mb "$root") - before)) MB more"
  check "no library is missing" bash -c "! chroot '$root' ldd /usr/bin/sonar-explorer | grep 'not found'"
  check "the desktop knows its files" bash -c "grep -q simrad '$root/usr/share/mime/packages/sonar-explorer.xml' &&
    { ! test -x '$root/usr/bin/update-mime-database' || grep -q simrad '$root/usr/share/mime/magic'; }"
  check "--version needs no display" bare sonar-explorer --version
  status=0
  { bare timeout 60 sonar-explorer /survey >"$work/log" 2>&1 || status=$?; } 2>/dev/null
  say "without a display it ends with" "$status after $(grep -c . "$work/log") lines:"
  sed 's/^/    /' "$work/log"
  # 124: it was still there when its time was over.
  check "on a display that shows nothing it stays" stays
fi
exit $failed
