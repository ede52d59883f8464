#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# ./dev installs packages by the names of the distribution whose manager is here (packaging/install).
# shellcheck disable=SC2016 # of fake programs
set -euo pipefail
# shellcheck source=lib.sh
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"

install=$(realpath "$cli_folder/../../packaging/install")
mkdir "$work/tools"
for tool in bash env sed sort; do
    ln -s "$(type -P "$tool")" "$work/tools/$tool"
done
alone=(env PATH="$work/tools")
fake sudo 'while [[ $1 == -* ]]; do shift; done; exec "$@"'
wanted=(gcc libc6-dev libpng-dev clang-format clang-tidy pocl-opencl-icd python3-venv)

# ---- without a manager the packages are named
expect_exit 1 "${alone[@]}" "$install"
expect_exit 1 "${alone[@]}" "$install" "${wanted[@]}"
expect_stderr_contains "and there is no apt-get, dnf, pacman or apk to install them with: ${wanted[*]}"

# expect_call MANAGER ARGUMENT...: what the manager gets.
expect_call() {
    fake "$1" 'printf "%s\n" "${0##*/} $*"'
    expect_exit 0 "${alone[@]}" "$install"
    expect_exit 0 "${alone[@]}" "$install" "${wanted[@]}"
    expect_stdout_contains "$*"
    fake "$1" 'exit 7'
    expect_exit 1 "${alone[@]}" "$install" "${wanted[@]}"
    expect_stderr_contains "these packages are missing and could not be installed: ${*: -$count}"
    rm "$work/tools/$1"
}
count=5
expect_call dnf install -y --setopt=install_weak_deps=False clang-tools-extra gcc glibc-devel libpng-devel pocl
expect_call pacman -S --needed --noconfirm clang gcc glibc libpng pocl
count=4
expect_call apk add clang-extra-tools gcc libpng-dev musl-dev
count=7
expect_call apt-get -q -o DPkg::Lock::Timeout=300 install -y --no-install-recommends clang-format clang-tidy gcc libc6-dev \
    libpng-dev pocl-opencl-icd python3-venv

finish
