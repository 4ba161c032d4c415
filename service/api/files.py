"""Files as answers: content that a browser saves under the name that the service gives it."""

from urllib.parse import quote

from fastapi import Response


def attachment(content: bytes, media_type: str, file_name: str) -> Response:
    """Return an answer to save; names beyond ASCII are told as RFC 6266 says."""
    plain = "".join(character if _is_safe(character) else "_" for character in file_name)
    disposition = f'attachment; filename="{plain}"'
    if plain != file_name:
        disposition += f"; filename*=UTF-8''{quote(file_name, safe='')}"
    return Response(content, media_type=media_type, headers={"Content-Disposition": disposition})


def _is_safe(character: str) -> bool:
    return character.isascii() and (character.isalnum() or character in "._-")
