"""``python -m stonepass``."""

from stonepass.cli import main

main()
