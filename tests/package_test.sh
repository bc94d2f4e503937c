#!/usr/bin/env bash
# Installs the Debian package or the wheel in a new Debian 12 and renders there. Needs root and Debian's mirror:
#   package_test.sh PACKAGE.deb|PACKAGE.whl [FOLDER]     FOLDER is kept, and used again
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
cp "$package" "$folder/"
package=/$(basename "$package")
# A scene with PNG textures.
rm -rf "$folder"/scene "$folder"/image.* && mkdir "$folder/scene"
cp -rL scenes/textures/. "$folder/scene/"
# An image of a kind that the module for image formats reads.
{ printf 'P6\n32 32\n255\n' && head -c 3072 /dev/zero; } >"$folder/image.ppm"
inside() { chroot "$folder" env DEBIAN_FRONTEND=noninteractive "$@"; }
inside apt-get update -qq

test_debian_package() {
  inside apt-get install -y -qq --reinstall --no-install-recommends "$package" >/dev/null
  inside duet /scene/scene.xml --spp 4 --size 32x32 -o /image.exr -o /image.png -q
  inside duet compare /image.ppm /image.ppm >/dev/null
  inside duet stability --list | grep -q point-light-mirror
  inside bash -n /usr/share/bash-completion/completions/duet
  local file
  for file in man/man1/duet.1 zsh/vendor-completions/_duet fish/vendor_completions.d/duet.fish doc/duet/copyright; do
    [ -s "usr/share/$file" ]
  done
  inside duet --version --verbose
  inside apt-get remove -y -qq duet >/dev/null
  [ ! -e usr/bin/duet ]
}

test_wheel() {
  inside apt-get install -y -qq --no-install-recommends python3-venv python3-numpy >/dev/null
  inside python3 -m venv --clear --system-site-packages /venv
  inside /venv/bin/pip --quiet install --no-index "$package"
  inside /venv/bin/python -W error - <<'END'
import duet
import numpy

scene = duet.load_file("/scene/scene.xml")
image = duet.render(scene, spp=4, size=(32, 32))
image.save("/image.exr")
image.save("/image.png")
assert duet.compare("/image.exr", image)["rmse"] < 0.001  # halves
assert duet.compare("/image.ppm", "/image.ppm")["rmse"] == 0
assert numpy.asarray(image)[..., :3].mean() > 0.01
END
  # The libraries are its own: of the system it has those of the compiler alone.
  local others
  others=$(inside sh -c 'ldd /venv/lib/python3*/site-packages/duet/*.so' | grep -E '=> (not found|/lib|/usr/lib)' |
    grep -vE '\slib(c|m|mvec|dl|rt|pthread|util|anl|resolv|gcc_s|stdc[+][+])[.]so' || true)
  [ -z "$others" ] || { echo "$others" >&2 && return 1; }
}

cd "$folder"
case $package in
*.deb) test_debian_package ;;
*) test_wheel ;;
esac
[ -s image.exr ]
[ -s image.png ]
echo "$(basename "$package") installs and renders"
