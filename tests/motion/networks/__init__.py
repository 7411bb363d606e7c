"""Files as networks give them: twins of each format, an oracle, mutations, and spoiled files."""
