"""The assessment of a structure that may uplift, slide or overturn; see `rockeom.assess`."""
