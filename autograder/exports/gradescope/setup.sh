#!/usr/bin/env bash
# Gradescope runs this once, when the image is built: Python, the locked versions, the grader.
set -euo pipefail

source=${AUTOGRADER_ROOT:-/autograder}/source
cd "$source"

newest_python() {
    local name
    for name in python3.14 python3.13 python3.12 python3.11 python3; do
        if command -v "$name" >/dev/null &&
            "$name" -c 'import sys, venv, ensurepip; sys.exit(sys.version_info < (3, 11))' 2>/dev/null; then
            command -v "$name"
            return
        fi
    done
    return 1
}

python=${AUTOGRADER_PYTHON:-$(newest_python || true)}
if [[ -z $python ]]; then
    export DEBIAN_FRONTEND=noninteractive
    apt-get update -qq
    apt-get install -y -qq --no-install-recommends python3 python3-venv
    python=$(newest_python || true)
    if [[ -z $python ]]; then # Ubuntu 22.04 has Python 3.10, and 3.11 beside it
        apt-get install -y -qq --no-install-recommends python3.11 python3.11-venv
        python=$(newest_python)
    fi
fi

"$python" -m venv environment
environment/bin/python -m pip --disable-pip-version-check --no-input install -q --only-binary :all: -r requirements.txt
site=$(environment/bin/python -c 'import sysconfig; print(sysconfig.get_path("purelib"))')
cp -R packages/. "$site/"
environment/bin/python -m compileall -q "$site/autograder" "$site/assignment" "$site/reference_solution"
environment/bin/python -I -m autograder doctor || true # says what this machine can lock, for the build log
