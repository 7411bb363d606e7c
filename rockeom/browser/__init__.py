"""A structure, a motion and sliders in one web page, which integrates them as rockeom does."""
