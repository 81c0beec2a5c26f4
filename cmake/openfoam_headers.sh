#!/bin/sh
# SPDX-License-Identifier: GPL-2.0-or-later
# openfoam_headers.sh FOLDER: OpenFOAM's headers into FOLDER/include, one flat folder a library.
# Debian ships OpenFOAM's libraries without headers; they come from its source package of the
# same version (debian_source.sh).
set -eu
mkdir -p "$1"
folder=$(cd "$1" && pwd)
version=$(dpkg-query -W -f '${source:Version}' libopenfoam)
[ "$(cat "$folder/version" 2>/dev/null || true)" != "$version" ] || exit 0

from=$folder/source
rm -rf "$from" "$folder/include" "$folder/version"
"$(dirname "$0")/debian_source.sh" "$from" openfoam libopenfoam

tar -C "$from" --strip-components=1 --wildcards -xjf "$from"/openfoam_*.orig.tar.bz2 \
    '*/src/OpenFOAM' '*/src/OSspecific/POSIX' '*/src/finiteVolume' '*/src/meshTools' \
    '*/src/TurbulenceModels' '*/src/transportModels' '*/src/fileFormats' '*/src/surfMesh' \
    '*/applications/solvers/incompressible/pimpleFoam'
# flat NAME SUBFOLDER: headers, and the .C files that they include as templates.
flat() {
    mkdir -p "$folder/include/$1"
    find "$from/$2" \( -name '*.H' -o -name '*.C' \) -exec mv -f -t "$folder/include/$1" {} +
}
# Its subfolders are other solvers.
mkdir -p "$folder/include/pimpleFoam"
mv "$from"/applications/solvers/incompressible/pimpleFoam/*.[CH] "$folder/include/pimpleFoam"
for library in OpenFOAM finiteVolume meshTools fileFormats surfMesh; do
    flat $library src/$library
done
flat POSIX src/OSspecific/POSIX
# These two are included by their folders' names, too.
cp -r "$from/src/transportModels" "$from/src/TurbulenceModels" "$folder/include"
flat transportModelsFlat src/transportModels/incompressible
flat turbulenceModelsFlat src/TurbulenceModels/turbulenceModels
flat incompressibleFlat src/TurbulenceModels/incompressible
rm -rf "$from"
echo "$version" >"$folder/version"
