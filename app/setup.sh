# Sourced by app/run and tests/run: installs the Debian packages that are missing.

palp_packages=(build-essential cmake ninja-build libeigen3-dev libopenmesh-dev libvtk9-dev
  libvtk9-qt-dev qtmultimedia5-dev libqt5multimedia5-plugins libhidapi-dev libusb-1.0-0-dev
  libopenigtlink-dev libspnav-dev libwebsockets-dev libcli11-dev nlohmann-json3-dev nettle-dev
  zlib1g-dev libseccomp-dev libsuitesparse-dev libgdcm-dev libicu-dev libsystemd-dev
  libegl-dev libegl1 libgl1-mesa-dri fonts-dejavu-core pkgconf)
palp_test_packages=(ccache clang libclang-rt-dev llvm libgtest-dev dbus-daemon dcmtk libopenblas0-serial xvfb xauth umockdev libumockdev-dev clang-format clang-tidy codespell python3 parallel faketime)
palp_long_test_packages=(slurmctld slurmd slurm-client munge)

# palp_install PACKAGE...: nothing is done, and nothing printed, when all are there
palp_install()
{
  local missing=() package state
  for package in "$@"; do
    state=$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null) || state=none
    [ "$state" = installed ] || missing+=("$package")
  done
  [ ${#missing[@]} -gt 0 ] || return 0

  local as_root=()
  if [ "$(id -u)" -ne 0 ]; then
    command -v sudo >/dev/null || {
      echo "palp: these packages are missing and neither root nor sudo is there to install them: ${missing[*]}"
      return 1
    }
    as_root=(sudo)
  fi
  echo "palp: installing ${missing[*]}"
  "${as_root[@]}" apt-get update -qq
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
    apt-get install -y -qq --no-install-recommends "${missing[@]}"
}

# palp_configure DIRECTORY [CMAKE-OPTION...]: sources are compiled by the folder, in a third of the time
palp_configure()
{
  local directory=$1
  shift
  cmake -S "$palp_root" -B "$directory" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_UNITY_BUILD=ON \
    -DCMAKE_UNITY_BUILD_BATCH_SIZE=0 "$@"
}
