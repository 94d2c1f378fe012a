# docker build -t wend . && docker run --rm -v "$PWD/demo:/out" wend demo --out /out
# Other bases: --build-arg BASE=debian:bookworm-slim, or ubuntu:24.04.
ARG BASE=debian:trixie-slim
FROM ${BASE}
COPY . /wend
RUN /wend/run build release wend && rm -rf /var/lib/apt/lists/*
ENTRYPOINT ["/wend/build/release/bin/wend"]
