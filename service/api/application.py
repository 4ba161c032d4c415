"""All routes of the service as one application; what they work with is given to it as `Services`."""

from collections.abc import Callable
from contextlib import AbstractAsyncContextManager

from fastapi import APIRouter, FastAPI

import service
from service.api import docs_page, problem_pages, static
from service.api.openapi import DESCRIPTION, PROBLEM_ANSWERS, TAGS
from service.api.problems import install_problem_handlers
from service.api.rest import (
    board_shapes,
    captures,
    certificates,
    exports,
    extrinsics,
    health,
    jobs,
    keys,
    pose_set_review,
    pose_sets,
    results,
    run_comparison,
    runs,
    skus,
    stations,
    statistics,
    targets,
    vehicles,
)
from service.api.security import Guard
from service.api.ws import guidance

Lifespan = Callable[[FastAPI], AbstractAsyncContextManager[None]]

MAX_JSON_BYTES = 1_000_000
MAX_IMAGE_BYTES = 32_000_000


def create_api(lifespan: Lifespan | None = None, max_image_bytes: int = MAX_IMAGE_BYTES) -> FastAPI:
    """Return the application.

    Bodies are limited before they are read, those with images to `max_image_bytes`.
    """
    app = FastAPI(
        title="dmscal",
        version=service.__version__,
        description=DESCRIPTION,
        openapi_tags=TAGS,
        openapi_url=None,
        docs_url=None,
        redoc_url=None,
        lifespan=lifespan,
    )
    install_problem_handlers(app)
    app.add_middleware(Guard)
    api = APIRouter(prefix="/api/v1", responses=PROBLEM_ANSWERS, max_body_size=MAX_JSON_BYTES)
    for resource in (
        runs,
        results,
        certificates,
        exports,
        run_comparison,
        vehicles,
        skus,
        pose_sets,
        pose_set_review,
        jobs,
        targets,
        board_shapes,
        stations,
        statistics,
        keys,
    ):
        api.include_router(resource.router)
    app.include_router(api)
    images = APIRouter(prefix="/api/v1", responses=PROBLEM_ANSWERS, max_body_size=max_image_bytes)
    images.include_router(captures.router)
    images.include_router(extrinsics.router)
    app.include_router(images)
    app.include_router(health.router, responses=PROBLEM_ANSWERS)
    app.include_router(certificates.public_keys, responses=PROBLEM_ANSWERS)
    app.include_router(guidance.router)
    app.include_router(docs_page.router)
    app.include_router(problem_pages.router)
    app.include_router(static.router)
    return app
