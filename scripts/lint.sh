#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Every linter, to the end, even when one of them has complained. Tools that PyPI does not have run where they are installed.
set -u
cd "$(dirname "${BASH_SOURCE[0]}")/.." || exit 1
export PATH="$PWD/.venv/bin:$PATH"
failed=()

check() {
    local name=$1 started=$SECONDS
    shift
    if "$@"; then
        printf 'lint: %-24s ok (%d s)\n' "$name" $((SECONDS - started))
    else
        printf 'lint: %-24s FAILED\n' "$name"
        failed+=("$name")
    fi
}

shopt -s nullglob
verilog=(rtl/*/*.v)
wrappers=(tb/*/*.v tb/*/*/*.v)
scripts=(scripts/*.sh sim/*.sh .ci/run)
libraries=(rtl/*/)
libraries=("${libraries[@]%/}")

check "ruff check" ruff check --quiet .
check "ruff format" ruff format --check --quiet .
check "mypy --strict" mypy --no-error-summary sw sim syn bench faults formal mutate coverage package examples tb/soak
if [ ${#verilog[@]} -gt 0 ]; then
    check "verible" verible-verilog-lint --rules_config .rules.verible_lint "${verilog[@]}" "${wrappers[@]}"
    check "verilog, module by module" python scripts/lint_verilog.py "${libraries[@]}"
fi
if command -v shellcheck >/dev/null; then
    check "shellcheck" shellcheck "${scripts[@]}"
else
    for script in "${scripts[@]}"; do check "bash -n $script" bash -n "$script"; done
fi

if [ ${#failed[@]} -gt 0 ]; then
    printf 'lint: FAILED: %s\n' "${failed[*]}" >&2
    exit 1
fi
