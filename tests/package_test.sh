#!/usr/bin/env bash
# Installs the Debian package in a new Debian 12 and renders there. Needs root and Debian's mirror:
#   package_test.sh PACKAGE.deb [FOLDER]     FOLDER is kept, and used again
set -euo pipefail
package=$(realpath "$1")
cd "$(dirname "$0")/.."
. scripts/deps.sh
duet_install debootstrap
folder=${2:-}
if [ -z "$folder" ]; then
  folder=$(mktemp -d)
  trap 'rm -rf --one-file-system "$folder"' EXIT
fi
[ -e "$folder/etc/debian_version" ] || debootstrap --variant=minbase bookworm "$folder" >/dev/null
cp /etc/resolv.conf "$folder/etc/"
rm -f "$folder/etc/apt/sources.list"
cp -r /etc/apt/. "$folder/etc/apt/"
cp "$package" "$folder/duet.deb"
rm -rf "$folder/scene" && mkdir "$folder/scene"
cp -rL scenes/textures/. "$folder/scene/"
inside() { chroot "$folder" env DEBIAN_FRONTEND=noninteractive "$@"; }
inside apt-get update -qq
inside apt-get install -y -qq --reinstall --no-install-recommends /duet.deb >/dev/null
cd "$folder"
# A scene with PNG textures: the module for image formats is found, too.
inside duet /scene/scene.xml --spp 4 --size 32x32 -o /image.exr -o /image.png -q
[ -s image.exr ] && [ -s image.png ]
inside duet stability --list | grep -q point-light-mirror
inside bash -n /usr/share/bash-completion/completions/duet
[ -s usr/share/man/man1/duet.1 ] && [ -s usr/share/zsh/vendor-completions/_duet ]
[ -s usr/share/fish/vendor_completions.d/duet.fish ] && [ -s usr/share/doc/duet/copyright ]
inside duet --version --verbose
inside apt-get remove -y -qq duet >/dev/null
[ ! -e usr/bin/duet ]
echo "The package installs, renders and goes"
