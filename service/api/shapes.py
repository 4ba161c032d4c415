"""What all messages of the REST interface have in common.

Not here: the messages themselves, which stand in `rest`.
"""

from typing import Annotated, Generic, TypeVar
from uuid import UUID

from fastapi import Path
from pydantic import AfterValidator, BaseModel, ConfigDict, Field

from service.usecases.frame_address import mask_source
from service.usecases.text import CODE_PATTERN

Item = TypeVar("Item")

Id = Annotated[UUID, Path(description="Id as another answer gave it (UUID version 7).")]
SkuCode = Annotated[str, Path(pattern=CODE_PATTERN, description="Code of the SKU.", examples=["lens1"])]
RevisionNumber = Annotated[int, Path(ge=1, le=1_000_000, description="Number of the revision, from 1.")]


ShownSource = Annotated[
    str,
    AfterValidator(mask_source),
    Field(description="Where frames come from; name, password and query of an address are shown as `***`."),
]


class Answer(BaseModel):
    """A message to the caller; made from a record or a view with the same attributes."""

    model_config = ConfigDict(from_attributes=True)


class Request(BaseModel):
    """A message from the caller: strict types, finite numbers, no unknown fields."""

    model_config = ConfigDict(extra="forbid", strict=True, allow_inf_nan=False)


class Page(Answer, Generic[Item]):
    """A part of a list, newest first; `next_cursor` asks for the next part and is null at the end."""

    items: list[Item]
    next_cursor: str | None = Field(description="Give it as `cursor` to go on; null: this was the last part.")
