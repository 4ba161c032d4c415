"""Uploaded images, as multipart fields `image`, or one as the raw body.

Never more than the route's body limit.
"""

from dataclasses import dataclass
from typing import Annotated, Any

from fastapi import Depends, Request
from starlette.datastructures import UploadFile

from service.core.errors import BadRequest, MediaTypeUnsupported

MOST_IMAGES = 8
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
UPLOADS_BODY: dict[str, Any] = {
    "requestBody": {
        "required": True,
        "description": f"1 to {MOST_IMAGES} images: multipart fields named `image`, or the bytes of one with "
        "an image/* type.",
        "content": {
            "multipart/form-data": {
                "schema": {
                    "type": "object",
                    "required": ["image"],
                    "properties": {
                        "image": {
                            "type": "array",
                            "maxItems": MOST_IMAGES,
                            "items": {"type": "string", "format": "binary"},
                        }
                    },
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


async def uploaded_images(request: Request) -> list[UploadedImage]:
    """Read the images of a request; raises BadRequest or MediaTypeUnsupported saying how to send them."""
    media_type = request.headers.get("content-type", "").partition(";")[0].strip().lower()
    if media_type == "multipart/form-data":
        uploads = await _from_form(request)
    elif media_type.startswith("image/") or media_type == "application/octet-stream":
        uploads = [UploadedImage(await request.body(), media_type, None)]
    else:
        raise MediaTypeUnsupported(
            "Send the image as multipart/form-data with a field named 'image', or as the body with an "
            "image/* type.",
            media_type=media_type,
        )
    if not all(upload.content for upload in uploads):
        raise BadRequest("The image is empty: 0 bytes arrived. Send the file's content.")
    return uploads


async def uploaded_image(request: Request) -> UploadedImage:
    """Read the only image of a request; raises what `uploaded_images` raises."""
    uploads = await uploaded_images(request)
    if len(uploads) > 1:
        raise BadRequest(f"{len(uploads)} images arrived in one request. Send each in a request of its own.")
    return uploads[0]


async def _from_form(request: Request) -> list[UploadedImage]:
    async with request.form(max_files=MOST_IMAGES, max_fields=8) as form:
        images = [image for image in form.getlist("image") if isinstance(image, UploadFile)]
        if not images:
            raise BadRequest("The form has no file named 'image'. Name the file's field 'image'.")
        return [
            UploadedImage(
                await image.read(), image.content_type or "application/octet-stream", image.filename
            )
            for image in images
        ]


Upload = Annotated[UploadedImage, Depends(uploaded_image)]
Uploads = Annotated[list[UploadedImage], Depends(uploaded_images)]
