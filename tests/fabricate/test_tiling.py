"""Pages that cover a sheet."""

import numpy as np
import pytest
import shapely

from plisse.errors import PlisseError
from plisse.fabricate.tiling import PAPERS, paper_size, tiling


@pytest.mark.parametrize("paper", PAPERS.values(), ids=PAPERS)
@pytest.mark.parametrize("size", [(600.0, 300.0), (297.0, 210.0), (1000.0, 120.0)])
def test_windows_cover_the_sheet_and_neighbours_share_marks(size, paper):
    layout = tiling(size, paper)
    windows = [shapely.box(*tile.corner, *np.add(tile.corner, layout.window)) for tile in layout.tiles]
    assert shapely.union_all(windows).contains(shapely.box(0, 0, *size))
    assert max(layout.window) < max(paper) and len(layout.tiles) == layout.rows * layout.columns
    marks = shapely.points(layout.marks)
    seen = {(tile.row, tile.column): set(np.flatnonzero(shapely.covers(window, marks)))
            for tile, window in zip(layout.tiles, windows, strict=True)}
    for (row, column), marks in seen.items():
        for beside in ((row, column + 1), (row + 1, column)):
            if beside in seen:
                assert len(marks & seen[beside]) >= 2


def test_papers_are_known_by_name_and_others_are_refused():
    assert paper_size("a4") == (210.0, 297.0)
    with pytest.raises(PlisseError, match="A4, A3, Letter"):
        paper_size("A9")
