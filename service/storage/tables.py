"""All tables at once, for what must know every one: migrations, and the names of broken rules."""

from service.storage.learnt import BoardShapeRow
from service.storage.models import Row
from service.storage.placed import LaterPictureRow

# One row of each module that adds tables, so that all of them are loaded.
LAST_ROWS: tuple[type[Row], ...] = (BoardShapeRow, LaterPictureRow)
ALL_TABLES = Row.metadata
