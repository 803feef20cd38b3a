#!/usr/bin/env bash
# native.sh ode|fcl|bullet|coal FOLDER: builds the library for this machine's CPU in FOLDER/NAME: from Debian's source package as
# a static one, Coal from its source package on PyPI. The options are those of Debian's and Coal's own builds, but for the CPU.
set -euo pipefail
name=$1 folder=$2
say() { printf 'plugins-native: %s\n' "$*" >&2; }
flags="-O3 -march=native -frecord-gcc-switches"
mkdir -p "$folder/source"
folder=$(cd "$folder" && pwd)
rm -rf "${folder:?}/source/$name" "${folder:?}/$name"

if [ "$name" = coal ]; then
  libcoal=$(grep '^libcoal==' "$(dirname "$0")/../../tests/setup/coal.txt")
  say "compiling $libcoal with $flags; this takes some minutes"
  python3 -m venv "$folder/source/coal"
  # Only Coal itself is compiled, without its tests; what it is built with comes as the wheels that it names. A wheel that pip
  # keeps from another time may have been built for another CPU.
  CMEEL_RUN_TESTS=OFF CXXFLAGS="$flags -w" "$folder/source/coal/bin/pip" wheel --quiet --no-cache-dir --disable-pip-version-check --no-deps --no-binary libcoal \
    --wheel-dir "$folder/source/coal" "$libcoal"
  python3 -m zipfile -e "$folder"/source/coal/libcoal-*.whl "$folder/source/coal"
  mv "$folder/source/coal/cmeel.prefix" "$folder/coal"
  exit
fi

for tool in apt-get dpkg-source cmake; do
  command -v "$tool" >/dev/null || { say "$tool is missing; it comes with the Debian packages dpkg-dev and cmake"; exit 1; }
done

mkdir -p "$folder/apt/lists/partial" "$folder/apt/parts"
# The machine's own lists of Debian, asked for sources instead of packages.
for list in /etc/apt/sources.list /etc/apt/sources.list.d/debian.sources; do
  [ -e "$list" ] || continue
  sed -E 's/^(deb|Types: deb)([[:space:]]|$)/\1-src\2/' "$list" > "$folder/apt/parts/debian.${list##*.}"
done
apt=(-qq -o "Dir::Etc::SourceList=/dev/null" -o "Dir::Etc::SourceParts=$folder/apt/parts" -o "Dir::State::Lists=$folder/apt/lists"
  -o "Dir::Cache=$folder/apt" -o APT::Sandbox::User=root)
[ -n "$(find "$folder/apt/lists" -name '*Sources*' -mtime -1)" ] || apt-get "${apt[@]}" update
mkdir -p "$folder/source/$name"
say "fetching the source of $name"
(cd "$folder/source/$name" && apt-get "${apt[@]}" source "$name" >/dev/null)
source=$(find "$folder/source/$name" -mindepth 1 -maxdepth 1 -type d)

case $name in
  ode) options=(-DODE_DOUBLE_PRECISION=ON -DODE_WITH_DEMOS=OFF -DODE_WITH_TESTS=OFF) ;;
  fcl) options=(-DFCL_STATIC_LIBRARY=ON -DFCL_USE_X64_SSE=OFF -DBUILD_TESTING=OFF -DFCL_WITH_OCTOMAP=OFF) ;;
  bullet) options=(-DUSE_DOUBLE_PRECISION=ON -DBUILD_BULLET2_DEMOS=OFF -DBUILD_CPU_DEMOS=OFF -DBUILD_OPENGL3_DEMOS=OFF
    -DBUILD_EXTRAS=OFF -DBUILD_UNIT_TESTS=OFF -DBUILD_PYBULLET=OFF -DBUILD_BULLET3=OFF) ;;
  *) say "there is no native build of $name"; exit 1 ;;
esac
say "compiling $name $(basename "$source") with $flags"
cmake -S "$source" -B "$source/native" -DCMAKE_BUILD_TYPE=Release -DBUILD_SHARED_LIBS=OFF -DCMAKE_POSITION_INDEPENDENT_CODE=ON \
  -DCMAKE_C_FLAGS="$flags" -DCMAKE_CXX_FLAGS="$flags" -DCMAKE_CXX_FLAGS_RELEASE=-DNDEBUG -DCMAKE_C_FLAGS_RELEASE=-DNDEBUG \
  -DCMAKE_INSTALL_PREFIX="$folder/$name" -DCMAKE_INSTALL_LIBDIR=lib -DCMAKE_POLICY_VERSION_MINIMUM=3.5 "${options[@]}" >/dev/null
cmake --build "$source/native" --parallel "$(nproc)" >/dev/null
cmake --install "$source/native" >/dev/null
