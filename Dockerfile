# The README's two commands on Debian 12.
#   docker build --tag ulpgate .                       builds, runs every function at CI size, writes the report
#   docker run --rm ulpgate                            every test
#   docker run --rm --volume "$PWD/out:/out" ulpgate ci/nightly --hours 8 --out /out/night
FROM debian:12
ENV DEBIAN_FRONTEND=noninteractive
WORKDIR /ulpgate
COPY . .
RUN scripts/run
CMD ["scripts/test"]
