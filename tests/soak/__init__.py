"""A random soak: thousands of odd motions, each checked by what must hold for all of them."""
