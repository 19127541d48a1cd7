# The studio on port 8000. It needs a token: docker run -e MCKIBBEN_TOKEN=... -p 127.0.0.1:8000:8000 mckibben
FROM python:3.12-slim AS build
WORKDIR /source
COPY . .
# The wheel holds the compiled integrators and the presets.
RUN pip wheel --no-cache-dir --wheel-dir /wheels ".[postgres,cluster,parquet,optimise,notebook]"

FROM python:3.12-slim
COPY --from=build /wheels /wheels
RUN pip install --no-cache-dir --no-index --find-links /wheels "mckibben[postgres,cluster,parquet,optimise,notebook]" \
    && rm -r /wheels \
    && useradd --create-home studio
USER studio
ENV MCKIBBEN_DATA=/home/studio/data
VOLUME /home/studio/data
EXPOSE 8000
# In clear text as far as the port that the host publishes, on 127.0.0.1 here.
CMD ["mckibben", "serve", "--host", "0.0.0.0", "--insecure", "--port", "8000", "--no-open"]
