#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Installs the Debian 12 packages that the project needs; does nothing, quickly, where they are there.
#   tools/setup.sh [build | test | full | bench | readers | cluster | packages]...     (default: build)
# build  to build and run sonarx      test   build + unit, data and command-line tests, format check
# full   test + clang, clang-tidy, sanitizers, fuzzing, Vulkan's tools      bench  build + the rivals that the benchmarks measure
# readers  test + other people's programs that read our files: xarray, OGR, R, QGIS, VTK      cluster  test + Slurm
# packages  build + what makes the Debian packages and the manual, and tries them in a bare root
set -euo pipefail

build=(g++ cmake ninja-build ccache pkg-config ca-certificates python3
       libfmt-dev libexpected-dev libtbb-dev libxxhash-dev libsleef-dev libproj-dev proj-data libhwy-dev
       libnetcdf-dev libseccomp-dev libgdal-dev libpugixml-dev nlohmann-json3-dev libcli11-dev
       libcairo2-dev libpango1.0-dev fonts-dejavu-core libepoxy-dev libegl-dev libegl1 libegl-mesa0 libgl1-mesa-dri qt6-base-dev)
test=(libgtest-dev libgmock-dev clang-format-16 git locales python3-numpy python3-netcdf4
      pybind11-dev python3-dev netcdf-bin udunits-bin libxml2-utils xvfb xauth ffmpeg
      bash-completion zsh fish)
readers=(python3-xarray python3-matplotlib gdal-bin r-base-core r-cran-ncdf4 r-cran-sf r-cran-ggplot2 python3-qgis
         python3-vtk9)
cluster=(munge slurmctld slurmd slurm-client)
packages=(pybind11-dev python3-dev dpkg-dev file gzip git mkdocs desktop-file-utils groff-base debootstrap
          patchelf squashfs-tools)
full=(clang-16 clang-tidy-16 libclang-rt-16-dev lld-16 glslang-tools spirv-tools mesa-vulkan-drivers)
bench=(libbenchmark-dev libinsighttoolkit5-dev python3-numpy python3-vtk9 xvfb)

wanted=("${build[@]}")
for group in "${@:-build}"; do
  case "$group" in
    build) ;;
    test) wanted+=("${test[@]}") ;;
    full) wanted+=("${test[@]}" "${full[@]}") ;;
    bench) wanted+=("${bench[@]}") ;;
    readers) wanted+=("${test[@]}" "${readers[@]}") ;;
    cluster) wanted+=("${test[@]}" "${cluster[@]}") ;;
    packages) wanted+=("${packages[@]}") ;;
    *) echo "setup.sh: '$group' is none of build, test, full, bench, readers, cluster, packages" >&2; exit 2 ;;
  esac
done

if ! command -v dpkg-query >/dev/null; then
  echo "setup.sh: this is no Debian; install what docs/dependencies.md lists, then run cmake and ctest by hand" >&2
  exit 1
fi
# Unknown packages make dpkg-query fail; what it prints about the others is still right.
installed=" $(dpkg-query -W -f '${Package}=${db:Status-Status} ' "${wanted[@]}" 2>/dev/null || true)"
missing=()
for package in "${wanted[@]}"; do
  [[ "$installed" == *" $package=installed "* ]] || missing+=("$package")
done
if ((${#missing[@]} == 0)); then
  exit 0
fi

as_root=(env DEBIAN_FRONTEND=noninteractive)
if ((EUID != 0)); then
  if ! command -v sudo >/dev/null; then
    echo "setup.sh: missing packages: ${missing[*]}" >&2
    echo "setup.sh: run it as root, or install sudo" >&2
    exit 1
  fi
  # Without a terminal nobody can type a password: fail at once instead of waiting. sudo asks on the terminal itself, whatever
  # standard input is.
  if { : </dev/tty; } 2>/dev/null; then as_root=(sudo "${as_root[@]}"); else as_root=(sudo -n "${as_root[@]}"); fi
fi
echo "installing ${#missing[@]} packages: ${missing[*]}"
"${as_root[@]}" apt-get -q -o Acquire::Retries=3 update </dev/null
"${as_root[@]}" apt-get -q -y -o Acquire::Retries=3 install --no-install-recommends "${missing[@]}" </dev/null
