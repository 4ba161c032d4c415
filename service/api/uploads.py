"""One uploaded image, as a multipart field `image` or as the raw body.

Never more than the route's body limit.
"""

from dataclasses import dataclass
from typing import Annotated, Any

from fastapi import Depends, Request
from starlette.datastructures import UploadFile

from service.core.errors import BadRequest, MediaTypeUnsupported

UPLOAD_BODY: dict[str, Any] = {
    "requestBody": {
        "required": True,
        "description": "The image: a multipart field named `image`, or the bytes themselves with an "
        "image/* type.",
        "content": {
            "multipart/form-data": {
                "schema": {
                    "type": "object",
                    "required": ["image"],
                    "properties": {"image": {"type": "string", "format": "binary"}},
                }
            },
            "image/png": {"schema": {"type": "string", "format": "binary"}},
            "image/jpeg": {"schema": {"type": "string", "format": "binary"}},
        },
    }
}


@dataclass(frozen=True)
class UploadedImage:
    """The bytes as they came, with the name and type that the sender gave them."""

    content: bytes
    media_type: str
    file_name: str | None


async def uploaded_image(request: Request) -> UploadedImage:
    """Read the image of a request; raises BadRequest or MediaTypeUnsupported saying how to send it."""
    media_type = request.headers.get("content-type", "").partition(";")[0].strip().lower()
    if media_type == "multipart/form-data":
        upload = await _from_form(request)
    elif media_type.startswith("image/") or media_type == "application/octet-stream":
        upload = UploadedImage(await request.body(), media_type, None)
    else:
        raise MediaTypeUnsupported(
            "Send the image as multipart/form-data with a field named 'image', or as the body with an "
            "image/* type.",
            media_type=media_type,
        )
    if not upload.content:
        raise BadRequest("The image is empty: 0 bytes arrived. Send the file's content.")
    return upload


async def _from_form(request: Request) -> UploadedImage:
    async with request.form(max_files=1, max_fields=8) as form:
        image = form.get("image")
        if not isinstance(image, UploadFile):
            raise BadRequest("The form has no file named 'image'. Name the file's field 'image'.")
        return UploadedImage(
            await image.read(), image.content_type or "application/octet-stream", image.filename
        )


Upload = Annotated[UploadedImage, Depends(uploaded_image)]
