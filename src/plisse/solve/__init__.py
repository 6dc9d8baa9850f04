"""From a pattern to an exact structure: zigzag, constraints, linear algebra, methods (§3.3, §3.4)."""
