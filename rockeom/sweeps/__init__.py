"""Many motions: cases, workers, datasets; derivatives of answers."""
