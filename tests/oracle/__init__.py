"""The same programs as plain Python, printed for LLVM, and by numba."""
