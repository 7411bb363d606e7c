"""The equations of the thesis against what the engine derives, each found by its number."""
