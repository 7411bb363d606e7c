"""``python -m rockeom.cli`` is the command ``rockeom``."""

import sys

from rockeom.cli import main

sys.exit(main())
