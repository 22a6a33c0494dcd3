# SPDX-License-Identifier: Apache-2.0
"""All numerical benchmarks: `python -m bench [--quick]`."""

from __future__ import annotations

import argparse
import sys

from bench import accuracy, limits, rates, three_sigma
from bench.common import JOBS


def main() -> int:
    """Run all to the end; 1 where one of them found its number broken."""
    parser = argparse.ArgumentParser(description="numerical benchmarks of the bit-exact model")
    parser.add_argument("--quick", action="store_true", help="a few cases of each, nothing kept")
    parser.add_argument("--jobs", type=int, default=JOBS, help="processes")
    options = parser.parse_args()
    arguments = [*(["--quick"] if options.quick else []), "--jobs", str(options.jobs)]
    failed = 0
    for part in (accuracy, limits, three_sigma, rates):
        failed |= part.main(arguments)
        print()
    return failed


if __name__ == "__main__":
    sys.exit(main())
