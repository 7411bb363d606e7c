"""Files of records, a grammar of a network in a file each."""
