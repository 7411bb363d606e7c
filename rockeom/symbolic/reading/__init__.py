"""What a reader does with derived equations: finds symbols, linearises, compares."""
