"""Many motions as lanes of one stream of instructions: their loop, and the text of their step."""
