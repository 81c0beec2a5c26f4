#!/bin/sh
# SPDX-License-Identifier: GPL-2.0-or-later
# debian_source.sh FOLDER SOURCE BINARY: downloads Debian's source package SOURCE into FOLDER, of the
# version of the package BINARY that is installed. deb-src entries are derived from the package
# sources that are configured, in an apt configuration of our own inside FOLDER; the system's is
# left as it is.
set -eu
mkdir -p "$1"
folder=$(cd "$1" && pwd)
version=$(dpkg-query -W -f '${source:Version}' "$3")
apt=$folder/apt
rm -rf "$apt"
mkdir -p "$apt/parts" "$apt/lists/partial" "$apt/cache"
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
cd "$folder"
# Mirrors have been seen without Debian's own small files of a package (404); the upstream archive,
# whose checksum apt has verified, is what is read.
with_sources source --download-only "$2=$version" || ls "$folder/$2"_*.orig.tar.* >&2
rm -rf "$apt"
