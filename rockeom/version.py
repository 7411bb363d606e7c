"""The release, in its only home: the build, files and `rockeom.__version__` have it from here."""

VERSION = "0.1.0"
