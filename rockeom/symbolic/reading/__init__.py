"""Tools of a reader of derived equations: symbols by name, forms, linearisation, comparison."""
