"""Text for a terminal: lines of its width, tables, equations."""
