#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
#
# install_packages.sh asks for what is missing and for nothing else, and leaves apt alone when nothing is. Runs
# against stand-ins for dpkg-query, apt-get and sudo, which write down what they are asked.
set -euo pipefail

root=$(dirname -- "$(readlink -f -- "${BASH_SOURCE[0]}")")/../..
sandbox=$(mktemp --directory)
trap 'rm -rf -- "$sandbox"' EXIT
failures=0

stand_in() {
  printf '#!/usr/bin/env bash\n%s\n' "$2" > "$sandbox/bin/$1"
  chmod +x "$sandbox/bin/$1"
}

claim() {
  local what=$1
  shift
  "$@" || {
    echo "not so: $what"
    failures=$((failures + 1))
  }
}

# Runs the script with `installed` packages on the machine; `asked` is what apt-get then hears.
install_with() {
  printf '%s\n' "$@" > "$sandbox/installed"
  : > "$sandbox/asked"
  status=0
  PATH=$sandbox/bin:$PATH "$sandbox/a place/scripts/install_packages.sh" "${further_lists[@]}" > "$sandbox/output" 2>&1 || status=$?
  asked=$(< "$sandbox/asked")
  output=$(< "$sandbox/output")
}

further_lists=()
mkdir -p -- "$sandbox/bin" "$sandbox/a place/scripts"
cp -- "$root/scripts/install_packages.sh" "$sandbox/a place/scripts/"
printf '# a comment\none\n\n two # why\nthree' > "$sandbox/a place/packages.txt"
stand_in dpkg-query "grep -qxF -- \"\${!#}\" '$sandbox/installed' && printf installed"
stand_in apt-get "printf '%s\n' \"\$*\" >> '$sandbox/asked'"
stand_in sudo 'exec "$@"'

install_with one two three
claim 'nothing missing succeeds' test "$status" = 0
claim 'nothing missing leaves apt alone' test -z "$asked"
claim 'nothing missing says nothing' test -z "$output"

install_with one
claim 'installing succeeds' test "$status" = 0
claim 'apt updates once, then installs what is missing' test "$(wc -l < "$sandbox/asked")" = 2
claim 'updates first' grep -q ' update$' <(head -n 1 "$sandbox/asked")
claim 'asks for the missing ones only' grep -q -- '--no-install-recommends two three$' "$sandbox/asked"

printf 'four\n' > "$sandbox/four.txt"
further_lists=("$sandbox/four.txt")
install_with one two
claim 'a further list is installed too' grep -q -- '--no-install-recommends three four$' "$sandbox/asked"
further_lists=()

stand_in apt-get 'exit 100'
install_with one two
claim 'a failing apt fails' test "$status" = 1
claim 'and says which step' grep -q 'apt-get update failed' <<< "$output"

rm -- "$sandbox/a place/packages.txt"
install_with one
claim 'a list that is not there is not an empty one' test "$status" = 1

((failures == 0)) || { printf '%s\n' "$output"; exit 1; }
