"""The headline of a report claims no more than the sheet allows."""

from msgspec.structs import replace

from plisse.assess import assess
from plisse.draw.page_numbers import summary


def test_one_sheet_is_claimed_only_where_the_development_is_one_and_covers_no_place_twice(cones):
    report = assess(cones)
    sheet = report.development
    assert report.status == "exact" and sheet.pieces == 1 and not sheet.overlaps
    assert "folds from one sheet" in summary(report)
    for other, words in ((replace(sheet, pieces=3), "from 3 pieces of sheet"),
                         (replace(sheet, overlaps=True), "cut apart where it overlaps"), (None, "folds exactly")):
        told = summary(replace(report, development=other))
        assert words in told and "one sheet" not in told
