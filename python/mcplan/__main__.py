"""python -m mcplan: the same as the ``mcplan`` command."""

import sys

from mcplan.cli import main

if __name__ == "__main__":
    sys.exit(main())
