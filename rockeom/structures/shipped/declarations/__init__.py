"""The arguments of each shipped structure, generated from its declaration: do not edit."""
