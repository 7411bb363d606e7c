"""The page of a model: equations as one would write them in a paper, in LaTeX and Markdown."""
