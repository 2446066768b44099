"""What studies in Python share: kept runs, the search for options, what runs say of each other, and tables."""
