#!/bin/sh
# Five things on the command line. `vocalis` is in .venv/bin after `make run`; files are written to the current directory.
set -eu

# One voice: a table, the sound, and everything with units as netCDF.
vocalis simulate --ct 0.8 --wav high.wav --netcdf high.nc

# Posture alone: what the muscles do to strain and glottal angle.
vocalis posture --pca 0.5

# Static shape and closure pattern as JSON.
vocalis static --preset bowed --json > bowed.json

# A glide: breakpoints time:value wherever an option takes a number.
vocalis gesture --ct 0.2:0.1,0.8:0.9 --duration 1 --wav glide.wav

# A map over two muscles. After an interruption the same command continues.
vocalis sweep --axis activation.ct=0:1:3 --axis activation.ta=0:0.5:2 --measures fo_hz,closed_quotient --netcdf map.nc
