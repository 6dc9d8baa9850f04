"""The studio: exact pleats under one's hand, in a browser."""
