"""One integrator for every structure: texts, joined with a generated module and compiled."""
