"""Shipped structures: `declarations` are generated; a file of a structure adds its closed forms."""
