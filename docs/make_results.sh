#!/usr/bin/env bash
# Runs the tests behind docs/results/README.md.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
prm=drivers/two_scale_triaxial/two_scale_triaxial.prm
./run two_scale_triaxial $prm --output results/grains --set "Model/kind=grains" --set "Loading/time step=1.2e-7"
./run two_scale_triaxial $prm --output results/continuum --set "Model/kind=continuum" --set "Loading/time step=1.2e-7"
./run two_scale_triaxial $prm --output results/two_scale_triaxial # last: draws the comparison
