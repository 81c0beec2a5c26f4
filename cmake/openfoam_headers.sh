#!/bin/sh
# SPDX-License-Identifier: GPL-2.0-or-later
# openfoam_headers.sh FOLDER: OpenFOAM's headers into FOLDER/include, one flat folder a library.
# Debian ships OpenFOAM's libraries without headers; they come from its source package of the
# same version. deb-src entries are derived from the package sources that are configured, in
# an apt configuration of our own inside FOLDER; the system's is left as it is.
set -eu
mkdir -p "$1"
folder=$(cd "$1" && pwd)
version=$(dpkg-query -W -f '${source:Version}' libopenfoam)
[ "$(cat "$folder/version" 2>/dev/null || true)" != "$version" ] || exit 0

apt=$folder/apt
rm -rf "$apt" "$folder/include" "$folder/version"
mkdir -p "$apt/parts" "$apt/lists/partial" "$apt/cache" "$apt/source"
: >"$apt/sources.list"
for from in /etc/apt/sources.list /etc/apt/sources.list.d/*.list; do
    [ -f "$from" ] || continue
    sed -n 's/^deb\([[:space:]]\)/deb-src\1/p' "$from" >"$apt/parts/$(basename "$from" .list).list"
done
for from in /etc/apt/sources.list.d/*.sources; do
    [ -f "$from" ] || continue
    sed 's/^Types:.*/Types: deb-src/' "$from" >"$apt/parts/$(basename "$from")"
done
with_sources() {
    apt-get -qq -o Dir::Etc::sourcelist="$apt/sources.list" -o Dir::Etc::sourceparts="$apt/parts" \
        -o Dir::State::lists="$apt/lists" -o Dir::Cache="$apt/cache" \
        -o APT::Sandbox::User="$(id -un)" "$@"
}
with_sources update || true  # sources of other vendors may have no source packages
(cd "$apt/source" && with_sources source --download-only "openfoam=$version")

tar -C "$apt/source" --strip-components=1 --wildcards -xjf "$apt"/source/openfoam_*.orig.tar.bz2 \
    '*/src/OpenFOAM' '*/src/OSspecific/POSIX' '*/src/finiteVolume' '*/src/meshTools' \
    '*/src/TurbulenceModels' '*/src/transportModels' '*/src/fileFormats' '*/src/surfMesh' \
    '*/applications/solvers/incompressible/pimpleFoam'
# flat NAME SUBFOLDER: headers, and the .C files that they include as templates.
flat() {
    mkdir -p "$folder/include/$1"
    find "$apt/source/$2" \( -name '*.H' -o -name '*.C' \) -exec mv -f -t "$folder/include/$1" {} +
}
# Its subfolders are other solvers.
mkdir -p "$folder/include/pimpleFoam"
mv "$apt"/source/applications/solvers/incompressible/pimpleFoam/*.[CH] "$folder/include/pimpleFoam"
for library in OpenFOAM finiteVolume meshTools fileFormats surfMesh; do
    flat $library src/$library
done
flat POSIX src/OSspecific/POSIX
# These two are included by their folders' names, too.
cp -r "$apt/source/src/transportModels" "$apt/source/src/TurbulenceModels" "$folder/include"
flat transportModelsFlat src/transportModels/incompressible
flat turbulenceModelsFlat src/TurbulenceModels/turbulenceModels
flat incompressibleFlat src/TurbulenceModels/incompressible
rm -rf "$apt"
echo "$version" >"$folder/version"
