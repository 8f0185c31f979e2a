#!/bin/sh
# Gradescope runs this as root while it builds the image.
set -eu
sh /autograder/source/install.sh
