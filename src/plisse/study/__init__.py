"""Parameter studies: many designs from one, made on one machine or many, kept in one store.

    import plisse.study
    study = plisse.study.run("study.toml")
    study.counts                     # {"exact": 37, "infeasible": 3}
    study.best(3, by="regularity")   # rows, the best one first
"""

from plisse.study.study import Row, Study, run

__all__ = ["Row", "Study", "run"]
