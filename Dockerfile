# Vocalis behind a token, as an ordinary user:
#   docker build -t vocalis .
#   docker run -p 8000:8000 -e VOCALIS_TOKEN="$(openssl rand -hex 24)" vocalis
# A browser that reaches it by a name needs that name in VOCALIS_ALLOWED_HOSTS; addresses and localhost need nothing.

FROM python:3.12-slim AS build
WORKDIR /source
RUN python -m venv /opt/vocalis
COPY . .
RUN /opt/vocalis/bin/pip install --no-cache-dir .

FROM python:3.12-slim
RUN useradd --system --uid 10001 --no-create-home --shell /usr/sbin/nologin vocalis \
    && install -d -o vocalis -g vocalis /var/lib/vocalis
COPY --from=build /opt/vocalis /opt/vocalis
ENV PATH=/opt/vocalis/bin:$PATH \
    PYTHONUNBUFFERED=1 \
    PYTHONDONTWRITEBYTECODE=1 \
    VOCALIS_DATA=/var/lib/vocalis
WORKDIR /var/lib/vocalis
USER vocalis
# Compiled for this machine's processor; on another kind the first start compiles again (some seconds).
RUN python -m vocalis.server --warm
EXPOSE 8000
STOPSIGNAL SIGTERM
HEALTHCHECK --interval=30s --timeout=5s --start-period=30s --retries=3 \
    CMD ["python", "-c", "import json, urllib.request as r; assert json.load(r.urlopen('http://127.0.0.1:8000/api/v1/health', timeout=4))['ready']"]
# No token, no start: there is no default that everybody knows.
ENTRYPOINT ["/bin/sh", "-c", ": \"${VOCALIS_TOKEN:?set VOCALIS_TOKEN to what clients must show}\"; exec python -m vocalis.server --host 0.0.0.0 --port 8000 \"$@\"", "vocalis"]
