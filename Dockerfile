# One image for the service, its commands and its workers. Nothing of the build stays in it but the built pages.

FROM node:20-bookworm-slim AS web
WORKDIR /web
COPY web/package.json web/package-lock.json ./
RUN npm ci --no-audit --no-fund
COPY web/ ./
RUN npm run build

FROM python:3.11-slim-bookworm
ENV PYTHONUNBUFFERED=1 \
    PIP_NO_CACHE_DIR=1 \
    PIP_DISABLE_PIP_VERSION_CHECK=1 \
    DMSCAL_DATA_DIR=/data \
    DMSCAL_HOST=0.0.0.0 \
    DMSCAL_PORT=8000
RUN useradd --uid 10001 --create-home dmscal && install -d -o dmscal -g dmscal /data
WORKDIR /app
COPY requirements.lock ./
RUN pip install --no-deps --require-hashes -r requirements.lock
COPY pyproject.toml README.md LICENSE ./
COPY service/ service/
COPY migrations/ migrations/
COPY --from=web /web/dist/ web/dist/
RUN pip install --no-deps . && rm -rf /app/*
USER 10001
VOLUME /data
EXPOSE 8000
HEALTHCHECK --interval=10s --timeout=3s --start-period=20s \
    CMD ["python", "-c", "import os, urllib.request as r; r.urlopen(f\"http://127.0.0.1:{os.environ['DMSCAL_PORT']}/livez\", timeout=2)"]
CMD ["dmscal", "serve"]
