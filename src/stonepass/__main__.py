"""``python -m stonepass``."""

from stonepass.cli import main

if __name__ == "__main__":
    main()
