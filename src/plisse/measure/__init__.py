"""Numbers about a structure; every function is pure and sees topology and coordinates only."""
