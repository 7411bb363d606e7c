"""Numbers that carry more than a value, functions of them, and checks of arguments."""
