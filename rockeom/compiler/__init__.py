"""Machine code from a closed subset of Python: front end, LLVM, cache. Never imports SymPy."""
