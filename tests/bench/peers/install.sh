# The codes to compare with, from Debian. Sourced by compare_peers.sh.

# program: is it here?
needs() { command -v "$1" > /dev/null || { echo "$1 is not installed and could not be" >&2; return 1; }; }

# packages of a part
packages_of() {
  case $1 in
    lammps) echo lammps openmpi-bin ;;
    yade) echo yade ;;
    bed-* | spreading) echo liggghts openmpi-bin ;;
  esac
}

# parts: installs what they need and is missing; a package that cannot be installed is left to needs()
install_peers() {
  missing=
  for part in "$@"; do
    for package in $(packages_of "$part"); do
      dpkg-query -W -f '${Status}' "$package" 2> /dev/null | grep -q 'install ok installed' || missing="$missing $package"
    done
  done
  [ -n "$missing" ] || return 0
  sudo=
  [ "$(id -u)" -eq 0 ] || sudo=sudo
  echo "installing:$missing" >&2
  $sudo apt-get update -q > /dev/null || true
  for package in $missing; do
    $sudo env DEBIAN_FRONTEND=noninteractive apt-get install -q -y --no-install-recommends "$package" > /dev/null ||
      echo "$package could not be installed" >&2
  done
}
