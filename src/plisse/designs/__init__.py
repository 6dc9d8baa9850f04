"""From a checked recipe to a result, one file per kind of design; `plisse.pipeline.design` chooses among them."""
